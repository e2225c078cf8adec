//! A second look at trajectories that are still undecided.
//!
//! Beside a Neimark–Sacker curve a trajectory spirals so slowly onto its motion that a schedule which suits the rest of
//! a plane cannot tell it from an invariant circle. What is undecided, or neutral, therefore goes on from where it is for
//! [`SECOND_LOOK`] times the transient, unless the schedule fixes the periods.

use super::{Backend, BackendError, Job, Watch};
use crate::analysis::{Regime, Schedule, Verdict};

/// How many transients a trajectory that is still undecided goes on for.
pub const SECOND_LOOK: u32 = 8;

/// The verdicts of a back end on some jobs, those that leave a slow spiral in doubt taken anew from where they ended.
///
/// # Errors
/// What the back end could not do.
pub fn decide(
    backend: &dyn Backend,
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>, BackendError> {
    let mut verdicts = backend.run(jobs, schedule, watch)?;
    let in_doubt = |verdict: &Verdict| matches!(verdict.regime, Regime::Unresolved | Regime::QuasiPeriodic);
    let open: Vec<usize> = (0..verdicts.len()).filter(|&i| in_doubt(&verdicts[i])).collect();
    let transient = schedule.transient.saturating_mul(SECOND_LOOK).min(Schedule::LONGEST);
    let longer = Schedule { transient, ..*schedule };
    if schedule.fixed_periods || open.is_empty() || longer.check().is_err() {
        return Ok(verdicts);
    }
    let go_on = |&i: &usize| Job { system: jobs[i].system.clone(), start: verdicts[i].state };
    let again: Vec<Job> = open.iter().map(go_on).collect();
    for (&i, later) in open.iter().zip(backend.run(&again, &longer, &Silent(watch))?) {
        let first = &verdicts[i];
        verdicts[i] = Verdict {
            periods: first.periods.saturating_add(later.periods),
            impacts_total: first.impacts_total.saturating_add(later.impacts_total),
            ..later
        };
    }
    Ok(verdicts)
}

/// Counts no cell twice, and is cancelled as the other is.
struct Silent<'a>(&'a dyn Watch);

impl Watch for Silent<'_> {
    fn finished(&self, _: u64) {}

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
