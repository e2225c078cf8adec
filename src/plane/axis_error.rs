//! Why an axis is refused.

use thiserror::Error;

use crate::model::ParameterError;

/// The most values an axis may have.
pub(super) const MOST_VALUES: u32 = 65_536;

/// Why an axis was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AxisError {
    /// Not of the form NAME=FIRST:LAST:COUNT or NAME=FIRST:LAST:COUNT:log.
    #[error(
        "`{0}` is not an axis: write NAME=FIRST:LAST:COUNT, for example omega=0.2:5:800, with :log behind it for \
         equal ratios"
    )]
    Malformed(String),
    /// Neither a parameter nor a component of the start.
    #[error(
        "unknown axis `{name}`; an axis is one of the parameters or a component of the start: {known} (or, with \
         --control, a setting of the method: {settings})"
    )]
    UnknownName {
        /// The name.
        name: String,
        /// The names that there are.
        known: String,
        /// Those of settings.
        settings: String,
    },
    /// Of a quantity that systems of the family do not have.
    #[error(
        "axis {name} is of another system than {family}: read axes by the names of the plane's own system"
    )]
    Foreign {
        /// The axis.
        name: &'static str,
        /// The family.
        family: String,
    },
    /// Ends and a count that do not fit each other, or the quantity.
    #[error("axis {axis} {problem}")]
    Ends {
        /// The axis as far as it is at fault.
        axis: String,
        /// What is wrong with it, and the remedy.
        problem: &'static str,
    },
    /// Too few or too many values.
    #[error("axis {name} has a COUNT of {count}: give 1 to {}", MOST_VALUES)]
    Count {
        /// The axis.
        name: &'static str,
        /// The count that was asked for.
        count: u64,
    },
    /// An end is outside the physical range of the parameter.
    #[error("an end of the axis cannot be used")]
    Parameter(#[from] ParameterError),
}
