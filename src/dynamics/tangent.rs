//! Small deviations from the motion, carried through flight and impact.
//!
//! How a deviation passes an impact (the saltation of the flow): P. C. Müller, Chaos, Solitons & Fractals 5 (1995) 1671–1681,
//! doi:10.1016/0960-0779(94)00170-U.

use super::point::held;
use super::series::{INVERSE_FACTORIALS, Series};
use super::stop::Contact;
use crate::model::vector::{applied, applied_onto, axpy, dot, scaled, scaled_columns};
use crate::model::{Flight, Lanes, Real, State};

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

/// An impact that ends in flight, as deviations in lanes meet it.
#[derive(Clone, Copy, Debug)]
pub struct Struck<L, const N: usize> {
    /// d.
    pub direction: [L; N],
    /// M⁻¹d/(dᵀM⁻¹d).
    pub response: [L; N],
    /// d·v−.
    pub velocity: L,
    /// d·v+ − d·v−.
    pub kick: L,
    /// x'' before it.
    pub before: [L; N],
    /// x'' after it.
    pub after: [L; N],
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

/// Several tangent vectors, as exact as flight itself. Loops, since what a closure does has not its caller's instructions.
impl<T: Real, const N: usize, const M: usize> Variation<T, N> for [Tangent<T, N>; M] {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, N>) -> Self {
        let mut later = *self;
        for tangent in &mut later {
            *tangent = tangent.stepped(flight);
        }
        later
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let mut later = *self;
        for tangent in &mut later {
            *tangent = tangent.flown_with(flight, s, contact, T::ORDER);
        }
        later
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        let mut later = *self;
        for tangent in &mut later {
            *tangent = tangent.struck(flight, impact);
        }
        later
    }

    #[inline(always)]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        let mut later = *self;
        for tangent in &mut later {
            *tangent = tangent.caught(flight, contact);
        }
        later
    }
}

/// A tangent vector: a deviation of the state at fixed time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T, const N: usize>(pub State<T, N>);

impl<T: Real, const N: usize> Variation<T, N> for Tangent<T, N> {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, N>) -> Self {
        self.stepped_freely(flight)
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        self.flown_with(flight, s, contact, T::TANGENT_ORDER)
    }

    /// A deviation d·ξ shifts the impact by −d·ξ/d·v−; what differs on either side of it (v along the response, and x'')
    /// acts for that long.
    #[inline(always)]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        let normal = &flight.normals[impact.normal];
        let struck = self.struck_freely(&Struck {
            direction: normal.direction,
            response: normal.response,
            velocity: impact.velocity,
            kick: impact.kick,
            before: impact.before,
            after: impact.after,
        });
        if impact.contact.is_free() { struck } else { struck.caught(flight, impact.contact) }
    }

    /// What the deviation had along the normals that hold is lost.
    #[inline(always)]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        Tangent(State { x: held(flight, contact, self.0.x).0, v: held(flight, contact, self.0.v).0 })
    }
}

impl<L: Lanes, const N: usize> Tangent<L, N> {
    /// One whole step h of free flight later.
    #[inline(always)]
    #[must_use]
    pub fn stepped_freely(&self, flight: &Flight<L, N>) -> Self {
        let mut state = flight.phi_x[0].scaled(self.0.x[0]);
        for i in 1..N {
            state = state.plus(self.0.x[i], &flight.phi_x[i]);
        }
        for i in 0..N {
            state = state.plus(self.0.v[i], &flight.phi_v[i]);
        }
        Tangent(state)
    }

    /// A time `s` ≤ h of free flight later, by a Taylor polynomial of the same order in every lane; see
    /// [`Point::flown_near`](super::Point::flown_near).
    #[inline(always)]
    #[must_use]
    pub fn flown_freely(&self, flight: &Flight<L, N>, s: L, order: usize) -> Self {
        let square = s * s;
        let springs = scaled_columns(square, &flight.stiffness);
        let dampers = scaled_columns(s, &flight.damping);
        let mut before = self.0.v;
        let pulled = scaled(s, &applied(&flight.stiffness, &self.0.x));
        let mut last = applied_onto(&dampers, &before, &pulled);
        let mut velocity = before;
        let mut mean = before;
        for k in 1..=order {
            velocity = axpy(s.all(INVERSE_FACTORIALS[k]), &last, &velocity);
            mean = axpy(s.all(INVERSE_FACTORIALS[k + 1]), &last, &mean);
            let pulled = applied(&springs, &before);
            (before, last) = (last, applied_onto(&dampers, &last, &pulled));
        }
        Tangent(State { x: axpy(s, &mean, &self.0.x), v: velocity })
    }

    /// Just after an impact that ends in flight; see [`Variation::struck`].
    #[inline(always)]
    #[must_use]
    pub fn struck_freely(&self, struck: &Struck<L, N>) -> Self {
        let shift = dot(&struck.direction, &self.0.x) / struck.velocity;
        // −(1 + r), as it acted.
        let factor = struck.kick / struck.velocity;
        let along =
            (-dot(&struck.direction, &struck.before)).times_plus(shift, dot(&struck.direction, &self.0.v));
        let mut v = axpy(factor * along, &struck.response, &self.0.v);
        for (v, (after, before)) in v.iter_mut().zip(struck.after.iter().zip(&struck.before)) {
            *v = (*after - *before).times_plus(shift, *v);
        }
        Tangent(State { x: axpy(struck.kick * shift, &struck.response, &self.0.x), v })
    }
}

impl<T: Real, const N: usize> Tangent<T, N> {
    /// A time `s` ≤ h later with the contacts that hold, in free flight by a polynomial of an order.
    #[inline(always)]
    fn flown_with(&self, flight: &Flight<T, N>, s: T, contact: Contact, order: usize) -> Self {
        if contact.is_free() {
            self.flown_freely(flight, s, order)
        } else {
            self.flown_held(flight, s, contact)
        }
    }

    /// See [`Point::flown`](super::Point::flown).
    #[inline(always)]
    fn flown_held(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
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

    /// The deviation every measurement begins with: all components alike, of unit length.
    pub fn seed() -> Self {
        let each = T::of(1.0 / (2.0 * N as f64).sqrt());
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

#[cfg(test)]
mod tests;
