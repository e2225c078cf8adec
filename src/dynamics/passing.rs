//! Strobes at which nothing is to be decided: trajectories side by side pass them together.

use super::moments::Moments;
use super::moves::Moves;
use super::tally::Tally;
use super::tangent::Tangent;
use crate::model::{BOUND, Lanes, Mask, Real, State};

/// How often a trajectory may pass phase 0 before it is to be seen there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unseen<T, const N: usize> {
    /// So many times.
    pub strobes: u32,
    /// It is to be seen where it comes near this state.
    pub anchor: State<T, N>,
    /// It is near where no component differs by more than this; below zero it never is.
    pub nearest: T,
    /// What it scatters by meanwhile, where that is summed up.
    pub scattering: Option<Scattering<T, N>>,
}

/// The moments of states at phase 0 about one of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scattering<T, const N: usize> {
    /// What they are about.
    pub about: State<T, N>,
    /// The moments so far.
    pub moments: Moments<T, N>,
}

impl<T: Real, const N: usize> Unseen<T, N> {
    /// Never.
    pub fn none() -> Self {
        Unseen { strobes: 0, anchor: State::zero(), nearest: T::zero(), scattering: None }
    }
}

/// Where trajectories may pass phase 0 unseen, lane by lane.
#[derive(Clone, Copy, Debug)]
pub struct Passing<L: Lanes, const N: usize> {
    strobes: L,
    anchor: State<L, N>,
    nearest: L,
    about: State<L, N>,
    moments: Moments<L, N>,
}

impl<L: Lanes, const N: usize> Passing<L, N> {
    /// All are to be seen.
    pub fn none(zero: L) -> Self {
        let state = State { x: [zero; N], v: [zero; N] };
        Passing { strobes: zero, anchor: state, nearest: zero, about: state, moments: Moments::none(zero) }
    }

    /// What one of them may do from here.
    pub fn set_lane(&mut self, lane: usize, unseen: &Unseen<L::Real, N>) {
        self.strobes.renew_lane(lane, L::Real::of(f64::from(unseen.strobes)));
        if unseen.strobes > 0 {
            self.anchor.set_lane(lane, &unseen.anchor);
            self.nearest.renew_lane(lane, unseen.nearest);
            if let Some(Scattering { about, moments }) = &unseen.scattering {
                self.about.set_lane(lane, about);
                self.moments.set_lane(lane, moments);
            }
        }
    }

    /// What the states in a lane scatter by, those that passed unseen among them.
    pub fn moments(&self, lane: usize) -> Moments<L::Real, N> {
        self.moments.lane(lane)
    }

