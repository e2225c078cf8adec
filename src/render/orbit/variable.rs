//! The quantities along the axes of an orbit's plots.

use super::panel_error::PanelError;
use crate::analysis::Reading;
use crate::system::Family;

/// A quantity on an axis of an orbit's plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// The time since the recording began, in forcing periods.
    Time,
    /// Anything else.
    Reading(Reading),
}

impl Variable {
    /// The quantity of a name in a family.
    ///
    /// # Errors
    /// [`PanelError::Variable`] with the quantities that there are.
    pub fn named(name: &str, family: &Family) -> Result<Self, PanelError> {
        match name {
            "t" => Ok(Variable::Time),
            name => Reading::named(name, family).map(Variable::Reading).map_err(|_| {
                let known: Vec<String> =
                    Reading::all(family).iter().map(|reading| reading.name(family)).collect();
                PanelError::Variable { name: name.to_owned(), known: known.join(", ") }
            }),
        }
    }

    /// The name in a family.
    pub fn name(self, family: &Family) -> String {
        match self {
            Variable::Time => "t".to_owned(),
            Variable::Reading(reading) => reading.name(family),
        }
    }
}
