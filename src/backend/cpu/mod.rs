//! The CPU path: f64, the reference, on every core.

mod each;
mod extent;
mod follow;
mod lanes;
mod single;

pub use extent::extent;
pub(super) use extent::extents;
pub use follow::{Precision, follow, follow_controlled, trace};
pub use lanes::{Width, follow_all, follow_counted};
pub use single::CpuSingle;

use crate::analysis::{Probe, Schedule, Trace, Verdict};
use crate::backend::{Backend, BackendError, ControlJob, Job, Watch};
use crate::control::{ControlSchedule, Outcome};

use each::each;

/// Follows trajectories on the processor, one per task of rayon's current thread pool.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

impl Backend for Cpu {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        format!("{} f64", std::env::consts::ARCH)
    }

    fn tile(&self) -> usize {
        1 << 14
    }

    fn run(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Verdict>, BackendError> {
        follow_all(jobs, schedule, watch, Width::available()[0])
    }

    fn trace(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        probe: Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<Trace>, BackendError> {
        each(jobs, watch, |job| trace::<f64>(job, schedule, probe, capacity))
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Outcome>, BackendError> {
        each(jobs, watch, |job| follow_controlled::<f64>(job, schedule))?.into_iter().collect()
    }
}
