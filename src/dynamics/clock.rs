//! Where trajectories side by side are in their forcing periods.

use super::point::Point;
use crate::model::{Lanes, Mask, Real};

/// Steps from phase to phase.
#[derive(Clone, Copy, Debug)]
pub struct Clock<L> {
    /// To the next phase 0 or π.
    left: L,
    /// From one of them to the other.
    half: L,
    /// Cosine of the last of them: 1 or −1.
    phase: L,
}

impl<L: Lanes> Clock<L> {
    /// For nothing in any lane.
    pub fn stopped(zero: L) -> Self {
        Clock { left: zero, half: zero, phase: zero }
    }

    /// For a cell with so many steps in a period.
    #[inline(always)]
    pub fn prepare(&mut self, lane: usize, steps: u32) {
        self.half.set_lane(lane, L::Real::of(f64::from(steps / 2)));
    }

    /// For a trajectory at the beginning of one of them.
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, steps: u32, step: u32) {
        let half = steps / 2;
        self.left.set_lane(lane, L::Real::of(f64::from(half - step % half)));
        self.phase.set_lane(lane, L::Real::of(if step < half { 1.0 } else { -1.0 }));
    }

    /// The step that is under way in a lane, of so many in a period.
    pub fn step(&self, lane: usize, steps: u32) -> u32 {
        let left = self.left.lane(lane).widen() as u32;
        if self.is_past_half(lane) { steps - left } else { steps / 2 - left }
    }

    /// Whether the last of the phases 0 and π in a lane was π.
    #[inline(always)]
    pub fn is_past_half(&self, lane: usize) -> bool {
        self.phase.lane(lane) < L::Real::of(0.0)
    }

    /// Where the step under way ends at phase 0 or π.
    #[inline(always)]
    pub fn arrives(&self) -> L::Mask {
        self.left.below(self.left.all(1.5))
    }

    /// Where it ends at phase 0.
    #[inline(always)]
    pub fn comes_to_zero(&self) -> L::Mask {
        self.arrives().and(self.phase.below(self.phase.all(0.0)))
    }

    /// The end of the step under way: at phases 0 and π the forcing phasor is exact.
    #[inline(always)]
    pub fn exact<const N: usize>(&self, end: &Point<L, N>) -> Point<L, N> {
        let arrives = self.arrives();
        Point {
            sin: L::select(arrives, self.left.all(0.0), end.sin),
            cos: L::select(arrives, -self.phase, end.cos),
            ..*end
        }
    }

    /// Counts the step of some lanes.
    #[inline(always)]
    pub fn count(&mut self, moves: L::Mask) {
        let arrived = moves.and(self.arrives());
        let left = self.left - L::select(moves, self.left.all(1.0), self.left.all(0.0));
        self.left = L::select(arrived, self.half, left);
        self.phase = L::select(arrived, -self.phase, self.phase);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clock_goes_around_the_period() {
        let (mut clock, steps) = (Clock::stopped(0.0f64), 6);
        clock.prepare(0, steps);
        clock.set_lane(0, steps, 0);
        let point = Point { state: crate::model::State { x: [0.0], v: [0.0] }, sin: 0.5, cos: 0.25 };
        for step in (0..steps).chain(0..steps) {
            assert_eq!((clock.step(0, steps), clock.is_past_half(0)), (step, step >= 3));
            let ends = (step + 1) % steps;
            assert_eq!((clock.arrives(), clock.comes_to_zero()), (ends % 3 == 0, ends == 0));
            let end = clock.exact(&point);
            let exact = [(0.0, 1.0), (0.5, 0.25), (0.0, -1.0)]
                [if ends == 0 { 0 } else { 1 + usize::from(ends == 3) }];
            assert_eq!((end.sin, end.cos), exact, "after step {step}");
            clock.count(false);
            assert_eq!(clock.step(0, steps), step, "what does not move is not counted");
            clock.count(true);
        }
    }
}
