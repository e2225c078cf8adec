//! A figure of the paper: what every one of them can say and make.

use serde_json::Value;
use thiserror::Error;

use super::claim::Claim;
use crate::backend::Watch;
use crate::figure::{Picture, TooSmall};
use crate::sweep::SweepError;

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
