//! A leap to the motion that returns come closer to.
//!
//! A state that spirals in comes closer by the same factor every turn, which may be near 1. Where the linear map of one turn
//! contracts, it says where the spiral ends: Newton's method, with the map of one neighbouring turn for all its steps. What was
//! wrong with the map shows in the next return, which must be far closer; where it is not, the state goes on from there.

use super::observer::Observer;
use super::recurrence::{Recurrence, distance};
use super::schedule::Schedule;
use super::turn::Turn;
use crate::model::vector::dot;
use crate::model::{Flight, Real, State};

/// The longest leap, in units of [`Flight::unit`] for states of order one and less, relative above: its end must be a neighbour.
pub const LONGEST_LEAP: f64 = 1e-3;
/// The largest share of the last return's distance that may be left of the next one's after a leap.
pub const LEFT_BY_LEAP: f64 = 0.1;

impl<T: Real, const N: usize> Observer<T, N> {
    /// Whether the map of a turn is to be measured in order to leap: the state returns, and still moves. That takes less than an
    /// observation, so that it is discarded where nothing has settled; a turn to leap after and one to prove it must be left of
    /// the transient.
    pub(super) fn is_to_leap(&self, schedule: &Schedule) -> bool {
        let moves = self.recurrence.holds_for(0) && !self.recurrence.is_within(T::of(T::AT_REST));
        let measures = self.leaps > 1 && !self.turn.is_measured() && self.has_short_turns(schedule);
        let needed = self.turns_needed();
        let has_time = self.periods + needed + 2 * self.recurrence.n <= schedule.transient;
        moves && measures && needed < schedule.observe && has_time && self.trajectory.contact.is_free()
    }

    /// At a strobe of the transient after the map of a turn was measured: one turn after the anchor it leaps to where that
    /// return leads, if the map says that it leads there. Whether the trajectory goes on from another state than it came to.
    #[inline(always)]
    pub(super) fn leap(&mut self, flight: &Flight<T, N>, schedule: &Schedule) -> bool {
        if !self.turn.is_measured() || self.recurrence.since < self.turn.n && self.recurrence.since > 0 {
            return false;
        }
        self.leap_from_return(flight, schedule)
    }

    #[inline(never)]
    fn leap_from_return(&mut self, flight: &Flight<T, N>, schedule: &Schedule) -> bool {
        let state = self.trajectory.point.state;
        let anchor = self.recurrence.anchor();
        let missed = distance(flight, &state, &anchor);
        let target = anchor.added(&self.turn.followed_for_ever(&state.plus(-T::one(), &anchor)));
        let returned =
            self.recurrence.n > 0 && self.recurrence.since == self.turn.n && self.turn.exponent < T::zero();
        let neared = missed > T::of(T::AT_REST) && missed <= T::of(LEFT_BY_LEAP) * self.turn.missed;
        let leads_there = target.is_finite()
            && distance(flight, &target, &state) <= T::of(LONGEST_LEAP)
            && is_between_stops(flight, &target);
        let has_time = self.periods + self.turn.n <= schedule.transient;
        let may_leap = self.leaps > 0 && has_time && self.trajectory.contact.is_free();
        if returned && neared && leads_there && may_leap {
            self.leaps -= 1;
            self.turn.missed = missed;
            self.trajectory.point.state = target;
            self.recurrence = Recurrence::anchored(target);
            return true;
        }
        self.turn = Turn::none();
        false
    }
}

/// Whether a state is off every stop.
fn is_between_stops<T: Real, const N: usize>(flight: &Flight<T, N>, state: &State<T, N>) -> bool {
    let mut between = true;
    for normal in flight.normals() {
        let place = dot(&normal.direction, &state.x);
        between &= (place < normal.gap[0]) & (-place < normal.gap[1]);
    }
    between
}

#[cfg(test)]
mod tests {
    use super::super::observer::MOST_LEAPS;
    use super::*;
    use crate::dynamics::{Contact, End, Point, Tangent};
    use crate::model::{Parameters, System};

    const SCHEDULE: Schedule =
        Schedule { transient: 4000, observe: 150, max_period: 32, fixed_periods: false };

