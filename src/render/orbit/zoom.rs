//! The range that the axes over a quantity show.

use std::str::FromStr;

use super::panel_error::PanelError;
use super::variable::Variable;
use crate::model::Number;
use crate::system::Family;

/// The range that every axis over a quantity shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zoom {
    /// The quantity.
    pub variable: Variable,
    /// The least value shown.
    pub low: f64,
    /// The largest value shown.
    pub high: f64,
}

impl Zoom {
    /// Reads `NAME=LOW:HIGH` with the names of a family.
    ///
    /// # Errors
    /// [`PanelError`] with what is wrong.
    pub fn of_family(text: &str, family: &Family) -> Result<Self, PanelError> {
        let malformed = || PanelError::Zoom(text.to_owned());
        let (name, range) = text.split_once('=').ok_or_else(malformed)?;
        let variable = Variable::named(name.trim(), family)?;
        let (low, high) = range.split_once(':').ok_or_else(malformed)?;
        let low: f64 = low.trim().parse().map_err(|_| malformed())?;
        let high: f64 = high.trim().parse().map_err(|_| malformed())?;
        if !low.is_finite() || !high.is_finite() || low >= high {
            return Err(PanelError::EmptyZoom(text.to_owned()));
        }
        Ok(Zoom { variable, low, high })
    }

    /// The text that [`Zoom::of_family`] reads.
    pub fn name(&self, family: &Family) -> String {
        format!("{}={}:{}", self.variable.name(family), Number(self.low), Number(self.high))
    }
}

/// As [`Zoom::of_family`] for the paper's family.
impl FromStr for Zoom {
    type Err = PanelError;

    fn from_str(text: &str) -> Result<Self, PanelError> {
        Zoom::of_family(text, Family::paper())
    }
}
