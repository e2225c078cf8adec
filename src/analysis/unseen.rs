//! Strobes that need not be seen, and what is noted of them later.

use super::observer::Observer;
use super::observing::RETURNED;
use super::schedule::Schedule;
use super::stage::Stage;
use crate::dynamics::constants::MOST_KICKS;
use crate::dynamics::{Moments, Moves, Stop, Tally, Unseen};
use crate::model::{Flight, Real, System};

/// The most strobes that are passed unseen.
const MOST_UNSEEN: u32 = 1 << 11;

/// Impacts that are counted meanwhile, and in the period after them, fit into the counters of lanes, which may be f32: each is a
/// kick, and a step has so many at most.
const _: () =
    assert!(MOST_UNSEEN * Moves::MANY + System::MOST_STEPS * MOST_KICKS < 1 << f32::MANTISSA_DIGITS);

impl<T: Real, const N: usize> Observer<T, N> {
    /// How often it may pass phase 0 in free flight before it is to see that.
    pub(super) fn unseen(&self, flight: &Flight<T, N>, schedule: &Schedule) -> Unseen<T, N> {
        match self.stage {
            _ if self.turn.is_measured() => Unseen::none(),
            Stage::Transient => self.unseen_in_transient(flight, schedule),
            Stage::Observation => self.unseen_while_observed(flight, schedule),
            _ => Unseen::none(),
        }
    }

    fn unseen_in_transient(&self, flight: &Flight<T, N>, schedule: &Schedule) -> Unseen<T, N> {
        let most = schedule.transient.saturating_sub(self.periods + 1).min(MOST_UNSEEN);
        let recurrence = self.recurrence.unseen(flight, self.periods, schedule.max_period);
        if schedule.fixed_periods {
            Unseen { strobes: most, nearest: -T::one(), ..recurrence }
        } else {
            Unseen { strobes: recurrence.strobes.min(most), ..recurrence }
        }
    }

    /// Under observation: while nothing returns, up to where the growth of its tangent is measured, or the observation is half over.
    fn unseen_while_observed(&self, flight: &Flight<T, N>, schedule: &Schedule) -> Unseen<T, N> {
        if self.stuck {
            return Unseen::none();
        }
        let late = self.goes_on_late();
        let end = if late { self.observe } else { self.observe / 2 };
        let most = end.saturating_sub(self.observed + 1).min(self.exponent.periods_left()).min(MOST_UNSEEN);
        let recurrence = self.recurrence.unseen_within(flight, RETURNED, most, schedule.max_period);
        let scattering = Some(self.spread.scattering(late));
        Unseen { scattering, ..recurrence }
    }

    /// Whether the strobes that follow are of the later half of the observation.
    fn goes_on_late(&self) -> bool {
        self.observed >= self.observe / 2
    }

    /// Notes what happened from free flight to free flight: impacts, and strobes that it has not seen; under observation `moments`
    /// are what the strobes of this half scatter by then.
    #[inline(always)]
    pub(super) fn catch_up(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        tally: &Tally<T>,
        moments: impl FnOnce() -> Moments<T, N>,
    ) {
        let strobes = tally.strobes.widen() as u32;
        self.periods += strobes;
        if self.stage == Stage::Observation {
            if strobes > 0 {
                self.recurrence.pass(strobes);
                self.exponent.pass(strobes);
                self.spread.go_on(self.goes_on_late(), moments());
                self.observed += strobes;
            }
        } else if !schedule.fixed_periods {
            self.recurrence.pass(strobes);
        }
        self.moves = Moves::counted(tally.moves.widen() as u32);
        for (normal, impacts) in flight.normals().iter().zip(&tally.impacts) {
            for (stop, impacts) in normal.stop.into_iter().zip(impacts) {
                let impacts = impacts.widen() as u32;
                if impacts > 0 {
                    self.recurrence.count_finite(Stop(stop), impacts);
                    self.count_impacts(impacts);
                }
            }
        }
        self.peak = tally.fastest;
        self.loss.energy = tally.energy;
    }
}

#[cfg(test)]
mod tests {
    use super::super::recurrence::Recurrence;
    use super::super::turn::Turn;
    use super::*;
    use crate::dynamics::Tangent;
    use crate::model::{Setting, State};
    use crate::system::Family;

    /// How many strobes an observer need not see at the beginning of a schedule, and after some periods of it.
    fn unseen(schedule: &Schedule, periods: u32) -> u32 {
        let flight = Flight::<f64, 2>::new(&System::new(Setting::defaults(Family::paper())).unwrap());
        let begun = Observer::new(&flight, schedule, State::zero());
        let recurrence = Recurrence::anchored(State::zero());
        let observer = Observer { periods, recurrence, ..begun };
        // A turn that was measured waits for its return.
        assert_eq!(Observer { turn: Turn::over(1), ..observer }.unseen(&flight, schedule).strobes, 0);
        observer.unseen(&flight, schedule).strobes
    }

