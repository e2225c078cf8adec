//! A figure of the paper: what every one of them says and makes.

use serde_json::Value;
use thiserror::Error;

use super::claim::Claim;
use crate::backend::Watch;
use crate::figure::{Picture, TooSmall};
use crate::sweep::SweepError;

/// A figure of the paper.
#[derive(Debug)]
pub struct PaperFigure {
    /// Its number.
    pub number: u32,
    /// What it shows.
    pub caption: &'static str,
    /// Everything that its pictures and claims depend on but the program.
    pub(super) settings: fn() -> Value,
    /// Draws its pictures, which carry a configuration, and checks its claims.
    pub(super) make: fn(&str, &dyn Watch) -> Result<Produced, ReproduceError>,
}

impl PaperFigure {
    /// Its full configuration, as it stands in its files; a figure that was made with the same need not be made again.
    pub fn config(&self) -> Value {
        serde_json::json!({
            "version": env!("CARGO_PKG_VERSION"),
            "command": format!("impact-atlas reproduce --figure {}", self.number),
            "figure": self.number,
            "settings": (self.settings)(),
        })
    }

    /// Draws its pictures and checks its claims.
    ///
    /// # Errors
    /// What could not be computed or drawn; [`SweepError::Backend`] where the watch ended it.
    pub fn produce(&self, watch: &dyn Watch) -> Result<Produced, ReproduceError> {
        (self.make)(&self.config().to_string(), watch)
    }
}

/// What came out of a figure.
#[derive(Clone, Debug)]
pub struct Produced {
    /// Its pictures, each with the letter of its part, empty where there is but one.
    pub pictures: Vec<(&'static str, Picture)>,
    /// What the paper says, and whether it holds.
    pub claims: Vec<Claim>,
}

impl Produced {
    /// A single picture, and what the paper says of it.
    pub(super) fn one(picture: Picture, claims: Vec<Claim>) -> Self {
        Produced { pictures: vec![("", picture)], claims }
    }
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
