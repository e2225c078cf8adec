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
mod paper_point;
mod plane;
mod regions;
mod report;
mod sections;
mod stability_loss;

use serde_json::Value;
use thiserror::Error;

use crate::backend::Watch;
use crate::figure::{Picture, TooSmall};
use crate::sweep::SweepError;

pub use claim::{Claim, Outcome};
pub use report::{Finished, markdown};

/// A figure of the paper.
pub trait PaperFigure: Sync {
    /// Its number.
    fn number(&self) -> u32;

    /// What it shows.
    fn caption(&self) -> &'static str;

    /// Everything that its pictures and claims depend on but the program; a figure that was made with the same need not be
    /// made again.
    fn config(&self) -> Value;

    /// Draws its pictures and checks its claims.
    ///
    /// # Errors
    /// What could not be computed or drawn; [`SweepError::Backend`] where the watch ended it.
    fn produce(&self, watch: &dyn Watch) -> Result<Produced, ReproduceError>;
}

/// What came out of a figure.
#[derive(Clone, Debug)]
pub struct Produced {
    /// Its pictures, each with the letter of its part, empty where there is but one.
    pub pictures: Vec<(&'static str, Picture)>,
    /// What the paper says, and whether it holds.
    pub claims: Vec<Claim>,
}

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

/// The full configuration of a figure, as it stands in its files.
pub fn config_of(figure: &dyn PaperFigure) -> Value {
    serde_json::json!({
        "version": env!("CARGO_PKG_VERSION"),
        "command": format!("impact-atlas reproduce --figure {}", figure.number()),
        "figure": figure.number(),
        "settings": figure.config(),
    })
}

/// Why a figure was not made.
#[derive(Debug, Error)]
pub enum ReproduceError {
    /// Something was not computed.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A picture was not drawn.
    #[error(transparent)]
    Picture(#[from] TooSmall),
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
