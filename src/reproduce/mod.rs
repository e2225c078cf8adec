//! The figures of the paper and what it prints, computed again.
//!
//! Every figure is a [`PaperFigure`] among the [`FIGURES`]: it knows its configuration, draws its pictures and holds what the
//! paper says of it against what is computed. Nothing on the computed side is written down here.

mod chatter;
mod claim;
mod control;
mod diagrams;
mod lines;
mod orbits;
mod paper_figure;
mod paper_point;
mod plane;
mod regions;
mod report;
mod sections;
mod stability_loss;

pub use claim::{Claim, Outcome};
pub use paper_figure::{PaperFigure, Produced, ReproduceError};
pub use report::{Finished, markdown};

/// Every figure that can be made again, by its number.
pub static FIGURES: [PaperFigure; 19] = [
    plane::FIGURE_5,
    diagrams::FIGURE_6,
    orbits::FIGURE_7,
    orbits::FIGURE_8,
    sections::FIGURE_9,
    orbits::FIGURE_10,
    orbits::FIGURE_11,
    chatter::FIGURE_12,
    chatter::FIGURE_13,
    sections::FIGURE_14,
    control::FIGURE_15,
    control::FIGURE_16,
    control::FIGURE_17,
    control::FIGURE_18,
    control::FIGURE_19,
    control::FIGURE_20,
    control::FIGURE_21,
    control::FIGURE_22,
    control::FIGURE_23,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_their_own_numbers_and_configurations() {
        let numbers: Vec<u32> = FIGURES.iter().map(|figure| figure.number).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
        let mut configs: Vec<String> = FIGURES.iter().map(|figure| figure.config().to_string()).collect();
        configs.sort();
        configs.dedup();
        assert_eq!(configs.len(), numbers.len());
    }
}
