//! How far the motions go that trajectories settled on.

use super::cpu::each;
use super::{Backend, BackendError, Job, Watch};
use crate::analysis::{Extent, ExtentObserver, Regime, Schedule, Verdict};
use crate::model::{Flight, Real};

/// A periodic motion is followed for at least about so many forcing periods, and whole periods of its own.
const LEAST: u32 = 48;

/// How far the motions go on that some verdicts found: root mean square and peak of every coordinate.
///
/// A trajectory is followed on from where its verdict left it: a periodic one for whole periods of its own, at least 48
/// forcing periods or the observation, any other for as many forcing periods as the schedule observes.
/// [`Extent::NONE`] where the verdict is a failure.
///
/// # Errors
/// What the back end could not do.
pub fn extents(
    backend: &dyn Backend,
    jobs: &[Job],
    verdicts: &[Verdict],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Extent>, BackendError> {
    let open: Vec<usize> = (0..jobs.len()).filter(|&i| verdicts[i].regime != Regime::Failed).collect();
    let again: Vec<Job> =
        open.iter().map(|&i| Job { system: jobs[i].system.clone(), start: verdicts[i].state }).collect();
    let periods: Vec<u32> = open.iter().map(|&i| followed(&verdicts[i], schedule)).collect();
    let measured = backend.extents(&again, &periods, watch)?;
    let mut all = vec![Extent::NONE; jobs.len()];
    for (i, extent) in open.into_iter().zip(measured) {
        all[i] = extent;
    }
    Ok(all)
}

/// For how many forcing periods a trajectory is followed.
fn followed(verdict: &Verdict, schedule: &Schedule) -> u32 {
    match u32::from(verdict.n) {
        0 => schedule.observe,
        n => n * LEAST.min(schedule.observe).div_ceil(n),
    }
}

/// The same on the processor, one trajectory per task of rayon's current thread pool.
pub(super) fn on_processor(
    jobs: &[Job],
    periods: &[u32],
    watch: &dyn Watch,
) -> Result<Vec<Extent>, BackendError> {
    let followed: Vec<(&Job, u32)> = jobs.iter().zip(periods.iter().copied()).collect();
    each(&followed, watch, |&(job, periods)| extent::<f64>(job, periods))
}

/// How far one trajectory goes in so many forcing periods, in the given precision; in f32 it does what the GPU does.
pub fn extent<T: Real>(job: &Job, periods: u32) -> Extent {
    match job.system.plant().n {
        1 => with::<T, 1>(job, periods),
        2 => with::<T, 2>(job, periods),
        3 => with::<T, 3>(job, periods),
        _ => with::<T, 4>(job, periods),
    }
}

fn with<T: Real, const N: usize>(Job { system, start }: &Job, periods: u32) -> Extent {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    ExtentObserver::new(&flight, start.state()).follow(&flight, periods)
}
