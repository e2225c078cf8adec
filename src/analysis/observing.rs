//! What is noted of a trajectory: its impacts, and at every strobe whether the transient or the observation ends.

use super::deciding::{PLAIN_GROWTH, grows};
use super::observation::{BRIEF, Observation};
use super::observer::Observer;
use super::quiet::is_quiet;
use super::recurrence::{Recurrence, patience};
use super::schedule::Schedule;
use super::stage::Stage;
use super::turn::Turn;
use crate::dynamics::{Event, Move, Point, Stop, Tangent};
use crate::model::{Flight, Real};

/// The largest distance between strobe states of a motion that is called periodic, and from the mirror image of one that is
/// called symmetric; in units of [`Flight::unit`] for states of order one and less, relative above.
pub const RETURNED: f64 = 1e-4;
/// Periods of returns in the transient after which a trajectory finishes early where it returns to [`Real::SETTLED`].
pub const SETTLING: u32 = 64;
/// The same for one that returns far closer still, to [`Real::AT_REST`].
pub const SETTLING_AT_REST: u32 = 4;
/// Periods of returns in the transient after which the motion is compared with its present self.
pub const FOLLOWING: u32 = 16;
/// The share of the observation, one in so many, for which the state must have kept returning when it ends; no more than
/// [`SETTLING`].
pub const PROOF_SHARE: u32 = 4;

impl<T: Real, const N: usize> Observer<T, N> {
    #[inline(always)]
    pub(super) fn note(&mut self, flight: &Flight<T, N>, schedule: &Schedule, taken: &Move<T>) {
        if taken.event != Event::HalfPeriod {
            self.moves.add();
        }
        if !taken.contact.is_free() {
            self.stuck = true;
        }
        match taken.event {
            Event::Flight | Event::StepEnd | Event::Released(_) => {}
            Event::Impact(impact) => self.impact(impact.stop, impact.velocity_before, false),
            Event::Caught { impact, complete_chatter, beside, .. } => {
                self.stuck = true;
                if impact.velocity_before != T::zero() {
                    self.impact(impact.stop, impact.velocity_before, complete_chatter);
                }
                for stop in beside.stops(flight) {
                    self.recurrence.count(stop, true);
                }
            }
            Event::HalfPeriod => {
                let point = self.trajectory.point;
                self.half_period(flight, &point);
            }
            Event::Strobe => self.strobe(flight, schedule),
        }
        self.give_up();
    }

    /// Gives a trajectory up that has made too many moves.
    #[inline(always)]
    fn give_up(&mut self) {
        if self.moves.are_too_many() {
            self.stage = Stage::Failed;
        }
    }

    /// Whether the next phase π may show the mirror image of what returns.
    pub(super) fn awaits_mirror(&self, flight: &Flight<T, N>) -> bool {
        self.stage == Stage::Observation && self.recurrence.awaits_mirror(flight)
    }

    /// Sees the point at phase π: under observation it may be the mirror image of what returns.
    #[inline(always)]
    pub(super) fn half_period(&mut self, flight: &Flight<T, N>, point: &Point<T, N>) {
        if self.stage == Stage::Observation {
            self.recurrence.at_half_period(flight, point, T::of(RETURNED));
        }
    }

    #[inline(always)]
    fn impact(&mut self, stop: Stop, velocity: T, complete_chatter: bool) {
        self.recurrence.count(stop, complete_chatter);
        self.count_impacts(1);
        let speed = velocity.abs();
        self.peak = if speed > self.peak { speed } else { self.peak };
    }

    #[inline(always)]
    pub(super) fn count_impacts(&mut self, impacts: u32) {
        self.impacts = self.impacts.saturating_add(impacts);
        self.impacts_total = self.impacts_total.saturating_add(impacts);
    }

    #[inline(always)]
    fn strobe(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        let Some(moved) = self.begin_period(flight) else { return };
        let begins = match self.stage {
            Stage::Transient => self.settle(flight, schedule, moved).0,
            _ => self.observe(flight, schedule),
        };
        self.begin_observation(flight, begins);
    }

