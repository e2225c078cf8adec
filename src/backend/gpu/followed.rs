//! What the kernels follow, whatever else each is asked of it.

use crate::backend::{ControlJob, Job};

/// Something with a trajectory to follow.
pub trait Followed: Sync {
    /// The trajectory.
    fn job(&self) -> &Job;
}

impl Followed for Job {
    fn job(&self) -> &Job {
        self
    }
}

impl Followed for ControlJob {
    fn job(&self) -> &Job {
        &self.job
    }
}

/// For so many forcing periods.
impl Followed for (&Job, u32) {
    fn job(&self) -> &Job {
        self.0
    }
}
