//! Why a control method is refused.

use thiserror::Error;

use crate::model::{Number, ParameterError, SystemError};

/// Why a control method was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ControlError {
    /// A setting is out of its range.
    #[error("{name} = {} is out of range: {name} must be {range}", Number(*value))]
    OutOfRange {
        /// The setting.
        name: &'static str,
        /// The value that was refused.
        value: f64,
        /// The range in words.
        range: &'static str,
    },
    /// The target motion does not exist.
    #[error(
        "there is no physical 1-1-1 motion at the reference omega = {} (delta = {}) to take as the target: \
         choose another --reference, or give --target",
        Number(*omega),
        Number(*delta)
    )]
    NoTarget {
        /// The reference frequency.
        omega: f64,
        /// The half clearance.
        delta: f64,
    },
    /// A component of the target is NaN or infinite.
    #[error("the target has a component of {}: give finite numbers", Number(*.0))]
    TargetNotFinite(f64),
    /// The target's velocity leads into the stop.
    #[error("the target velocity v1+ = {} leads into stop A: after an impact there it is 0 or negative", Number(*.0))]
    TargetVelocity(f64),
    /// The target's phase is not one.
    #[error("the target phase tau = {} is out of range: tau must be between 0 and 2π (6.2832)", Number(*.0))]
    TargetPhase(f64),
    /// The reference frequency cannot be used.
    #[error("the reference frequency cannot be used")]
    Reference(#[source] ParameterError),
    /// The system cannot be followed.
    #[error(transparent)]
    System(#[from] SystemError),
}