    #[test]
    fn the_last_strobe_of_a_transient_is_seen() {
        let fixed = Schedule { transient: 40, observe: 5, max_period: 16, fixed_periods: true };
        assert_eq!([0, 1, 38, 39, 40].map(|periods| unseen(&fixed, periods)), [39, 38, 1, 0, 0]);
        assert_eq!(unseen(&Schedule { transient: 0, ..fixed }, 0), 0);
        assert_eq!(unseen(&Schedule { transient: Schedule::LONGEST, ..fixed }, 0), MOST_UNSEEN);
        // Where a return would end it: until the anchor moves, after a quarter of its age.
        let free = Schedule { transient: 200, fixed_periods: false, ..fixed };
        assert_eq!([0, 10, 100, 190, 199].map(|periods| unseen(&free, periods)), [0, 2, 15, 9, 0]);
    }

    /// A place that hardly ever returns, and now and then does so for some periods.
    fn place(period: u32) -> f64 {
        if period % 50 < 4 { 0.25 } else { (f64::from(period) * 0.618_034).fract() - 0.5 }
    }

    /// Observes strobes with a tangent that grows by `factor` in each: how many there are, and how many were seen by an observer that lets
    /// others pass, which is checked to have noted at each what one that sees all of them has.
    fn observed<T: Real>(schedule: &Schedule, factor: impl Fn(u32) -> f64) -> (u32, u32) {
        let system = System::new(Setting::defaults(Family::paper())).unwrap();
        let flight: Flight<T, 2> = Flight::<f64, 2>::new(&system).round::<T>();
        let mut all = Observer::new(&flight, schedule, State::zero());
        let mut some = all;
        let mut tangent = some.tangent;
        let mut unseen = some.unseen(&flight, schedule);
        let mut moments = unseen.scattering.unwrap().moments;
        let (mut passed, mut seen) = (0, 0);
        for period in 1.. {
            let at = T::of(place(period));
            let state = State { x: [at, -at], v: [at * at, T::one()] };
            let grown = |tangent: &Tangent<T, 2>| Tangent(tangent.0.scaled(T::of(factor(period))));
            all.trajectory.point.state = state;
            all.moves = Moves::counted(3);
            let carried = grown(&all.tangent);
            all.arrive(&flight, schedule, Some(carried));
            tangent = grown(&tangent);
            let away =
                state.plus(-T::one(), &unseen.anchor).values().fold(T::zero(), |far, x| x.abs().max(far));
            if passed < unseen.strobes
                && away > unseen.nearest
                && Tangent::<T, 2>::may_be_left(tangent.square())
            {
                passed += 1;
                moments.add(true, &state, &unseen.scattering.unwrap().about);
                continue;
            }
            let tally =
                Tally { moves: T::of(3.0), strobes: T::of(f64::from(passed)), ..Tally::none(T::zero()) };
            some.catch_up(&flight, schedule, &tally, || moments);
            some.trajectory.point.state = state;
            some.arrive(&flight, schedule, Some(tangent));
            assert_eq!(some, all, "after {period} periods");
            (passed, seen) = (0, seen + 1);
            if some.is_done() || some.stage != Stage::Observation {
                return (period, seen);
            }
            unseen = some.unseen(&flight, schedule);
            moments = unseen.scattering.unwrap().moments;
            tangent = some.tangent;
        }
        unreachable!("an observation ends")
    }

    fn nothing_is_missed<T: Real>() {
        let wild = |period: u32| [1.7, 0.3, 2.9, 1e-5, 1.1, 1e7][period as usize % 6];
        for observe in [3, 5, 16, 40, 149, 150, 400] {
            for max_period in [1, 7, 32, 1000] {
                for fixed_periods in [false, true] {
                    let schedule = Schedule { transient: 0, observe, max_period, fixed_periods };
                    for factor in [&wild as &dyn Fn(u32) -> f64, &|_| 1.4, &|_| 1.0, &|_| 0.0] {
                        observed::<T>(&schedule, factor);
                    }
                }
            }
        }
        // Of nine periods of a batch one is seen, and more where something may return.
        let schedule = Schedule { transient: 0, observe: 150, max_period: 32, fixed_periods: true };
        let (periods, seen) = observed::<T>(&schedule, |_| 1.4);
        assert!(periods == 150 && (20..50).contains(&seen), "{seen} of {periods}");
    }

    #[test]
    fn where_a_mass_has_rested_or_the_state_returns_every_strobe_is_seen() {
        let flight = Flight::<f64, 2>::new(&System::new(Setting::defaults(Family::paper())).unwrap());
        let schedule = Schedule { transient: 0, observe: 1 << 20, max_period: 1 << 16, fixed_periods: false };
        let begun = Observer::new(&flight, &schedule, State::zero());
        let strobes = |observer: Observer<f64, 2>| observer.unseen(&flight, &schedule).strobes;
        assert_eq!(strobes(begun), MOST_UNSEEN);
        assert_eq!(strobes(Observer { stuck: true, ..begun }), 0, "a mass that rests can take the tangent");
        assert_eq!(strobes(Observer { turn: Turn::over(1), ..begun }), 0);
        let mut returned = begun;
        returned.recurrence.n = 2;
        assert_eq!(strobes(returned), 0);
        assert_eq!(strobes(Observer { stage: Stage::Observed, ..begun }), 0);
    }

    #[test]
    fn what_passes_unseen_is_noted_as_if_it_was_seen() {
        nothing_is_missed::<f64>();
        nothing_is_missed::<f32>();
    }
}
