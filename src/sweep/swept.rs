//! How back ends do what is asked of a cell.

use super::{Result, SweepError};
use crate::analysis::{Schedule, Verdict};
use crate::backend::{self, Backend, ControlJob, Doubts, Job, Watch, confirmed_by, decide};
use crate::model::StateVector;
use crate::plane::{Control, Plane, Task};

/// Why a back end is given nothing for a cell.
#[derive(Debug)]
pub(super) enum Without {
    /// It would begin beyond a stop, with (x1 … xn, v1 … vn): no motion begins there.
    Inadmissible(StateVector),
    /// It cannot be used.
    Refused(SweepError),
}

/// A task that back ends do.
pub trait Swept: Task {
    /// What a back end is given for a cell.
    type Job: Send + Sync;

    /// What of its cells is in doubt and waits to be looked at for longer.
    type Doubts: Sync;

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

    /// What keeps track of what is in doubt.
    fn doubts(&self) -> Self::Doubts;

    /// What a back end finds first, one result for each job: those in doubt may change.
    ///
    /// # Errors
    /// What the back end could not do.
    fn begin(
        &self,
        backend: &dyn Backend,
        jobs: &[Self::Job],
        watch: &dyn Watch,
    ) -> backend::Result<Vec<Self::Cell>>;

    /// Lets jobs wait among the doubts whose first results call for it, each under the `number` of its place among them.
    fn put_off(
        &self,
        jobs: &[Self::Job],
        found: &[Self::Cell],
        number: impl Fn(usize) -> u64,
        doubts: &Self::Doubts,
    );

    /// Looks at what is in doubt where at least so many wait for the same; what that decides, with its number.
    ///
    /// # Errors
    /// What the back end could not do.
    fn settle(
        &self,
        backend: &dyn Backend,
        doubts: &Self::Doubts,
        least: usize,
        watch: &dyn Watch,
    ) -> backend::Result<Vec<(u64, Self::Cell)>>;
}

impl Swept for Schedule {
    type Job = Job;
    type Doubts = Doubts;

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

    fn doubts(&self) -> Doubts {
        Doubts::of(self)
    }

    fn begin(&self, backend: &dyn Backend, jobs: &[Job], watch: &dyn Watch) -> backend::Result<Vec<Verdict>> {
        confirmed_by(backend, jobs, self, watch)
    }

    fn put_off(&self, jobs: &[Job], found: &[Verdict], number: impl Fn(usize) -> u64, doubts: &Doubts) {
        doubts.put_off(jobs, found, number);
    }

    fn settle(
        &self,
        backend: &dyn Backend,
        doubts: &Doubts,
        least: usize,
        watch: &dyn Watch,
    ) -> backend::Result<Vec<(u64, Verdict)>> {
        doubts.settle(backend, least, watch)
    }
}

impl Swept for Control {
    type Job = ControlJob;
    type Doubts = ();

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

    fn doubts(&self) {}

    fn begin(
        &self,
        backend: &dyn Backend,
        jobs: &[ControlJob],
        watch: &dyn Watch,
    ) -> backend::Result<Vec<Self::Cell>> {
        self.run(backend, jobs, watch)
    }

    fn put_off(&self, _: &[ControlJob], _: &[Self::Cell], _: impl Fn(usize) -> u64, (): &()) {}

    fn settle(
        &self,
        _: &dyn Backend,
        (): &(),
        _: usize,
        _: &dyn Watch,
    ) -> backend::Result<Vec<(u64, Self::Cell)>> {
        Ok(Vec::new())
    }
}
