//! The rest of a step of free flight, and whether it stays off the stops.

use super::along::{Along, Alongs, is_normal};
use super::course::Course;
use super::hull::{Hull, Span};
use super::point::Point;
use crate::model::vector::MOST;
use crate::model::{ContactNormal, Flight, Lanes, Mask};

/// From where a trajectory is to where its step ends if nothing more is met on the way.
#[derive(Clone, Copy, Debug)]
pub struct Leg<'a, L, const N: usize> {
    /// Where the trajectory is along each normal.
    pub from: Alongs<L>,
    /// Where it is at the end of the step.
    pub to: Alongs<L>,
    /// The end of the step.
    pub end: &'a Point<L, N>,
    /// The time in between, at most h.
    pub span: Span<L>,
}

/// A leg along one normal.
#[derive(Clone, Copy, Debug)]
pub struct Way<L> {
    /// Where it begins, not beyond a stop.
    pub from: Along<L>,
    /// Where it ends.
    pub to: Along<L>,
    /// The time in between.
    pub span: Span<L>,
    /// A bound on |(d·x)''''| all along.
    pub bound: L,
}

/// Where a leg provably stays off the stops at the two ends of a normal.
#[derive(Clone, Copy, Debug)]
pub struct Clearance<M> {
    /// The stop met where d·x grows.
    pub upper: M,
    /// The stop met where d·x falls.
    pub lower: M,
}

/// The same for each normal; those from their count on mean nothing.
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

impl<'a, L: Lanes, const N: usize> Leg<'a, L, N> {
    /// From somewhere along each normal to the end of the step, so much later.
    #[inline(always)]
    pub fn new(from: Alongs<L>, end: &'a Point<L, N>, span: Span<L>, flight: &Flight<L, N>) -> Self {
        Leg { from, to: Alongs::of(end, flight, from.count), end, span }
    }

    /// The leg along one normal.
    #[inline(always)]
    pub fn along(&self, flight: &Flight<L, N>, k: usize) -> Way<L> {
        Way { from: self.from[k], to: self.to[k], span: self.span, bound: self.end.bound(flight, k) }
    }

    /// The share of a whole step that it takes.
    #[inline(always)]
    pub fn share(&self, flight: &Flight<L, N>) -> L {
        self.span.time * flight.inverse_h
    }

    /// Where the motion is along each normal with the share u of a whole step left, `own` along the one that has a number: there it
    /// is known.
    #[inline(always)]
    pub fn each(&self, u: L, (normal, own): (L, Along<L>), flight: &Flight<L, N>) -> Alongs<L> {
        let mut each = Alongs::all(own, self.from.count);
        if each.count > 1 {
            for k in 0..each.count {
                let course = Course::to(self.end, self.to[k].speed, flight, k);
                let other = course.about(u, [self.share(flight), self.from[k].place]).along(flight);
                each.set(k, Along::select(is_normal(normal, k), &own, &other));
            }
        }
        each
    }

    /// Where the leg provably stays off the stops along one normal.
    #[inline(always)]
    fn clearance(&self, flight: &Flight<L, N>, k: usize) -> Clearance<L::Mask> {
        self.along(flight, k).clearance(&flight.normals[k])
    }

    /// Where the leg provably stays off the stops along each normal.
    #[inline(always)]
    pub fn clearances(&self, flight: &Flight<L, N>) -> Clearances<L::Mask> {
        let mut clearances = Clearances([self.clearance(flight, 0); MOST]);
        for k in 1..self.from.count {
            clearances.0[k] = self.clearance(flight, k);
        }
        clearances
    }

    /// Where the leg provably stays off all stops: all [`clearances`](Self::clearances), which need not be kept.
    #[inline(always)]
    pub fn clears(&self, flight: &Flight<L, N>) -> L::Mask {
        let mut clear = self.clearance(flight, 0).both();
        for k in 1..self.from.count {
            clear = clear.and(self.clearance(flight, k).both());
        }
        clear
    }
}

impl<L: Lanes> Way<L> {
    /// `yes` where the mask holds, `no` elsewhere; they take as long.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        Way {
            from: Along::select(mask, &yes.from, &no.from),
            to: Along::select(mask, &yes.to, &no.to),
            span: no.span,
            bound: L::select(mask, yes.bound, no.bound),
        }
    }

    /// Where it provably stays off the stops of the normal: where d·x lies within its [`Hull`].
    #[inline(always)]
    pub fn clearance<const N: usize>(&self, normal: &ContactNormal<L, N>) -> Clearance<L::Mask> {
        let Way { from, to, span, bound } = *self;
        let hull = Hull::of([from.place, to.place], [from.speed, to.speed], bound, &span);
        let (highest, lowest) = (hull.highest_with(to.place), hull.lowest_with(to.place));
        Clearance { upper: highest.below(normal.gap[0]), lower: (-normal.gap[1]).below(lowest) }
    }
}