    fn flight<T: Real>(omega: f64, delta: f64) -> Flight<T, 2> {
        let cell = Parameters { omega, delta, ..Parameters::default() };
        Flight::<f64, 2>::new(&System::new(cell).unwrap()).round::<T>()
    }

    /// An observer that came back by `step` short of where it would be for ever, were a turn to multiply every deviation by
    /// `factor`; its anchor lies at x1 = `place`, and before the last leap it missed by `missed`.
    fn returned(
        flight: &Flight<f64, 2>,
        place: f64,
        factor: f64,
        step: f64,
        missed: f64,
    ) -> Observer<f64, 2> {
        let anchor = State { x: [place, 0.0], v: [0.1, 0.2] };
        let mut observer = Observer::new(flight, &SCHEDULE, anchor);
        observer.turn = Turn::over(1);
        observer.turn.missed = missed;
        for k in 0..Turn::<f64, 2>::COLUMNS {
            let unit = Turn::<f64, 2>::begins_with(k).0;
            observer.turn.complete(k + 1, &Tangent(unit.scaled(factor)));
        }
        let state = State { x: [place + step, 0.0], ..anchor };
        observer.trajectory.point = Point { state, ..observer.trajectory.point };
        observer.recurrence.at_strobe(flight, &observer.trajectory.point, 1e-4, 32, false);
        observer
    }

    /// x1 after the leap; none where there was none.
    fn leaps_to(mut observer: Observer<f64, 2>, flight: &Flight<f64, 2>) -> Option<f64> {
        let leapt = observer.leap(flight, &SCHEDULE);
        assert_eq!(leapt, observer.turn.is_measured(), "a turn that leads nowhere is dropped");
        leapt.then_some(observer.trajectory.point.state.x[0])
    }

    #[test]
    fn it_goes_where_the_map_of_a_turn_leads_and_only_there() {
        let flight = flight(3.7, 0.1);
        let begin =
            |place, factor, step, missed| leaps_to(returned(&flight, place, factor, step, missed), &flight);
        // What is left of the way is a geometric series.
        let end = begin(0.02, 0.9, 1e-6, 1.0).unwrap();
        assert!((end - (0.02 + 1e-6 / (1.0 - 0.9))).abs() < 1e-15, "{end}");
        assert_eq!(begin(0.02, 1.1, 1e-6, 1.0), None, "a map that repels");
        assert!(begin(0.02, 0.9, 1e-5, 1.0).is_some());
        assert_eq!(begin(0.02, 0.999, 1e-5, 1.0), None, "a leap of 0.01");
        assert_eq!(begin(0.1 - 5e-6, 0.9, 1e-6, 1.0), None, "beyond the stop");
        assert_eq!(begin(0.02, 0.9, 1e-11, 1.0), None, "a motion that is at rest");
        assert!(begin(0.02, 0.9, 1e-6, 1.1e-5).is_some());
        assert_eq!(begin(0.02, 0.9, 1e-6, 0.9e-5), None, "no closer than the last leap should have led");
        let tired = Observer { leaps: 0, ..returned(&flight, 0.02, 0.9, 1e-6, 1.0) };
        assert_eq!(leaps_to(tired, &flight), None, "it has leapt often enough");
    }

    #[test]
    fn it_waits_for_its_turn_and_begins_anew_after_a_leap() {
        let flight = flight(3.7, 0.1);
        let returned = || returned(&flight, 0.02, 0.9, 1e-6, 1.0);
        let mut early = returned();
        early.turn.n = 2;
        assert!(!early.leap(&flight, &SCHEDULE) && early.turn.is_measured(), "half a turn");
        let mut astray = returned();
        astray.recurrence = Recurrence::anchored(astray.trajectory.point.state);
        assert_eq!(leaps_to(astray, &flight), None, "the state did not return");
        let mut held = returned();
        held.trajectory.contact = Contact::FREE.with(End { normal: 0, side: 0 });
        assert_eq!(leaps_to(held, &flight), None, "a contact holds");
        let mut late = returned();
        late.periods = SCHEDULE.transient;
        assert_eq!(leaps_to(late, &flight), None, "no turn is left to prove it");
        let mut mirrored = returned();
        mirrored.recurrence = Recurrence::anchored(State { x: [-0.1 + 5e-6, 0.0], v: [0.1, 0.2] });
        mirrored.trajectory.point.state = State { x: [-0.1 + 4e-6, 0.0], v: [0.1, 0.2] };
        mirrored.recurrence.at_strobe(&flight, &mirrored.trajectory.point, 1e-4, 32, false);
        assert_eq!(leaps_to(mirrored, &flight), None, "beyond the lower stop");
        let mut leapt = returned();
        assert!(leapt.leap(&flight, &SCHEDULE));
        let there = leapt.trajectory.point.state;
        assert_eq!((leapt.leaps, leapt.recurrence), (MOST_LEAPS - 1, Recurrence::anchored(there)));
        assert!((leapt.turn.missed - 1e-6).abs() < 1e-15, "{}", leapt.turn.missed);
    }

