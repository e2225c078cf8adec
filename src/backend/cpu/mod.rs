//! The CPU path: f64, the reference, on every core.

mod lanes;

pub use lanes::{Width, follow_all};

use rayon::prelude::*;

use crate::analysis::{Observer, Probe, Schedule, Trace, Tracer, Verdict};
use crate::backend::{Backend, BackendError, ControlJob, Job, Watch};
use crate::control::{ControlSchedule, Outcome, control};
use crate::dynamics::{Event, Trajectory};
use crate::model::{Flight, Real};

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

/// Does every job on one of the pool's threads, until the watch ends it.
pub(super) fn each<J: Sync, R: Send>(
    jobs: &[J],
    watch: &dyn Watch,
    work: impl Fn(&J) -> R + Sync,
) -> Result<Vec<R>, BackendError> {
    let results: Option<Vec<R>> = jobs
        .par_iter()
        .map(|job| {
            if watch.cancelled() {
                return None;
            }
            let result = work(job);
            watch.finished(1);
            Some(result)
        })
        .collect();
    results.ok_or(BackendError::Cancelled)
}

/// Follows one trajectory under control in the given precision; in f32 it does what the GPU does.
///
/// # Errors
/// [`BackendError::Unsupported`] where a force would need too many steps in one forcing period.
pub fn follow_controlled<T: Real>(
    job: &ControlJob,
    schedule: &ControlSchedule,
) -> Result<Outcome, BackendError> {
    let ControlJob { job: Job { system, start }, controller } = job;
    control::<T, _>(system, start, controller, schedule, &mut ())
        .map_err(|error| BackendError::Unsupported(error.to_string()))
}

/// Follows one trajectory in the given precision; in f32 it does what the GPU does.
pub fn follow<T: Precision>(job: &Job, schedule: &Schedule) -> Verdict {
    T::follow(job, schedule)
}

/// Follows one trajectory in the given precision and reads a section while it is observed.
///
/// # Panics
/// If the probe names a component that the system does not have; see [`Probe::fits`].
pub fn trace<T: Precision>(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace {
    T::trace(job, schedule, probe, capacity)
}

/// A precision in which trajectories of any number of coordinates are followed; see [`follow`] and [`trace`].
///
/// It is compiled here, once for each precision, and not again wherever it is used.
pub trait Precision: Real {
    /// See [`follow`].
    fn follow(job: &Job, schedule: &Schedule) -> Verdict;

    /// See [`trace`].
    fn trace(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace;
}

macro_rules! precision {
    ($real:ty) => {
        impl Precision for $real {
            fn follow(job: &Job, schedule: &Schedule) -> Verdict {
                match job.system.plant().n {
                    1 => followed::<$real, 1>(job, schedule),
                    2 => followed::<$real, 2>(job, schedule),
                    3 => followed::<$real, 3>(job, schedule),
                    _ => followed::<$real, 4>(job, schedule),
                }
            }

            fn trace(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace {
                let tracer = Tracer::new(probe, capacity as usize);
                match job.system.plant().n {
                    1 => traced::<$real, 1>(job, schedule, tracer),
                    2 => traced::<$real, 2>(job, schedule, tracer),
                    3 => traced::<$real, 3>(job, schedule, tracer),
                    _ => traced::<$real, 4>(job, schedule, tracer),
                }
            }
        }
    };
}

precision!(f64);
precision!(f32);

/// Follows one trajectory of N coordinates to its end.
fn followed<T: Real, const N: usize>(Job { system, start }: &Job, schedule: &Schedule) -> Verdict {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    let mut observer = Observer::new(&flight, schedule, start.state());
    observer.follow(&flight, schedule);
    observer.verdict(&flight, system.label_order())
}

/// The same, and what is read on a section.
fn traced<T: Real, const N: usize>(
    Job { system, start }: &Job,
    schedule: &Schedule,
    mut tracer: Tracer<T>,
) -> Trace {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    let mut observer = Observer::new(&flight, schedule, start.state());
    observer.follow_listening(&flight, schedule, &mut |trajectory: &Trajectory<T, N>, event: &Event<T>| {
        tracer.see(&flight, trajectory, event);
    });
    tracer.finish(observer.verdict(&flight, system.label_order()))
}
