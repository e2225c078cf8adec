//! Back ends: one trait, the CPU's f64 reference and the GPU's f32 kernel behind it.

mod cpu;
mod decide;
mod error;
mod extents;
mod gpu;
mod in_flight;
mod job;
mod joined;
mod looks;
mod reproducible;
mod select;
mod watch;

pub use cpu::{
    Cpu, CpuSingle, Precision, extent, follow, follow_all, follow_controlled, follow_counted, trace,
};
pub use decide::{Doubts, decide};
pub use error::{BackendError, Result};
pub use extents::extents;
pub use gpu::{AdapterReport, Gpu, Spent, adapters, hardware_shader};
pub(crate) use in_flight::in_flight;
pub use job::{ControlJob, Job};
pub use looks::{CHAOS_LOOK, LONG_LOOK, LONGER_OBSERVATION, confirmed_by, long_look};
pub use reproducible::REPRODUCIBLE;
pub use select::{Choice, open, open_reproducible};
pub use watch::{Silent, Unwatched, Watch};

use std::fmt::Debug;

use in_flight::IN_FLIGHT;
use joined::joined_in_flight;

use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::control::{ControlSchedule, Outcome};

/// Something that follows trajectories and classifies them.
///
/// The verdicts depend on the jobs and the schedule alone: not on how jobs are split into calls, on the number
/// of threads, or on what ran before.
pub trait Backend: Debug + Send + Sync {
    /// "cpu" or "gpu".
    fn name(&self) -> &'static str;

    /// What computes: the adapter's name and driver, or the processor path.
    fn adapter(&self) -> String;

    /// How many jobs a call should hold to keep this back end busy within bounded memory.
    fn tile(&self) -> usize;

    /// How many such calls at a time keep it busy.
    fn calls(&self) -> usize {
        IN_FLIGHT
    }

    /// Follows every job and gives one verdict per job, in order.
    ///
    /// # Errors
    /// [`BackendError::Schedule`] for one that cannot be followed, [`BackendError::Cancelled`] when the watch asked for it,
    /// otherwise what the machine could not do.
    fn run(&self, jobs: &[Job], schedule: &Schedule, watch: &dyn Watch) -> Result<Vec<Verdict>>;

    /// Follows every job under control and gives one outcome per job, in order.
    ///
    /// # Errors
    /// [`BackendError::ControlSchedule`] for one that cannot be followed, otherwise as [`Backend::run`], and
    /// [`BackendError::Unsupported`] for a method that this back end does not have.
    fn control(
        &self,
        _jobs: &[ControlJob],
        _schedule: &ControlSchedule,
        _watch: &dyn Watch,
    ) -> Result<Vec<Outcome>> {
        Err(BackendError::Unsupported(format!("{} follows nothing under control", self.name())))
    }

    /// Follows every job and reads a section while it is observed: at most the first `capacity` passages of each, in
    /// order.
    ///
    /// # Errors
    /// Those of [`Backend::run`], and [`BackendError::Unsupported`] where this back end reads no sections.
    fn trace(
        &self,
        _jobs: &[Job],
        _schedule: &Schedule,
        _probe: Probe,
        _capacity: u32,
        _watch: &dyn Watch,
    ) -> Result<Vec<Trace>> {
        Err(BackendError::Unsupported(format!("{} reads no sections", self.name())))
    }

    /// Follows every job for so many forcing periods and measures how far it goes; on the processor, unless this back end
    /// has a way of its own.
    ///
    /// # Errors
    /// Those of [`Backend::run`].
    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>> {
        cpu::extents::<f64>(jobs, periods, watch)
    }
}
