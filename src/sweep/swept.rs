//! How back ends do what is asked of a cell.

use super::Result;
use crate::analysis::Schedule;
use crate::backend::{self, Backend, ControlJob, Job, Watch, decide};
use crate::plane::{Control, Plane, Task};

/// A task that back ends do.
pub trait Swept: Task {
    /// What a back end is given for a cell.
    type Job: Send + Sync;

    /// What it is given for the cell in a column of a row, with its system and its start; nothing where there is nothing to
    /// do.
    ///
    /// # Errors
    /// What cannot be used.
    fn job(plane: &Plane<Self>, at: (u32, u32), job: Job) -> Result<Option<Self::Job>>;

    /// What a back end finds, one result for each job.
    ///
    /// # Errors
    /// What it could not do.
    fn run(
        &self,
        backend: &dyn Backend,
        jobs: &[Self::Job],
        watch: &dyn Watch,
    ) -> backend::Result<Vec<Self::Cell>>;
}

impl Swept for Schedule {
    type Job = Job;

    fn job(_: &Plane, _: (u32, u32), job: Job) -> Result<Option<Job>> {
        Ok(Some(job))
    }

    fn run(
        &self,
        backend: &dyn Backend,
        jobs: &[Job],
        watch: &dyn Watch,
    ) -> backend::Result<Vec<Self::Cell>> {
        decide(backend, jobs, self, watch)
    }
}

impl Swept for Control {
    type Job = ControlJob;

    fn job(plane: &Plane<Self>, (column, row): (u32, u32), job: Job) -> Result<Option<ControlJob>> {
        if job.system.is_clamped() {
            return Ok(None);
        }
        let controller = plane.scheme_at(column, row).resolve(&job.system)?;
        controller.flown(&job.system)?;
        Ok(Some(ControlJob { job, controller }))
    }

    fn run(
        &self,
        backend: &dyn Backend,
        jobs: &[ControlJob],
        watch: &dyn Watch,
    ) -> backend::Result<Vec<Self::Cell>> {
        backend.control(jobs, &self.schedule, watch)
    }
}