    #[test]
    fn a_turn_is_measured_where_a_leap_can_follow() {
        let flight = flight::<f64>(3.7, 0.1);
        let asks = |apart: f64, turn: u32, leaps: u32, schedule: Schedule, periods: u32| {
            let anchor = State { x: [0.02, 0.0], v: [0.1, 0.2] };
            let mut observer = Observer { leaps, periods, ..Observer::new(&flight, &schedule, anchor) };
            observer.turn = Turn::over(turn);
            observer.trajectory.point.state = State { x: [0.02 + apart, 0.0], ..anchor };
            for _ in 0..3 {
                observer.recurrence.at_strobe(&flight, &observer.trajectory.point, 1e-4, 32, false);
            }
            observer.is_to_leap(&schedule)
        };
        assert!(asks(1e-6, 0, 2, SCHEDULE, 100));
        assert!(!asks(1e-11, 0, 2, SCHEDULE, 100), "at rest");
        assert!(!asks(1e-3, 0, 2, SCHEDULE, 100), "no return");
        assert!(!asks(1e-6, 1, 2, SCHEDULE, 100), "measured already");
        assert!(!asks(1e-6, 0, 1, SCHEDULE, 100), "none is left to leap with");
        assert!(!asks(1e-6, 0, 2, Schedule { observe: 4, ..SCHEDULE }, 100), "a whole observation");
        assert!(asks(1e-6, 0, 2, Schedule { observe: 5, ..SCHEDULE }, 100));
        assert!(asks(1e-6, 0, 2, SCHEDULE, SCHEDULE.transient - 6));
        assert!(!asks(1e-6, 0, 2, SCHEDULE, SCHEDULE.transient - 5), "no turn is left to prove it");
    }

    /// A trajectory from rest at its end, after at most so many leaps.
    fn followed<T: Real>(flight: &Flight<T, 2>, leaps: u32) -> Observer<T, 2> {
        let mut observer = Observer { leaps, ..Observer::new(flight, &SCHEDULE, State::zero()) };
        observer.follow(flight, &SCHEDULE);
        observer
    }

    /// Motions that a multiplier near 1 lets settle slowly: a leap lands on the same motion, in a fraction of the time.
    fn lands_on_the_motion<T: Real>(cells: &[(f64, f64)]) {
        for &(omega, delta) in cells {
            let flight = flight::<T>(omega, delta);
            let (leapt, waited) = (followed(&flight, MOST_LEAPS), followed(&flight, 0));
            assert!(leapt.leaps < MOST_LEAPS - 1, "{} leaps are left at {omega}, {delta}", leapt.leaps);
            assert!(leapt.is_settled() && leapt.recurrence.is_within(T::of(T::ROUNDING)), "{omega}, {delta}");
            assert_eq!([leapt.recurrence.n, waited.recurrence.n], [1; 2]);
            let away =
                distance(&flight, &leapt.trajectory.point.state, &waited.trajectory.point.state).widen();
            assert!(away <= 10.0 * T::SETTLED, "{away} at {omega}, {delta}");
            let [periods, longer] = [leapt.periods, waited.periods];
            assert!(4 * periods < 3 * longer, "{periods} and {longer} periods at {omega}, {delta}");
        }
    }

    #[test]
    fn a_leap_lands_on_the_motion_that_was_waited_for() {
        lands_on_the_motion::<f64>(&[(3.7, 0.1), (3.13, 0.137), (3.33, 0.12)]);
        lands_on_the_motion::<f32>(&[(3.7, 0.1), (3.13, 0.137), (3.13, 0.1)]);
    }
}
