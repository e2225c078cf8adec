//! The CPU path: f64, the reference, on every core.

use rayon::prelude::*;

use super::{Backend, BackendError, ControlJob, Job, Watch};
use crate::analysis::{Observer, Probe, Schedule, Trace, Tracer, Verdict};
use crate::control::{ControlSchedule, Outcome, control};
use crate::dynamics::{Event, Trajectory};
use crate::model::{Flight, Real, State};

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
        each(jobs, watch, |job| follow::<f64>(job, schedule))
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
fn each<J: Sync, R: Send>(
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
    control::<T, _>(system, *start, controller, schedule, &mut ())
        .map_err(|error| BackendError::Unsupported(error.to_string()))
}

/// Follows one trajectory in the given precision; in f32 it does what the GPU does.
pub fn follow<T: Real>(job: &Job, schedule: &Schedule) -> Verdict {
    let flight = Flight::<f64, 2>::new(&job.system).round::<T>();
    let mut observer = Observer::new(&flight, schedule, State::from_slice(&job.start.map(T::of)));
    follow_to_end(&mut observer, &flight, schedule);
    observer.verdict(&flight)
}

/// Follows one trajectory in the given precision and reads a section while it is observed.
pub fn trace<T: Real>(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace {
    let flight = Flight::<f64, 2>::new(&job.system).round::<T>();
    let mut observer = Observer::new(&flight, schedule, State::from_slice(&job.start.map(T::of)));
    let mut tracer = Tracer::new(probe, capacity as usize);
    trace_to_end(&mut observer, &flight, schedule, &mut tracer);
    tracer.finish(observer.verdict(&flight))
}

/// [`Observer::follow`] with the instructions of the processor at hand; no operation is contracted or reordered, so
/// the results do not depend on them.
#[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+fma+lzcnt"))]
fn follow_to_end<T: Real, const N: usize>(
    observer: &mut Observer<T, N>,
    flight: &Flight<T, N>,
    schedule: &Schedule,
) {
    observer.follow(flight, schedule);
}

/// The same for [`Observer::follow_listening`].
#[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+fma+lzcnt"))]
fn trace_to_end<T: Real, const N: usize>(
    observer: &mut Observer<T, N>,
    flight: &Flight<T, N>,
    schedule: &Schedule,
    tracer: &mut Tracer<T>,
) {
    observer.follow_listening(flight, schedule, &mut |trajectory: &Trajectory<T, N>, event: &Event<T>| {
        tracer.see(flight, trajectory, event);
    });
}
