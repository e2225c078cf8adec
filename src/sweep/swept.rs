//! How back ends do what is asked of a cell.

use super::Result;
use crate::analysis::Schedule;
use crate::backend::{self, Backend, ControlJob, Job, Watch, decide};
use crate::model::{Flows, SystemError};
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

/// The column and the row of a cell, counted row by row.
fn place<T>(plane: &Plane<T>, cell: u64) -> (u32, u32) {
    let columns = u64::from(plane.x.count);
    ((cell % columns) as u32, (cell / columns) as u32)
}

/// The system and the start of a cell, counted row by row; it shares what follows from its flow with cells before it.
pub(super) fn cell_job<T>(plane: &Plane<T>, cell: u64, flows: &Flows) -> Result<Job, SystemError> {
    let (column, row) = place(plane, cell);
    let system = flows.system(plane.parameters_at(column, row))?;
    let start = plane.start_at(column, row).state(&system);
    Ok(Job { system, start })
}

/// What a back end is given for a cell, counted row by row.
pub(super) fn asked_of<T: Swept>(plane: &Plane<T>, cell: u64, flows: &Flows) -> Result<Option<T::Job>> {
    T::job(plane, place(plane, cell), cell_job(plane, cell, flows)?)
}
