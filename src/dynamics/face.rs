//! Which stop a leg has to meet, if any.

use super::contact::ROUNDINGS;
use super::leg::{Clearances, Leg};
use crate::model::vector::{MOST, axpy, dot, select};
use crate::model::{Flight, Lanes, Mask, Real, State};

/// The stop that a leg ends beyond, or that it may touch on its way and return; the last if there are several.
#[derive(Clone, Copy, Debug)]
pub struct Face<L: Lanes, const N: usize> {
    /// Where there is exactly one, and the leg stays off all stops along other normals.
    pub only: L::Mask,
    /// Where there is one.
    pub found: L::Mask,
    /// Where the leg ends between the stops of the normal, and stays off one of them but may touch the other.
    pub returns: L::Mask,
    /// Where the leg stays off the stop at the other end of the normal.
    pub opposite_clear: L::Mask,
    pub normals: [L::Mask; MOST],
    pub upper: L::Mask,
    /// +1 at the upper end, −1 at the lower one.
    pub sign: L,
    pub gap: L,
    /// From there to the stop at the other end of the normal.
    pub width: L,
    pub restitution: L,
    pub direction: [L; N],
    pub response: [L; N],
    pub bound: L,
    /// See [`ContactNormal::coupling`](crate::model::ContactNormal::coupling).
    pub coupling: L,
}

impl<L: Lanes, const N: usize> Face<L, N> {
    #[inline(always)]
    pub fn of(leg: &Leg<'_, L, N>, clearances: &Clearances<L::Mask>, flight: &Flight<L, N>) -> Self {
        let mut face = Face::along(0, leg, clearances, flight);
        for k in 1..flight.count {
            face.or(k, &Face::along(k, leg, clearances, flight));
        }
        face.only = face.only.and(face.found);
        face
    }

    /// The same along one normal.
    #[inline(always)]
    fn along(k: usize, leg: &Leg<'_, L, N>, clearances: &Clearances<L::Mask>, flight: &Flight<L, N>) -> Self {
        let (normal, clear) = (&flight.normals[k], clearances.0[k]);
        let ends = dot(&normal.direction, &leg.to.state.x);
        let beyond_upper = normal.gap[0].below(ends);
        let beyond = beyond_upper.or(normal.gap[1].below(-ends));
        let returns = clear.upper.or(clear.lower).and(clear.both().or(beyond).not());
        let upper = beyond_upper.or(returns.and(clear.lower));
        let found = beyond.or(returns);
        let mut normals = [found.and(found.not()); MOST];
        normals[k] = found;
        Face {
            only: found.or(clear.both()),
            found,
            returns,
            opposite_clear: upper.and(clear.lower).or(found.and(upper.not()).and(clear.upper)),
            normals,
            upper,
            sign: L::select(upper, ends.all(1.0), ends.all(-1.0)),
            gap: L::select(upper, normal.gap[0], normal.gap[1]),
            width: normal.gap[0] + normal.gap[1],
            restitution: L::select(upper, normal.restitution[0], normal.restitution[1]),
            direction: normal.direction,
            response: normal.response,
            bound: leg.from.bound(flight, k),
            coupling: normal.coupling,
        }
    }

    /// That of another normal, where the leg has one to meet.
    #[inline(always)]
    fn or(&mut self, k: usize, other: &Self) {
        let found = other.found;
        self.only = self.only.and(other.only).and(found.and(self.found).not());
        self.found = self.found.or(found);
        self.returns = self.returns.or(other.returns);
        self.opposite_clear = self.opposite_clear.or(other.opposite_clear);
        self.normals[k] = found;
        self.upper = found.and(other.upper).or(found.not().and(self.upper));
        self.sign = L::select(found, other.sign, self.sign);
        self.gap = L::select(found, other.gap, self.gap);
        self.width = L::select(found, other.width, self.width);
        self.restitution = L::select(found, other.restitution, self.restitution);
        self.bound = L::select(found, other.bound, self.bound);
        self.coupling = L::select(found, other.coupling, self.coupling);
        self.direction = select(found, &other.direction, &self.direction);
        self.response = select(found, &other.response, &self.response);
    }

    /// A vector's part towards the stop.
    #[inline(always)]
    pub fn towards(&self, vector: &[L; N]) -> L {
        self.sign * dot(&self.direction, vector)
    }

    /// How wide the gap is in a state.
    #[inline(always)]
    pub fn open(&self, state: &State<L, N>) -> L {
        self.gap - self.towards(&state.x)
    }

    /// How far from the stop a state may seem to be for rounding, `way` being the length of the way to it.
    #[inline(always)]
    pub fn rounding(&self, state: &State<L, N>, way: L) -> L {
        let mut parts = (self.direction[0] * state.x[0]).magnitude();
        for i in 1..N {
            parts = parts + (self.direction[i] * state.x[i]).magnitude();
        }
        (self.gap.magnitude() + way.magnitude() + parts) * way.all(ROUNDINGS * L::Real::EPSILON)
    }

    /// How far a state is from the stop, along the normal.
    #[inline(always)]
    fn away(&self, state: &State<L, N>) -> L {
        self.sign * self.gap - dot(&self.direction, &state.x)
    }

    /// Where a state is on the stop, up to rounding.
    #[inline(always)]
    pub fn meets(&self, state: &State<L, N>, rounding: L) -> L::Mask {
        self.away(state).magnitude().below(rounding)
    }

    /// Moved onto the stop, with d·v as given.
    #[inline(always)]
    pub fn placed(&self, state: &State<L, N>, speed: L) -> State<L, N> {
        let change = speed - dot(&self.direction, &state.v);
        State {
            x: axpy(self.away(state), &self.response, &state.x),
            v: axpy(change, &self.response, &state.v),
        }
    }
}
