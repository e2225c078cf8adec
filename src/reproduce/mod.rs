//! The figures of the paper and what it prints, computed again.
//!
//! Every figure is a [`PaperFigure`] of the [`registry`]: it knows its configuration, draws its pictures and holds what the
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
pub use paper_figure::{PaperFigure, Produced, ReproduceError, config_of};
pub use report::{Finished, markdown};

/// Every figure that can be made again, by its number.
pub fn registry() -> Vec<&'static dyn PaperFigure> {
    vec![
        &plane::Figure5,
        &diagrams::Figure6,
        &orbits::Figure7,
        &orbits::Figure8,
        &sections::Figure9,
        &orbits::Figure10,
        &orbits::Figure11,
        &chatter::Figure12,
        &chatter::Figure13,
        &sections::Figure14,
        &control::Figure15,
        &control::Figure16,
        &control::Figure17,
        &control::Figure18,
        &control::Figure19,
        &control::Figure20,
        &control::Figure21,
        &control::Figure22,
        &control::Figure23,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_have_their_own_numbers_and_configurations() {
        let numbers: Vec<u32> = registry().iter().map(|figure| figure.number()).collect();
        assert!(numbers.is_sorted_by(|a, b| a < b), "{numbers:?}");
        let mut configs: Vec<String> = registry().iter().map(|f| config_of(*f).to_string()).collect();
        configs.sort();
        configs.dedup();
        assert_eq!(configs.len(), numbers.len());
    }
}
