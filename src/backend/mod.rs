//! Back ends: one trait, the CPU's f64 reference and the GPU's f32 kernel behind it.

mod cpu;
mod decide;
mod extents;
mod gpu;
mod select;

pub use cpu::{Cpu, Precision, Width, follow, follow_all, follow_controlled, trace};
pub use decide::{CHAOS_LOOK, LONGER_OBSERVATION, SECOND_LOOK, decide, second_look};
pub use extents::{extent, extents};
pub use gpu::{AdapterReport, Gpu, adapters};
pub use select::{Choice, open};

use std::fmt::Debug;

use thiserror::Error;

use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::control::{ControlSchedule, Controller, Outcome};
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

/// Hears how a run goes on, and may end it.
pub trait Watch: Sync {
    /// `cells` more trajectories are finished.
    fn finished(&self, cells: u64);
    /// Whether the run should stop at the next chance.
    fn cancelled(&self) -> bool;
}

/// A watch that hears nothing and lets everything run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn finished(&self, _cells: u64) {}
    fn cancelled(&self) -> bool {
        false
    }
}

/// A watch that ends a run like another, and counts nothing there: for cells that are counted elsewhere.
#[derive(Clone, Copy)]
pub struct Silent<'a>(pub &'a dyn Watch);

impl Watch for Silent<'_> {
    fn finished(&self, _cells: u64) {}
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

/// Something that follows trajectories and classifies them.
///
/// The verdicts depend on the jobs and the schedule alone: not on how jobs are split into calls, on the number
/// of threads, or on what ran before.
pub trait Backend: Debug + Sync {
    /// "cpu" or "gpu".
    fn name(&self) -> &'static str;

    /// What computes: the adapter's name and driver, or the processor path.
    fn adapter(&self) -> String;

    /// How many jobs a call should hold to keep this back end busy within bounded memory.
    fn tile(&self) -> usize;

    /// Follows every job and gives one verdict per job, in order.
    ///
    /// # Errors
    /// [`BackendError::Cancelled`] when the watch asked for it, otherwise what the machine could not do.
    fn run(&self, jobs: &[Job], schedule: &Schedule, watch: &dyn Watch)
    -> Result<Vec<Verdict>, BackendError>;

    /// Follows every job under control and gives one outcome per job, in order.
    ///
    /// # Errors
    /// As [`Backend::run`], and [`BackendError::Unsupported`] for a method that this back end does not have.
    fn control(
        &self,
        _jobs: &[ControlJob],
        _schedule: &ControlSchedule,
        _watch: &dyn Watch,
    ) -> Result<Vec<Outcome>, BackendError> {
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
    ) -> Result<Vec<Trace>, BackendError> {
        Err(BackendError::Unsupported(format!("{} reads no sections", self.name())))
    }

    /// Follows every job for so many forcing periods and measures how far it goes; on the processor, unless this back end
    /// has a way of its own.
    ///
    /// # Errors
    /// Those of [`Backend::run`].
    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>, BackendError> {
        extents::on_processor(jobs, periods, watch)
    }
}

/// Why a back end gave no verdicts.
#[derive(Debug, Error)]
pub enum BackendError {
    /// The watch asked to stop.
    #[error("interrupted")]
    Cancelled,
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
