//! Why a plot of an orbit is refused.

use thiserror::Error;

use crate::analysis::SectionError;

/// Why a plot of an orbit was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PanelError {
    /// No plot has that name.
    #[error(
        "unknown panel `{0}`; the panels are portrait, portrait2, time, section, section-b, strobe (a number names \
         the coordinate, what stands behind section- the stop, where the system has it)"
    )]
    Panel(String),
    /// Two quantities are missing.
    #[error("`{0}` names no two quantities: write them after a colon, for example section:x2,v2")]
    Axes(String),
    /// The same quantity twice.
    #[error("`{0}` has the same quantity on both axes: choose two")]
    SameAxes(String),
    /// A phase portrait and a time series show the state.
    #[error(
        "{0} in `{1}` is no component of the state, which phase portraits and time series show: choose from x1 … xn, v1 … vn"
    )]
    NotAComponent(String, String),
    /// A section does not have the quantity.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// No axis has that name.
    #[error("unknown quantity `{name}`; axes are t (in forcing periods), {known}")]
    Variable {
        /// The name.
        name: String,
        /// The quantities that there are.
        known: String,
    },
    /// Not of the form NAME=LOW:HIGH.
    #[error("`{0}` is not a range: write NAME=LOW:HIGH, for example t=2.1:2.4")]
    Zoom(String),
    /// Nothing between the ends.
    #[error("the range `{0}` is empty: the first number must be less than the second, both finite")]
    EmptyZoom(String),
}
