//! How the columns of a diagram begin.

use std::str::FromStr;

use derive_more::Display;
use serde::{Deserialize, Serialize};

use super::error::DiagramError;
use crate::plane::{Start, StartError};
use crate::system::named;

/// How the columns of a diagram begin.
#[derive(Clone, Copy, Debug, PartialEq, Display, Serialize, Deserialize)]
#[display(rename_all = "lowercase")]
#[serde(into = "String", try_from = "String")]
pub enum Sweep {
    /// Every column by itself, from the same kind of start.
    #[display("{_0}")]
    Each(Start),
    /// With falling values, each column where the one before it ended.
    Down,
    /// With rising values, each column where the one before it ended.
    Up,
    /// Once down and once up.
    Both,
}

impl Sweep {
    /// The branches that the sweep gives.
    pub fn branches(self) -> &'static [Direction] {
        match self {
            Sweep::Each(_) => &[Direction::Each],
            Sweep::Down => &[Direction::Down],
            Sweep::Up => &[Direction::Up],
            Sweep::Both => &[Direction::Down, Direction::Up],
        }
    }

    /// Whether the state is carried from column to column.
    pub fn is_carried(self) -> bool {
        !matches!(self, Sweep::Each(_))
    }
}

impl FromStr for Sweep {
    type Err = DiagramError;

    fn from_str(text: &str) -> Result<Self, DiagramError> {
        match text {
            "down" => Ok(Sweep::Down),
            "up" => Ok(Sweep::Up),
            "both" => Ok(Sweep::Both),
            text => match text.parse() {
                Ok(start) => Ok(Sweep::Each(start)),
                Err(StartError::Malformed(_)) => Err(DiagramError::Sweep(text.to_owned())),
                Err(error) => Err(error.into()),
            },
        }
    }
}

impl From<Sweep> for String {
    fn from(sweep: Sweep) -> String {
        sweep.to_string()
    }
}

impl TryFrom<String> for Sweep {
    type Error = DiagramError;

    fn try_from(text: String) -> Result<Self, DiagramError> {
        text.parse()
    }
}

named! {
    /// How the columns of a branch follow each other.
    #[derive(serde::Deserialize)]
    pub enum Direction {
        /// They do not: each begins by itself.
        Each = "each",
        /// With falling values of the axis.
        Down = "down",
        /// With rising values of the axis.
        Up = "up",
    }
}
