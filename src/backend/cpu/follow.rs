//! One trajectory, followed by itself in either precision.

use crate::analysis::{Observer, Probe, Schedule, Trace, Tracer, Verdict};
use crate::backend::error::BackendError;
use crate::backend::job::{ControlJob, Job};
use crate::control::{ControlSchedule, Outcome, control};
use crate::dynamics::{Event, Trajectory};
use crate::model::{Flight, Real};

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

/// Follows one trajectory in the given precision and reads a section while it is observed; where the schedule leaves the
/// periods open, in observations that are discarded too.
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
                match job.system.coordinates() {
                    1 => followed::<$real, 1>(job, schedule),
                    2 => followed::<$real, 2>(job, schedule),
                    3 => followed::<$real, 3>(job, schedule),
                    _ => followed::<$real, 4>(job, schedule),
                }
            }

            fn trace(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace {
                let tracer = Tracer::new(probe, capacity as usize);
                match job.system.coordinates() {
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
