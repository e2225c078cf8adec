//! Why a plane is refused.

use thiserror::Error;

use super::axis_error::AxisError;
use super::start::StartError;
use crate::analysis::ScheduleError;
use crate::control::{ControlError, ControlScheduleError, METHODS};
use crate::model::ParameterError;

/// Why a plane was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlaneError {
    /// Both axes vary the same thing.
    #[error("both axes are {0}: choose two different names")]
    SameAxis(&'static str),
    /// An axis varies a setting of a control method, and there is none.
    #[error("axis {0} is a setting of a control method: choose one with --control {names}", names = names())]
    NoControl(&'static str),
    /// An axis varies a setting that the control method does not have.
    #[error("{method} has no setting {name} to be varied: choose another axis or another --control")]
    NoSuchSetting {
        /// The setting.
        name: &'static str,
        /// The method.
        method: &'static str,
    },
    /// More cells than its task accepts.
    #[error("a plane of {x} × {y} cells is too large: at most {most} cells are accepted")]
    TooLarge {
        /// Columns.
        x: u32,
        /// Rows.
        y: u32,
        /// The most cells: [`Task::LARGEST`](super::Task::LARGEST).
        most: u64,
    },
    /// An axis over a start component needs a start that it can change.
    #[error("an axis over a component of the start needs --start rest or --start X1,X2,V1,V2, not symmetric")]
    SymmetricStartVaried,
    /// An axis cannot be used.
    #[error(transparent)]
    Axis(#[from] AxisError),
    /// The schedule cannot be used.
    #[error(transparent)]
    Schedule(#[from] ScheduleError),
    /// The schedule of control cannot be used.
    #[error(transparent)]
    ControlSchedule(#[from] ControlScheduleError),
    /// A setting of the control method cannot be used.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// A parameter cannot be used.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No cell begins between its stops.
    #[error(
        "no cell of the plane begins between its stops: of the first, {0}; choose starts within the gaps: --start gives what \
         no axis varies, 0 by default where one varies a component"
    )]
    Nowhere(StartError),
    /// A start cannot be used.
    #[error(transparent)]
    Start(#[from] StartError),
}

/// The names of the methods, with an `or` before the last.
fn names() -> String {
    let names: Vec<&str> = METHODS.iter().map(|method| method.name).collect();
    let (last, others) = names.split_last().expect("there are methods");
    format!("{} or {last}", others.join(", "))
}
