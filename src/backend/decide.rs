//! Longer looks at trajectories in doubt.
//!
//! One schedule suits most of a plane; time is spent where its verdict is doubtful. Unless the schedule fixes the periods:
//!
//! - A state that returns without having settled is held against the exact motion beside it, which Newton's method finds at
//!   the cost of a few turns: slow spirals and alternations need not be waited for, and a multiple of the period is no period.
//! - Chaos may be transient: it goes on for up to [`CHAOS_LOOK`] forcing periods, and is chaos unless it settles by then, with
//!   sticking if it sticks then. What is observed of it meanwhile counts as well as what was before.
//! - What is still undecided or neutral, or returns although its exponent is positive, goes on for another transient and is
//!   observed [`LONGER_OBSERVATION`] times as long: beside a Neimark–Sacker curve spirals are slow, and weak chaos needs time to
//!   be significant. Quasi-periodic motion whose points scatter alike in both halves of that is believed.
//! - What even that leaves undecided goes on for [`LONG_LOOK`] times the transient, and is observed as long again.

use rayon::prelude::*;

use super::{Backend, Job, Result, Silent, Watch};
use crate::analysis::{Regime, Schedule, Verdict};
use crate::theory::confirmed;

/// How many transients a trajectory goes on for that a longer observation leaves undecided.
pub const LONG_LOOK: u32 = 8;

/// How many times as long it is then observed.
pub const LONGER_OBSERVATION: u32 = 4;

/// For how many forcing periods chaos goes on before it is believed, but at most two transients.
pub const CHAOS_LOOK: u32 = 320;

/// For how many forcing periods it is then observed: to see whether it has settled, and for what is measured of chaos.
const CHAOS_OBSERVATION: u32 = 64;

/// The verdicts of a back end on some jobs, those in doubt taken anew from where they ended.
///
/// # Errors
/// What the back end could not do.
pub fn decide(
    backend: &dyn Backend,
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>> {
    let mut verdicts = backend.run(jobs, schedule, watch)?;
    confirm(jobs, &mut verdicts);
    if !schedule.fixed_periods {
        for look in looks(schedule) {
            look.take(backend, jobs, &mut verdicts, watch)?;
        }
    }
    Ok(verdicts)
}

/// A longer look at some trajectories, from where they ended.
struct Look {
    /// Which verdicts are in doubt.
    in_doubt: fn(&Verdict) -> bool,
    /// Which of the verdicts that the look comes to take the place of those; the others only add what was observed.
    decides: fn(&Verdict) -> bool,
    /// How long the trajectories go on.
    schedule: Schedule,
}

/// The looks in their order.
fn looks(schedule: &Schedule) -> [Look; 3] {
    let chaos = Schedule {
        transient: schedule.transient.saturating_mul(2).min(CHAOS_LOOK),
        observe: schedule.observe.min(CHAOS_OBSERVATION),
        ..*schedule
    };
    [
        Look { in_doubt: may_be_transient, decides: is_settled, schedule: chaos },
        Look {
            in_doubt: is_open,
            decides: |_| true,
            schedule: Schedule { transient: schedule.transient, ..long_look(schedule) },
        },
        Look { in_doubt: is_undecided, decides: |_| true, schedule: long_look(schedule) },
    ]
}

/// The schedule by which a trajectory goes on that a longer observation leaves undecided.
pub fn long_look(schedule: &Schedule) -> Schedule {
    let times = |periods: u32, times: u32| periods.saturating_mul(times).min(Schedule::LONGEST);
    Schedule {
        transient: times(schedule.transient, LONG_LOOK),
        observe: times(schedule.observe, LONGER_OBSERVATION),
        ..*schedule
    }
}

fn may_be_transient(verdict: &Verdict) -> bool {
    matches!(verdict.regime, Regime::Chaotic | Regime::AperiodicSticking)
}

fn is_settled(verdict: &Verdict) -> bool {
    verdict.regime.is_periodic() || matches!(verdict.regime, Regime::NoImpact | Regime::Failed)
}

fn is_open(verdict: &Verdict) -> bool {
    verdict.regime == Regime::QuasiPeriodic || is_undecided(verdict)
}

fn is_undecided(verdict: &Verdict) -> bool {
    verdict.regime == Regime::Unresolved || (verdict.returning > 0 && !verdict.regime.is_periodic())
}

impl Look {
    /// Lets the trajectories in doubt go on from where they ended.
    fn take(
        &self,
        backend: &dyn Backend,
        jobs: &[Job],
        verdicts: &mut [Verdict],
        watch: &dyn Watch,
    ) -> Result<()> {
        let open: Vec<usize> = (0..verdicts.len()).filter(|&i| (self.in_doubt)(&verdicts[i])).collect();
        let again: Vec<Job> =
            open.iter().map(|&i| Job { system: jobs[i].system.clone(), start: verdicts[i].state }).collect();
        let mut later = backend.run(&again, &self.schedule, &Silent(watch))?;
        confirm(&again, &mut later);
        for (i, later) in open.into_iter().zip(later) {
            let first = verdicts[i];
            let decided = if (self.decides)(&later) { later } else { first.observed_further(&later) };
            let Verdict { periods, impacts_total, .. } = later.going_on_from(&first);
            verdicts[i] = Verdict { periods, impacts_total, ..decided };
        }
        Ok(())
    }
}

/// Replaces the verdicts on trajectories that approach a periodic motion by what the exact motion says.
fn confirm(jobs: &[Job], verdicts: &mut [Verdict]) {
    jobs.par_iter().zip(verdicts).for_each(|(job, verdict)| {
        if let Some(exact) = confirmed(&job.system, verdict) {
            *verdict = exact;
        }
    });
}
