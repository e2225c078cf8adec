//! The CPU path in f32: the GPU's twin, which computes what an exact kernel computes, bit for bit.

use super::each::each;
use super::{extents, follow, follow_controlled, trace};
use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::backend::{Backend, BackendError, ControlJob, Job, REPRODUCIBLE, Watch};
use crate::control::{ControlSchedule, Outcome};

/// Follows trajectories on the processor in single precision, one per task of rayon's current thread pool.
///
/// Its results have the bits of [`Gpu::open_exact`](crate::backend::Gpu::open_exact) on any adapter.
#[derive(Clone, Copy, Debug, Default)]
pub struct CpuSingle;

impl Backend for CpuSingle {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        format!("{} f32{REPRODUCIBLE}", std::env::consts::ARCH)
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
        each(jobs, watch, |job| follow::<f32>(job, schedule))
    }

    fn trace(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        probe: Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<Trace>, BackendError> {
        each(jobs, watch, |job| trace::<f32>(job, schedule, probe, capacity))
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Outcome>, BackendError> {
        each(jobs, watch, |job| follow_controlled::<f32>(job, schedule))?.into_iter().collect()
    }

    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>, BackendError> {
        extents::<f32>(jobs, periods, watch)
    }
}
