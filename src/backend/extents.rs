//! How far the motions go that trajectories settled on.

use super::{Backend, Job, Result, Watch};
use crate::analysis::{Extent, Regime, Schedule, Verdict};

/// A periodic motion is followed for at least about so many forcing periods, and whole periods of its own.
const LEAST: u32 = 48;

/// How far the motions go on that some verdicts found: root mean square and peak of every coordinate.
///
/// A trajectory is followed on from where its verdict left it: a periodic one for whole periods of its own, at least 48
/// forcing periods or the observation, any other for as many forcing periods as the schedule observes.
/// [`Extent::NONE`] where the verdict is a failure. Jobs begin between the stops: none is inadmissible.
///
/// # Errors
/// What the back end could not do.
pub fn extents(
    backend: &dyn Backend,
    jobs: &[Job],
    verdicts: &[Verdict],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Extent>> {
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
