//! What a back end follows.

use crate::control::Controller;
use crate::model::{StateVector, System};

/// One trajectory to follow: a system and its start at forcing phase 0.
#[derive(Clone, Debug)]
pub struct Job {
    /// The system.
    pub system: System,
    /// (x1 … xn, v1 … vn) at forcing phase 0, within the stops; non-dimensional.
    pub start: StateVector,
}

/// One trajectory to control.
#[derive(Clone, Debug)]
pub struct ControlJob {
    /// The system and the start.
    pub job: Job,
    /// What controls it.
    pub controller: Controller<f64>,
}
