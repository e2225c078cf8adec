//! The two parameters of a plane, along which curves run.

use thiserror::Error;

use super::unknowns::Span;
use crate::figure::Steps;
use crate::plane::{Axis, Plane, Quantity};

/// Why there are no curves.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CurvesError {
    /// An axis varies the start.
    #[error(
        "bifurcation curves depend on parameters, not on the start: let both axes be parameters instead of {0}"
    )]
    NotAParameter(&'static str),
    /// An axis has no extent.
    #[error("bifurcation curves need a range of {0}, not a single value")]
    SingleValue(&'static str),
    /// The request was cancelled.
    #[error("interrupted")]
    Cancelled,
}

/// The two parameters of a plane.
pub(super) fn spans(plane: &Plane) -> Result<[Span; 2], CurvesError> {
    Ok([span(&plane.x)?, span(&plane.y)?])
}

/// Whether a plane can have curves: whether both of its axes are ranges of parameters.
///
/// # Errors
/// [`CurvesError`] with the axis that is not.
pub fn check(plane: &Plane) -> Result<(), CurvesError> {
    spans(plane).map(drop)
}

fn span(axis: &Axis) -> Result<Span, CurvesError> {
    let name = axis.quantity.name();
    match axis.quantity {
        Quantity::Parameter(_) if axis.first == axis.last => Err(CurvesError::SingleValue(name)),
        Quantity::Parameter(parameter) => {
            let Steps { first, last, spacing, .. } = axis.steps;
            Ok(Span { parameter, first, last, spacing })
        }
        Quantity::Start(_) | Quantity::Control(_) => Err(CurvesError::NotAParameter(name)),
    }
}