    /// Notes that the trajectory came to phase 0 in free flight: under observation with its tangent, in the transient without. Whether
    /// it goes on from another state.
    #[inline(always)]
    pub(super) fn arrive(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        tangent: Option<Tangent<T, N>>,
    ) -> bool {
        debug_assert_eq!(tangent.is_some(), self.stage == Stage::Observation);
        self.moves.add();
        let mut leapt = false;
        if let Some(moved) = self.begin_period(flight) {
            let begins;
            if let Some(tangent) = tangent {
                self.tangent = tangent;
                begins = self.observe(flight, schedule);
            } else {
                (begins, leapt) = self.settle(flight, schedule, moved);
            }
            self.begin_observation(flight, begins);
        }
        self.give_up();
        leapt
    }

    /// Counts the period that begins at a strobe, and says whether there were other moves since the last; none where the
    /// trajectory fails there.
    #[inline(always)]
    fn begin_period(&mut self, flight: &Flight<T, N>) -> Option<bool> {
        let moved = self.moves.are_more_than_one();
        self.moves.pass_period();
        self.periods += 1;
        if !self.trajectory.point.state.is_bounded() {
            self.stage = Stage::Failed;
            return None;
        }
        if !self.trajectory.contact.is_free() {
            self.count_clamped(flight);
        }
        Some(moved)
    }

    /// Between stops that clamp it a mass impacts without end.
    fn count_clamped(&mut self, flight: &Flight<T, N>) {
        for (k, normal) in flight.normals().iter().enumerate() {
            if self.trajectory.contact.is_clamped_along(k) {
                self.recurrence.count(Stop(normal.stop[0]), true);
                self.recurrence.count(Stop(normal.stop[1]), true);
            }
        }
    }

    /// A strobe of the transient: what observation begins there, and whether the trajectory goes on from another state. Where it
    /// `moved`, it can impact again.
    #[inline(always)]
    fn settle(&mut self, flight: &Flight<T, N>, schedule: &Schedule, moved: bool) -> (Observation, bool) {
        let point = self.trajectory.point;
        let mut leapt = false;
        if !schedule.fixed_periods {
            if !moved && self.trajectory.contact.is_free() && is_quiet(flight, &point) {
                self.stage = Stage::Quiet;
                return (Observation::NONE, false);
            }
            let patience = patience(self.periods, schedule.max_period);
            self.recurrence.at_strobe(flight, &point, T::of(T::RETURNING), patience, false);
            leapt = self.leap(flight, schedule);
            let at_rest = self.recurrence.is_within(T::of(T::AT_REST));
            let settled = if at_rest {
                self.recurrence.holds_for(SETTLING_AT_REST)
            } else {
                self.recurrence.kept_for(SETTLING) && self.recurrence.is_within(T::of(T::SETTLED))
            };
            if settled {
                return (self.observation_of_settled(schedule, at_rest), false);
            }
            if self.is_to_leap(schedule) {
                self.leaps -= 1;
                return (self.observation_by_turns(), false);
            }
            if !self.turn.is_measured() {
                self.recurrence.follow_along(&point, FOLLOWING);
            }
        }
        (self.observation_of_unsettled(schedule), leapt)
    }