    /// Which of those that come to phase 0 with these states pass it unseen. They have moved since they were last there, not
    /// so often that others would wait for them, and are not near where they may return to; their moves are counted anew. Where a
    /// tangent is `carried` along it may be left to grow, and the state counts for what they scatter by.
    #[inline(always)]
    pub fn pass(
        &mut self,
        coming: L::Mask,
        state: &State<L, N>,
        (tangent, carried): (&State<L, N>, L::Mask),
        tally: &mut Tally<L>,
    ) -> L::Mask {
        let zero = self.strobes.all(0.0);
        let may = coming.and(zero.below(self.strobes));
        if may.bits() == 0 {
            return may;
        }
        let (mut farthest, mut sum) = (zero, zero);
        for i in 0..N {
            let x = (state.x[i] - self.anchor.x[i]).magnitude();
            let v = (state.v[i] - self.anchor.v[i]).magnitude();
            farthest = x.larger(v).larger(farthest);
            sum = sum + (state.x[i].magnitude() + state.v[i].magnitude());
        }
        // What may not be bounded is to be seen. The sum of what is no number is none, and below nothing.
        let away = self.nearest.below(farthest).and(sum.below(zero.all(BOUND)));
        let moved = zero.below(tally.moves).and(tally.moves.below(zero.all(f64::from(Moves::MANY))));
        let mut passes = may.and(away).and(moved);
        if passes.and(carried).bits() != 0 {
            passes = passes.and(carried.not().or(Tangent::<L, N>::may_be_left(tangent.square())));
            self.moments.add(passes.and(carried), state, &self.about);
        }
        let one = zero.all(1.0);
        // Nothing is taken away where nothing passed, as [`Tally`] adds nothing.
        let passed = L::select(passes, one, zero);
        self.strobes = self.strobes - passed;
        tally.strobes = tally.strobes + passed;
        tally.moves = tally.moves - L::select(passes, tally.moves, zero);
        passes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ANCHOR: State<f64, 2> = State { x: [0.1, -0.2], v: [1.0, 0.0] };

    const NOT_CARRIED: (&State<f64, 2>, bool) = (&ANCHOR, false);

    /// Whether a trajectory passes phase 0 unseen that may do so a number of times and made some moves, with any one component of
    /// its state so far off the anchor.
    fn passes(strobes: u32, moves: f64, off: f64) -> bool {
        let one_by_one: Vec<bool> = (0..4).map(|i| passes_with(strobes, moves, off, i)).collect();
        assert!(one_by_one.iter().all(|&passes| passes == one_by_one[0]), "{one_by_one:?}");
        one_by_one[0]
    }

    fn passes_with(strobes: u32, moves: f64, off: f64, component: usize) -> bool {
        let mut passing = Passing::none(0.0);
        passing.set_lane(0, &Unseen { strobes, anchor: ANCHOR, nearest: 1e-6, scattering: None });
        let mut tally = Tally { moves, ..Tally::none(0.0) };
        let mut state = ANCHOR;
        let part = if component < 2 { &mut state.x[component] } else { &mut state.v[component - 2] };
        *part += off;
        let passes = passing.pass(true, &state, NOT_CARRIED, &mut tally);
        assert_eq!(tally.strobes, f64::from(u8::from(passes)));
        assert_eq!(tally.moves, if passes { 0.0 } else { moves });
        passes
    }

    #[test]
    fn a_strobe_is_passed_unseen_where_nothing_is_to_be_decided() {
        assert!(passes(1, 3.0, 0.5) && passes(9, 1.0, -2e-6));
        assert!(!passes(0, 3.0, 0.5), "it is to be seen");
        assert!(!passes(1, 0.0, 0.5), "it may never move again");
        assert!(!passes(1, f64::from(Moves::MANY), 0.5), "others would wait for it");
        assert!(!passes(1, 3.0, 1e-7) && !passes(1, 3.0, 0.0), "it may have returned");
        assert!(passes(1, 3.0, 9e17) && !passes(1, 3.0, 1e18), "it may be beyond all bounds");
        assert!(!passes(1, 3.0, 1e31) && !passes(1, 3.0, f64::INFINITY) && !passes(1, 3.0, f64::NAN));
    }

    #[test]
    fn strobes_are_counted_down_where_a_trajectory_comes_to_one() {
        let mut passing = Passing::none(0.0);
        passing.set_lane(0, &Unseen { strobes: 2, anchor: ANCHOR, nearest: -1.0, scattering: None });
        let mut tally = Tally::none(0.0);
        let passed: Vec<bool> = [true, false, true, true]
            .into_iter()
            .map(|coming| {
                tally.moves = 1.0;
                passing.pass(coming, &ANCHOR, NOT_CARRIED, &mut tally)
            })
            .collect();
        assert_eq!((passed, tally.strobes), (vec![true, false, true, false], 2.0));
    }

    /// Whether a trajectory that is observed passes with a tangent of so many times unit length, and what it scatters by then.
    fn passes_with_tangent(length: f64) -> (bool, Moments<f64, 2>) {
        let mut passing = Passing::none(0.0);
        let moments = Moments { sum: ANCHOR, square: 3.0 };
        let about = State { x: [0.0, 1.0], v: [0.0; 2] };
        let scattering = Some(Scattering { about, moments });
        passing.set_lane(0, &Unseen { strobes: 1, anchor: ANCHOR, nearest: -1.0, scattering });
        let tangent = State { x: [0.6 * length, 0.0], v: [0.0, 0.8 * length] };
        let mut tally = Tally { moves: 2.0, ..Tally::none(0.0) };
        (passing.pass(true, &ANCHOR, (&tangent, true), &mut tally), passing.moments(0))
    }

    #[test]
    fn a_tangent_far_from_unit_length_is_seen_and_what_passes_is_counted() {
        let before = Moments { sum: ANCHOR, square: 3.0 };
        for length in [1.0, 2e-6, 9e5] {
            let (passes, moments) = passes_with_tangent(length);
            // (0.1, −0.2, 1, 0) − (0, 1, 0, 0), squared: 0.01 + 1.44 + 1.
            let sum = State { x: [0.1 + 0.1, -0.2 - 1.2], v: [2.0, 0.0] };
            assert!(passes && moments.sum == sum, "{moments:?}");
            assert!((moments.square - 5.45).abs() < 1e-12, "{moments:?}");
        }
        for length in [0.0, 9e-7, 2e6, 1e200, f64::INFINITY, f64::NAN] {
            assert_eq!(passes_with_tangent(length), (false, before), "{length}");
        }
    }
}
