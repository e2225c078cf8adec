//! How an observation begins: which one, and what is noted of it from there.

use super::exponent::Exponent;
use super::loss::Loss;
use super::observation::{BRIEF, Observation, SETTLED_OBSERVATION, SETTLED_TURNS};
use super::observer::Observer;
use super::recurrence::Recurrence;
use super::schedule::Schedule;
use super::spread::Spread;
use super::stage::Stage;
use super::turn::Turn;
use crate::dynamics::Tangent;
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Observer<T, N> {
    /// Of what returns: turn by turn, where there is time for that. Where it no longer moves at all, and its turns are short, that
    /// is enough; it is observed for longer otherwise.
    pub(super) fn observation_of_settled(&self, schedule: &Schedule, at_rest: bool) -> Observation {
        if at_rest && self.has_short_turns(schedule) {
            return self.observation_by_turns();
        }
        let n = self.recurrence.n.max(1);
        let turns = SETTLED_OBSERVATION.div_ceil(n).max(SETTLED_TURNS);
        let measured = (turns * n).max(self.turns_needed());
        if measured < schedule.observe {
            return Observation { periods: measured, turn: self.recurrence.n };
        }
        // Whole turns, where there is time for them: what is measured is the mean over them.
        Observation::over((turns * n).min(schedule.observe))
    }

    /// Of what has not settled: the whole observation, once the transient is over.
    pub(super) fn observation_of_unsettled(&self, schedule: &Schedule) -> Observation {
        if self.periods >= schedule.transient {
            Observation::over(schedule.observe)
        } else {
            Observation::NONE
        }
    }

    /// Of what returns, turn by turn.
    pub(super) fn observation_by_turns(&self) -> Observation {
        Observation { periods: self.turns_needed(), turn: self.recurrence.n }
    }

    /// Whether the turns of what returns are short enough for an observation turn by turn.
    pub(super) fn has_short_turns(&self, schedule: &Schedule) -> bool {
        self.turns_needed() <= BRIEF.min(schedule.observe)
    }

    pub(super) fn turns_needed(&self) -> u32 {
        self.recurrence.n * SETTLED_TURNS.max(Turn::<T, N>::COLUMNS)
    }

    /// Begins an observation, if one begins.
    #[inline(always)]
    pub(super) fn begin_observation(&mut self, flight: &Flight<T, N>, begins: Observation) {
        if begins != Observation::NONE {
            self.begin_observing(flight, begins);
        }
    }

    #[inline(never)]
    fn begin_observing(&mut self, flight: &Flight<T, N>, begins: Observation) {
        let point = self.trajectory.point;
        self.stage = Stage::Observation;
        self.observe = begins.periods;
        self.observed = 0;
        self.impacts = 0;
        self.peak = T::zero();
        self.stuck = false;
        self.loss = Loss::none(self.trajectory.contact);
        self.carry(flight, if begins.turn > 0 { Turn::begins_with(0) } else { Tangent::seed() });
        self.recurrence = Recurrence::anchored(point.state);
        self.exponent = Exponent::over(begins.periods);
        self.turn = Turn::over(begins.turn);
        self.spread = Spread::about(&point.state);
        self.grown = T::zero();
        (self.lost, self.lately_lost) = (false, false);
    }

    /// Carries a deviation along from here. While a mass rests on a stop, deviations along the contact are zero.
    pub(super) fn carry(&mut self, flight: &Flight<T, N>, deviation: Tangent<T, N>) {
        self.tangent = deviation.caught(flight, self.trajectory.contact);
    }
}
