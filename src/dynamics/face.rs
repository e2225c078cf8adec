//! Which stop a leg has to meet, if any.

use super::contact::ROUNDINGS;
use super::leg::{Clearances, Leg, Way};
use crate::model::vector::select;
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
    /// The number of the normal.
    pub normal: L,
    pub upper: L::Mask,
    /// +1 at the upper end, −1 at the lower one.
    pub sign: L,
    pub gap: L,
    /// From there to the stop at the other end of the normal.
    pub width: L,
    pub restitution: L,
    pub direction: [L; N],
    pub response: [L; N],
    /// The leg along the normal.
    pub way: Way<L>,
    /// How fast damping alone takes speed along it.
    pub drag: L,
    /// See [`ContactNormal::coupling`](crate::model::ContactNormal::coupling).
    pub coupling: L,
}

impl<L: Lanes, const N: usize> Face<L, N> {
    #[inline(always)]
    pub fn of(leg: &Leg<'_, L, N>, clearances: &Clearances<L::Mask>, flight: &Flight<L, N>) -> Self {
        let mut face = Face::along(0, leg, clearances, flight);
        for k in 1..leg.from.count {
            face.or(&Face::along(k, leg, clearances, flight));
        }
        face.only = face.only.and(face.found);
        face
    }

    /// The same along one normal.
    #[inline(always)]
    fn along(k: usize, leg: &Leg<'_, L, N>, clearances: &Clearances<L::Mask>, flight: &Flight<L, N>) -> Self {
        let (normal, clear) = (&flight.normals[k], clearances.0[k]);
        let way = leg.along(flight, k);
        let ends = way.to.place;
        let beyond_upper = normal.gap[0].below(ends);
        let beyond = beyond_upper.or(normal.gap[1].below(-ends));
        let returns = clear.upper.or(clear.lower).and(clear.both().or(beyond).not());
        let upper = beyond_upper.or(returns.and(clear.lower));
        let found = beyond.or(returns);
        Face {
            only: found.or(clear.both()),
            found,
            returns,
            opposite_clear: upper.and(clear.lower).or(found.and(upper.not()).and(clear.upper)),
            normal: ends.all(k as f64),
            upper,
            sign: L::select(upper, ends.all(1.0), ends.all(-1.0)),
            gap: L::select(upper, normal.gap[0], normal.gap[1]),
            width: normal.gap[0] + normal.gap[1],
            restitution: L::select(upper, normal.restitution[0], normal.restitution[1]),
            direction: normal.direction,
            response: normal.response,
            way,
            drag: normal.drag,
            coupling: normal.coupling,
        }
    }

    /// That of another normal, where the leg has one to meet.
    #[inline(always)]
    fn or(&mut self, other: &Self) {
        let found = other.found;
        self.only = self.only.and(other.only).and(found.and(self.found).not());
        self.found = self.found.or(found);
        self.returns = self.returns.or(other.returns);
        self.opposite_clear = self.opposite_clear.or(other.opposite_clear);
        self.normal = L::select(found, other.normal, self.normal);
        self.upper = found.and(other.upper).or(found.not().and(self.upper));
        self.sign = L::select(found, other.sign, self.sign);
        self.gap = L::select(found, other.gap, self.gap);
        self.width = L::select(found, other.width, self.width);
        self.restitution = L::select(found, other.restitution, self.restitution);
        self.way = Way::select(found, &other.way, &self.way);
        self.drag = L::select(found, other.drag, self.drag);
        self.coupling = L::select(found, other.coupling, self.coupling);
        self.direction = select(found, &other.direction, &self.direction);
        self.response = select(found, &other.response, &self.response);
    }

    /// How wide the gap is at a place along the normal.
    #[inline(always)]
    pub fn open(&self, place: L) -> L {
        self.gap - self.sign * place
    }

    /// How far from the stop a place on a leg to a state may seem to be for rounding, `way` being the length of the way to it.
    #[inline(always)]
    pub fn rounding(&self, state: &State<L, N>, way: L) -> L {
        let window = self.way.span.time;
        let mut parts = (self.direction[0] * state.x[0]).magnitude();
        for i in 1..N {
            parts = parts + (self.direction[i] * state.x[i]).magnitude();
        }
        for i in 0..N {
            parts = parts + (window * (self.direction[i] * state.v[i])).magnitude();
        }
        (self.gap.magnitude() + way.magnitude() + parts) * way.all(ROUNDINGS * L::Real::EPSILON)
    }
}
