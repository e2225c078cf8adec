//! The precisions in which trajectories of any number of coordinates are followed.

use super::each::each;
use super::follow::{followed, traced};
use super::lanes::spread;
use crate::analysis::{Probe, Schedule, Trace, Tracer, Verdict};
use crate::backend::error::BackendError;
use crate::backend::job::Job;
use crate::backend::watch::Watch;
use crate::dynamics::Usage;
use crate::model::{Real, Width};

/// Follows one trajectory in the given precision; in f32 it does what the GPU does. [`Schedule::check`] is the caller's to ask.
pub fn follow<T: Precision>(job: &Job, schedule: &Schedule) -> Verdict {
    T::follow(job, schedule)
}

/// See [`follow_counted`].
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub fn follow_all<T: Precision>(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<Vec<Verdict>, BackendError> {
    follow_counted::<T>(jobs, schedule, watch, width).map(|(verdicts, _)| verdicts)
}

/// Follows every job in the given precision as [`follow`] does, as many trajectories at once as `width` has lanes on each thread of
/// rayon's current pool; one by one where they have not equally many coordinates. Says how well the lanes were used, too.
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub fn follow_counted<T: Precision>(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<(Vec<Verdict>, Usage), BackendError> {
    let coordinates = |job: &Job| job.system.coordinates();
    let are_alike = |first: &Job| jobs.iter().all(|job| coordinates(job) == coordinates(first));
    if width == Width::One || !jobs.first().is_some_and(are_alike) {
        return each(jobs, watch, |job| follow::<T>(job, schedule)).map(|found| (found, Usage::default()));
    }
    T::follow_abreast(jobs, schedule, watch, width)
}

/// Follows one trajectory in the given precision and reads a section while it is observed; where the schedule leaves the
/// periods open, in observations that are discarded too.
///
/// # Panics
/// If the probe names a component that the system does not have; see [`Probe::fits`].
pub fn trace<T: Precision>(job: &Job, schedule: &Schedule, probe: Probe, capacity: u32) -> Trace {
    T::trace(job, schedule, probe, capacity)
}

/// A precision in which trajectories of any number of coordinates are followed; see [`follow`], [`follow_counted`] and [`trace`].
///
/// It is compiled here, once for each precision, and not again wherever it is used.
pub trait Precision: Real {
    /// See [`follow`].
    fn follow(job: &Job, schedule: &Schedule) -> Verdict;

    /// See [`follow_counted`]; there is at least one job, and all have equally many coordinates.
    ///
    /// # Errors
    /// As there.
    fn follow_abreast(
        jobs: &[Job],
        schedule: &Schedule,
        watch: &dyn Watch,
        width: Width,
    ) -> Result<(Vec<Verdict>, Usage), BackendError>;

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

            fn follow_abreast(
                jobs: &[Job],
                schedule: &Schedule,
                watch: &dyn Watch,
                width: Width,
            ) -> Result<(Vec<Verdict>, Usage), BackendError> {
                match jobs[0].system.coordinates() {
                    1 => spread::<$real, 1>(jobs, schedule, watch, width),
                    2 => spread::<$real, 2>(jobs, schedule, watch, width),
                    3 => spread::<$real, 3>(jobs, schedule, watch, width),
                    _ => spread::<$real, 4>(jobs, schedule, watch, width),
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
