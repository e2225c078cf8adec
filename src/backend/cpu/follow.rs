//! One trajectory, followed by itself in either precision.

use crate::analysis::{Observer, Schedule, Trace, Tracer, Verdict};
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

/// Follows one trajectory of N coordinates to its end.
pub(super) fn followed<T: Real, const N: usize>(Job { system, start }: &Job, schedule: &Schedule) -> Verdict {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    let mut observer = Observer::new(&flight, schedule, start.state());
    observer.follow(&flight, schedule);
    observer.verdict(&flight, system.label_order())
}

/// The same, and what is read on a section.
pub(super) fn traced<T: Real, const N: usize>(
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