    /// A strobe of the observation: what other observation begins there.
    #[inline(always)]
    fn observe(&mut self, flight: &Flight<T, N>, schedule: &Schedule) -> Observation {
        let point = self.trajectory.point;
        self.observed += 1;
        let half = self.observe / 2;
        self.recurrence.at_strobe(
            flight,
            &point,
            T::of(RETURNED),
            schedule.max_period,
            self.observed >= half,
        );
        self.measure_growth(flight);
        if self.observed <= 2 * half {
            self.spread.at_strobe(&point.state, self.observed > half);
        }
        if self.is_halved(schedule) && self.is_plainly_chaotic() {
            self.observe = self.observed;
            self.stage = Stage::Observed;
            return Observation::NONE;
        }
        if self.observed < self.observe {
            return Observation::NONE;
        }
        let early = self.observe < schedule.observe;
        // What leaps, or came to rest, must have ended there.
        let brief = self.turn.is_measured() && self.observe <= BRIEF;
        let still = self.recurrence.is_within(T::of(T::ROUNDING));
        let settled = !brief || still && self.is_settled();
        if early && !(settled && self.recurrence.holds_for(self.proof())) {
            // It had not settled after all: the observation is discarded and the transient goes on.
            self.recurrence = Recurrence::anchored(point.state);
            self.stage = Stage::Transient;
            if !brief {
                self.turn = Turn::none();
            }
            return self.observation_of_unsettled(schedule);
        }
        self.stage = Stage::Observed;
        Observation::NONE
    }

    /// Whether half of a whole observation is over, and that is long enough to see that chaos is plain.
    fn is_halved(&self, schedule: &Schedule) -> bool {
        let whole = !schedule.fixed_periods && !self.turn.is_measured() && self.observe == schedule.observe;
        whole && self.observed >= SETTLING && self.observed == self.observe / 2
    }

    /// Whether what was observed so far says plainly that the motion is chaotic.
    fn is_plainly_chaotic(&self) -> bool {
        let impacts = self.impacts > 0 && !self.stuck && !self.recurrence.holds_for(0);
        impacts && grows(&self.exponent, PLAIN_GROWTH)
    }

    /// Measures how the tangent vector grows: turn by turn; or batch by batch, and also where the recurrence's anchor was set and where
    /// the observation ends, for what it grew by in between. A mass that rests on a stop can take the vector: it is not left to grow.
    #[inline(always)]
    fn measure_growth(&mut self, flight: &Flight<T, N>) {
        if !self.turn.is_measured() {
            let anchored = self.recurrence.since == 0;
            let asked = anchored || self.stuck || self.observed == self.observe;
            let lost = self.tangent.is_lost();
            self.lost |= lost;
            self.lately_lost = !anchored && (self.lately_lost || lost);
            let growth = self.exponent.at_strobe(&mut self.tangent, asked);
            self.grown = if anchored { T::zero() } else { self.grown + growth };
        } else if self.observed.is_multiple_of(self.turn.n) {
            let turns = self.observed / self.turn.n;
            self.turn.complete(turns, &self.tangent);
            self.carry(flight, Turn::begins_with(turns));
        }
    }

    /// Periods for which the state must have kept returning when the observation ends.
    pub(super) fn proof(&self) -> u32 {
        (self.observe / PROOF_SHARE).min(SETTLING)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Setting, State, System};
    use crate::system::Family;

    #[test]
    fn growth_is_measured_from_where_the_anchor_was_set_to_the_end() {
        let flight = Flight::<f64, 2>::new(&System::new(Setting::defaults(Family::paper())).unwrap());
        // Batches are of 9 periods, and a state whose return is waited for in vain is left after 7.
        let schedule = Schedule { transient: 0, observe: 150, max_period: 7, fixed_periods: true };
        let mut observer = Observer::new(&flight, &schedule, State::zero());
        let factor = |period: u32| 1.0 + 0.1 * f64::from(period % 5);
        for period in 1..=150 {
            observer.trajectory.point.state.x[0] = f64::from(period);
            observer.tangent = Tangent(observer.tangent.0.scaled(factor(period)));
            observer.observe(&flight, &schedule);
        }
        assert_eq!((observer.stage, observer.recurrence.since), (Stage::Observed, 3));
        let since: f64 = (148..=150).map(|period| factor(period).ln()).sum();
        assert!((observer.grown - since).abs() < 1e-12, "{} for {since}", observer.grown);
        let counted: f64 = (37..=144).map(|period| factor(period).ln()).sum();
        assert!((observer.exponent.total_growth() - counted).abs() < 1e-10);
    }
}
