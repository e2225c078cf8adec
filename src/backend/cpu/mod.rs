//! The CPU path: f64, the reference, and f32, the GPU's twin, on every core.

mod each;
mod extent;
mod follow;
mod lanes;
mod precision;

pub use extent::extent;
pub(super) use extent::extents;
pub use follow::follow_controlled;
pub use precision::{Precision, follow, follow_all, follow_counted, trace};

use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::backend::{Backend, BackendError, ControlJob, Job, REPRODUCIBLE, Watch};
use crate::control::{ControlSchedule, Outcome};
use crate::model::Width;

use each::each;

/// Follows trajectories on the processor, one per task of rayon's current thread pool.
#[derive(Clone, Copy, Debug, Default)]
pub struct Cpu;

/// The same in single precision: its results have the bits of [`Gpu::open_exact`](crate::backend::Gpu::open_exact) on any
/// adapter.
#[derive(Clone, Copy, Debug, Default)]
pub struct CpuSingle;

/// A back end of a precision, and what its adapter is called beside the processor.
macro_rules! on_the_processor {
    ($name:ident, $real:ty, $adapter:expr) => {
        impl Backend for $name {
            fn name(&self) -> &'static str {
                "cpu"
            }

            fn adapter(&self) -> String {
                format!("{} {}", std::env::consts::ARCH, $adapter)
            }

            fn tile(&self) -> usize {
                1 << 15
            }

            fn run(
                &self,
                jobs: &[Job],
                schedule: &Schedule,
                watch: &dyn Watch,
            ) -> Result<Vec<Verdict>, BackendError> {
                schedule.check()?;
                follow_all::<$real>(jobs, schedule, watch, Width::widest())
            }

            fn trace(
                &self,
                jobs: &[Job],
                schedule: &Schedule,
                probe: Probe,
                capacity: u32,
                watch: &dyn Watch,
            ) -> Result<Vec<Trace>, BackendError> {
                schedule.check()?;
                each(jobs, watch, |job| trace::<$real>(job, schedule, probe, capacity))
            }

            fn control(
                &self,
                jobs: &[ControlJob],
                schedule: &ControlSchedule,
                watch: &dyn Watch,
            ) -> Result<Vec<Outcome>, BackendError> {
                schedule.check()?;
                each(jobs, watch, |job| follow_controlled::<$real>(job, schedule))?.into_iter().collect()
            }

            fn extents(
                &self,
                jobs: &[Job],
                periods: &[u32],
                watch: &dyn Watch,
            ) -> Result<Vec<Extent>, BackendError> {
                extents::<$real>(jobs, periods, watch)
            }
        }
    };
}

on_the_processor!(Cpu, f64, "f64");
on_the_processor!(CpuSingle, f32, format_args!("f32{REPRODUCIBLE}"));
