//! Why a back end gave no results.

use thiserror::Error;

use crate::analysis::ScheduleError;
use crate::control::ControlScheduleError;

/// What a back end comes to.
pub type Result<T, E = BackendError> = std::result::Result<T, E>;

/// Why a back end gave no verdicts.
#[derive(Debug, Error)]
pub enum BackendError {
    /// The watch asked to stop.
    #[error("interrupted")]
    Cancelled,
    /// The schedule cannot be followed.
    #[error(transparent)]
    Schedule(#[from] ScheduleError),
    /// The schedule cannot be followed under control.
    #[error(transparent)]
    ControlSchedule(#[from] ControlScheduleError),
    /// No adapter is there, or none that matches.
    #[error("{0}")]
    NoAdapter(String),
    /// The back end does not have what is asked for.
    #[error("{0}")]
    Unsupported(String),
    /// The device failed: lost, out of memory, or a refused shader.
    #[error("the GPU could not finish: {0}")]
    Device(String),
}
