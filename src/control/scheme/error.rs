//! Why a control method is refused.

use thiserror::Error;

use crate::model::{ParameterError, SystemError};

/// Why a control method was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ControlError {
    /// A setting is out of its range.
    #[error("{name} = {value} is out of range: {name} must be {range}")]
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
        "there is no physical 1-1-1 motion at the reference omega = {omega} (delta = {delta}) to take as the target: \
         choose another --reference, or give --target"
    )]
    NoTarget {
        /// The reference frequency.
        omega: f64,
        /// The half clearance.
        delta: f64,
    },
    /// A component of the target is NaN or infinite.
    #[error("the target has a component of {0}: give finite numbers")]
    TargetNotFinite(f64),
    /// The target's velocity leads into the stop.
    #[error("the target velocity v1+ = {0} leads into stop A: after an impact there it is 0 or negative")]
    TargetVelocity(f64),
    /// The target's phase is not one.
    #[error("the target phase tau = {0} is out of range: tau must be between 0 and 2π (6.2832)")]
    TargetPhase(f64),
    /// The reference frequency cannot be used.
    #[error("the reference frequency cannot be used")]
    Reference(#[source] ParameterError),
    /// The system cannot be followed.
    #[error(transparent)]
    System(#[from] SystemError),
}
