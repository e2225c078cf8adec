//! The rest of a step of free flight, and whether it stays off the stops.

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

/// What the error of a cubic Hermite interpolant adds to the middle one of five Bernstein coefficients, in w⁴·max|x''''|.
pub const SWELLING: f64 = 1.0 / 144.0;

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

    /// Where the leg provably stays off the stops along one normal.
    ///
    /// d·x differs from its cubic Hermite interpolant by s²(w − s)²/24·max|(d·x)''''| at most: a polynomial of fourth
    /// degree, so that what bounds d·x lies within the hull of its five Bernstein coefficients. The first of them is where
    /// the trajectory is, and that is not beyond a stop.
    #[inline(always)]
    pub fn clearance(&self, flight: &Flight<L, N>, k: usize) -> Clearance<L::Mask> {
        let Leg { from, to, window } = *self;
        let normal = &flight.normals[k];
        let begins = dot(&normal.direction, &from.state.x);
        let leaves = dot(&normal.direction, &from.state.v);
        let ends = dot(&normal.direction, &to.state.x);
        let arrives = dot(&normal.direction, &to.state.v);
        let quarter = window * window.all(0.25);
        let square = window * window;
        let margin = (square * square) * (window.all(SWELLING) * from.bound(flight, k));
        let second = leaves.times_plus(quarter, begins);
        let fourth = (-arrives).times_plus(quarter, ends);
        let turn = (leaves - arrives) * (window * window.all(1.0 / 6.0));
        let middle = (begins + ends).times_plus(window.all(0.5), turn);
        let highest = second.larger(fourth).larger(ends).larger(middle + margin);
        let lowest = second.smaller(fourth).smaller(ends).smaller(middle - margin);
        // A NaN anywhere makes `middle` a NaN, and no comparison holds.
        let sound = (middle - margin).below(normal.gap[0]);
        Clearance { upper: sound.and(highest.below(normal.gap[0])), lower: (-normal.gap[1]).below(lowest) }
    }
}
