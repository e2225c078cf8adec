//! Why a diagram is refused.

use thiserror::Error;

use crate::analysis::ScheduleError;
use crate::model::{Number, ParameterError};
use crate::plane::{AxisError, StartError};

/// The most readings that a diagram may have to hold.
pub(super) const MOST_READINGS: u64 = 1 << 27;

/// Why a diagram was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DiagramError {
    /// The probe is of another system.
    #[error("{0} has no such section, or no such quantity on it: choose its own stops and components")]
    Probe(&'static str),
    /// No such way to begin.
    #[error(
        "`{0}` is no sweep: write rest, symmetric, a state X1,X2,V1,V2 (x1 … xn, v1 … vn), down, up or both"
    )]
    Sweep(String),
    /// Nothing, or too much, would be kept.
    #[error(
        "{columns} columns with up to {capacity} points each cannot be kept: give --points 1 or more, and at most {} in \
         all (by default 16 for each period observed)",
        MOST_READINGS
    )]
    Capacity {
        /// Columns.
        columns: u32,
        /// Readings of each.
        capacity: u32,
    },
    /// Diagrams are of motion without control.
    #[error(
        "axis {0} is a setting of a control method, and a diagram has none: choose a parameter or a component of \
         the start, or draw a map --control"
    )]
    Control(&'static str),
    /// A carried state has no start that could be varied.
    #[error("--sweep {sweep} carries the state along, and --x {axis} varies the start: choose --sweep rest")]
    CarriedStart {
        /// The axis.
        axis: String,
        /// The sweep.
        sweep: String,
    },
    /// An axis over a start component needs a start that it can change.
    #[error("an axis over a component of the start needs --sweep rest or --sweep X1,X2,V1,V2, not symmetric")]
    SymmetricStartVaried,
    /// The axis cannot be used.
    #[error(transparent)]
    Axis(#[from] AxisError),
    /// The schedule cannot be used.
    #[error(transparent)]
    Schedule(#[from] ScheduleError),
    /// A parameter cannot be used.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// No column begins between its stops.
    #[error("no column begins between its stops: of the first, {0}; choose starts within the gaps")]
    Nowhere(StartError),
    /// The column that a sweep begins with would begin beyond a stop.
    #[error("the sweep {} begins at {axis} = {}, where {why}; choose --start within the gap there", direction, Number(*value))]
    Beyond {
        /// Which sweep.
        direction: &'static str,
        /// What the axis varies.
        axis: &'static str,
        /// Its value there.
        value: f64,
        /// Why it is refused.
        why: StartError,
    },
    /// A start cannot be used.
    #[error(transparent)]
    Start(#[from] StartError),
}
