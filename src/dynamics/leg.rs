//! The rest of a step of free flight, and whether it stays off the stops.

use super::hull::Hull;
use super::point::Point;
use crate::model::vector::{MOST, dot};
use crate::model::{Flight, Lanes, Mask};

/// From where a trajectory is to where its step ends if nothing more is met on the way.
#[derive(Clone, Copy, Debug)]
pub struct Leg<'a, L, const N: usize> {
    /// Where the trajectory is.
    pub from: &'a Point<L, N>,
    /// Where the step ends.
    pub to: &'a Point<L, N>,
    /// The time in between, 0 < window ≤ h.
    pub window: L,
}

/// Where a leg provably stays off the stops at the two ends of a normal.
#[derive(Clone, Copy, Debug)]
pub struct Clearance<M> {
    /// The stop met where d·x grows.
    pub upper: M,
    /// The stop met where d·x falls.
    pub lower: M,
}

/// The same for each normal; those from the flight's count on mean nothing.
#[derive(Clone, Copy, Debug)]
pub struct Clearances<M>(pub [Clearance<M>; MOST]);

impl<M: Mask> Clearances<M> {
    /// Where the leg stays off the stops of so many normals.
    #[inline(always)]
    pub fn all(&self, count: usize) -> M {
        let mut clear = self.0[0].both();
        for along in &self.0[1..count] {
            clear = clear.and(along.both());
        }
        clear
    }
}

impl<M: Mask> Clearance<M> {
    /// Where the leg stays off both.
    #[inline(always)]
    pub fn both(&self) -> M {
        self.upper.and(self.lower)
    }
}

impl<L: Lanes, const N: usize> Leg<'_, L, N> {
    /// Where the leg provably stays off the stops along each normal.
    #[inline(always)]
    pub fn clearances(&self, flight: &Flight<L, N>) -> Clearances<L::Mask> {
        let mut clearances = Clearances([self.clearance(flight, 0); MOST]);
        for k in 1..flight.count {
            clearances.0[k] = self.clearance(flight, k);
        }
        clearances
    }

    /// Where the leg provably stays off all stops. The first normal is written out: most cells have no other.
    #[inline(always)]
    pub fn clears(&self, flight: &Flight<L, N>) -> L::Mask {
        let mut clear = self.clearance(flight, 0).both();
        for k in 1..flight.count {
            clear = clear.and(self.clearance(flight, k).both());
        }
        clear
    }

    /// Where the leg provably stays off the stops along one normal: where d·x, from where the trajectory is, which is not beyond
    /// a stop, lies within its [`Hull`].
    #[inline(always)]
    pub fn clearance(&self, flight: &Flight<L, N>, k: usize) -> Clearance<L::Mask> {
        let Leg { from, to, window } = *self;
        let normal = &flight.normals[k];
        let ends = dot(&normal.direction, &to.state.x);
        let places = [dot(&normal.direction, &from.state.x), ends];
        let speeds = [dot(&normal.direction, &from.state.v), dot(&normal.direction, &to.state.v)];
        let hull = Hull::of(places, speeds, from.bound(flight, k), window);
        let highest = hull.highest().larger(ends);
        let lowest = hull.lowest().smaller(ends);
        // No comparison with a NaN holds.
        let sound = hull.lower.below(normal.gap[0]);
        Clearance { upper: sound.and(highest.below(normal.gap[0])), lower: (-normal.gap[1]).below(lowest) }
    }
}
