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

use std::mem::take;

use parking_lot::Mutex;
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

/// What is known of a trajectory in doubt.
#[derive(Debug)]
pub(super) struct Doubt {
    /// What it is known by.
    pub number: u64,
    pub verdict: Verdict,
}

/// A longer look at some trajectories, from where they ended.
#[derive(Debug)]
pub(super) struct Look {
    /// Which verdicts are in doubt.
    in_doubt: fn(&Verdict) -> bool,
    /// Which of the verdicts that the look comes to take the place of those; the others only add what was observed.
    decides: fn(&Verdict) -> bool,
    /// How long the trajectories go on.
    schedule: Schedule,
    /// Those that wait for it.
    waiting: Mutex<Vec<(Job, Doubt)>>,
}

/// The looks in their order.
pub(super) fn looks(schedule: &Schedule) -> [Look; 3] {
    let chaos = Schedule {
        transient: schedule.transient.saturating_mul(2).min(CHAOS_LOOK),
        observe: schedule.observe.min(CHAOS_OBSERVATION),
        ..*schedule
    };
    let open = Schedule { transient: schedule.transient, ..long_look(schedule) };
    let look = |in_doubt, decides, schedule| Look { in_doubt, decides, schedule, waiting: Mutex::default() };
    [
        look(may_be_transient, is_settled, chaos),
        look(is_open, |_| true, open),
        look(is_undecided, |_| true, long_look(schedule)),
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
    /// Whether a verdict calls for it.
    pub fn is_called_for_by(&self, verdict: &Verdict) -> bool {
        (self.in_doubt)(verdict)
    }

    /// Lets a trajectory wait for it.
    pub fn put_off(&self, goes_on: Job, doubt: Doubt) {
        self.waiting.lock().push((goes_on, doubt));
    }

    /// Those that wait for it, if there are at least so many, and any.
    pub fn called(&self, least: usize) -> Option<(Vec<Job>, Vec<Doubt>)> {
        let mut waiting = self.waiting.lock();
        (waiting.len() >= least.max(1)).then(|| take(&mut *waiting).into_iter().unzip())
    }

    /// Lets trajectories go on from where they ended.
    pub fn take(
        &self,
        backend: &dyn Backend,
        jobs: &[Job],
        doubts: Vec<Doubt>,
        watch: &dyn Watch,
    ) -> Result<impl Iterator<Item = Doubt>> {
        let later = confirmed_by(backend, jobs, &self.schedule, &Silent(watch))?;
        Ok(doubts.into_iter().zip(later).map(|(Doubt { number, verdict: first }, later)| {
            let decided = if (self.decides)(&later) { later } else { first.observed_further(&later) };
            let Verdict { periods, impacts_total, .. } = later.going_on_from(&first);
            Doubt { number, verdict: Verdict { periods, impacts_total, ..decided } }
        }))
    }
}

/// The verdicts of a back end, which is given its tiles one after the other; on trajectories that approach a periodic motion, what the
/// exact motion says. Any may be in doubt.
///
/// # Errors
/// What the back end could not do.
///
/// # Panics
/// If the back end does not give a verdict for each job.
pub fn confirmed_by(
    backend: &dyn Backend,
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>> {
    let mut verdicts = Vec::new();
    for tile in jobs.chunks(backend.tile().max(1)) {
        watch.check()?;
        let found = backend.run(tile, schedule, watch)?;
        assert_eq!(found.len(), tile.len(), "a verdict for each job");
        // As a rule there is one tile.
        if verdicts.is_empty() {
            verdicts = found;
        } else {
            verdicts.extend(found);
        }
    }
    jobs.par_iter().zip(&mut verdicts).for_each(|(job, verdict)| {
        if let Some(exact) = confirmed(&job.system, verdict) {
            *verdict = exact;
        }
    });
    Ok(verdicts)
}
