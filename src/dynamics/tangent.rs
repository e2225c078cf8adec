//! Small deviations from the motion, carried through flight and impact.

use super::point::held;
use super::series::{INVERSE_FACTORIALS, Series};
use super::stop::Contact;
use crate::model::vector::{axpy, dot};
use crate::model::{Flight, Real, State};

/// An impact as a deviation meets it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Saltation<T, const N: usize> {
    /// The normal along which it happens.
    pub normal: usize,
    /// d·v−.
    pub velocity: T,
    /// d·v+ − d·v−.
    pub kick: T,
    /// x'' before it.
    pub before: [T; N],
    /// x'' after it.
    pub after: [T; N],
    /// The contacts that hold after it.
    pub contact: Contact,
}

/// What is carried along with a trajectory: nothing, a tangent vector, or several of them.
pub trait Variation<T, const N: usize>: Copy {
    /// One whole step h of free flight later.
    #[must_use]
    fn stepped(&self, flight: &Flight<T, N>) -> Self;

    /// A time `s` ≤ h later with the contacts that hold.
    #[must_use]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self;

    /// Just after an impact: the saltation of the impact law.
    #[must_use]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self;

    /// Once the contacts hold.
    #[must_use]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self;
}

/// A trajectory alone, at no cost.
impl<T, const N: usize> Variation<T, N> for () {
    #[inline(always)]
    fn stepped(&self, _: &Flight<T, N>) -> Self {}

    #[inline(always)]
    fn flown(&self, _: &Flight<T, N>, _: T, _: Contact) -> Self {}

    #[inline(always)]
    fn struck(&self, _: &Flight<T, N>, _: &Saltation<T, N>) -> Self {}

    #[inline(always)]
    fn caught(&self, _: &Flight<T, N>, _: Contact) -> Self {}
}

/// Several tangent vectors.
impl<T: Real, const N: usize, const M: usize> Variation<T, N> for [Tangent<T, N>; M] {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, N>) -> Self {
        self.map(|tangent| tangent.stepped(flight))
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        self.map(|tangent| tangent.flown(flight, s, contact))
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        self.map(|tangent| tangent.struck(flight, impact))
    }

    #[inline(always)]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        self.map(|tangent| tangent.caught(flight, contact))
    }
}

/// A tangent vector: a deviation of the state at fixed time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T, const N: usize>(pub State<T, N>);

impl<T: Real, const N: usize> Variation<T, N> for Tangent<T, N> {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, N>) -> Self {
        let mut state = flight.phi_x[0].scaled(self.0.x[0]);
        for (column, &x) in flight.phi_x.iter().zip(&self.0.x).skip(1) {
            state = state.plus(x, column);
        }
        for (column, &v) in flight.phi_v.iter().zip(&self.0.v) {
            state = state.plus(v, column);
        }
        Tangent(state)
    }

    /// See [`Point::flown`](super::Point::flown).
    #[inline(always)]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let series = Series::new(flight, s);
        let mut before = self.0.v;
        let mut last = held(flight, contact, series.first(flight, &self.0.x, &before)).0;
        let mut velocity = before;
        let mut mean = before;
        let mut power = T::one();
        for k in 1..=T::ORDER {
            velocity = axpy(T::of(INVERSE_FACTORIALS[k]), &last, &velocity);
            mean = axpy(T::of(INVERSE_FACTORIALS[k + 1]), &last, &mean);
            let negligible;
            (power, negligible) = series.grow(power, k);
            if negligible {
                break;
            }
            let next = held(flight, contact, series.next(&before, &last, &[T::zero(); N])).0;
            (before, last) = (last, next);
        }
        Tangent(State { x: axpy(s, &mean, &self.0.x), v: velocity })
    }

    /// A deviation d·ξ shifts the impact by −d·ξ/d·v−; what differs on either side of it (v along the response, and x'')
    /// acts for that long.
    #[inline(always)]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        let normal = &flight.normals[impact.normal];
        let shift = dot(&normal.direction, &self.0.x) / impact.velocity;
        // −(1 + r), as it acted.
        let factor = impact.kick / impact.velocity;
        let along = dot(&normal.direction, &self.0.v) - dot(&normal.direction, &impact.before) * shift;
        let v = axpy(factor * along, &normal.response, &self.0.v);
        let struck = Tangent(State {
            x: axpy(impact.kick * shift, &normal.response, &self.0.x),
            v: std::array::from_fn(|i| v[i] + (impact.after[i] - impact.before[i]) * shift),
        });
        if impact.contact.is_free() { struck } else { struck.caught(flight, impact.contact) }
    }

    /// What the deviation had along the normals that hold is lost.
    #[inline(always)]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        Tangent(State { x: held(flight, contact, self.0.x).0, v: held(flight, contact, self.0.v).0 })
    }
}

impl<T: Real, const N: usize> Tangent<T, N> {
    /// The deviation every measurement begins with: all components alike, of unit length.
    pub fn seed() -> Self {
        let one = T::one();
        let each = one / T::of(2.0 * N as f64).sqrt();
        Tangent(State { x: [each; N], v: [each; N] })
    }

    /// The deviation's Euclidean length.
    #[inline(always)]
    pub fn length(&self) -> T {
        self.0.length()
    }

    /// The deviation divided by a number.
    #[inline(always)]
    pub fn scaled(&self, factor: T) -> Self {
        Tangent(self.0.scaled(factor))
    }
}
