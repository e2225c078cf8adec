//! Small deviations from the motion, carried through flight and impact.
//!
//! How a deviation passes an impact (the saltation of the flow): P. C. Müller, Chaos, Solitons & Fractals 5 (1995) 1671–1681,
//! doi:10.1016/0960-0779(94)00170-U.

use pulp::NullaryFnOnce;

use super::held::spared;
use super::series::{Flown, INVERSE_FACTORIALS, Series};
use super::stop::Contact;
use crate::model::vector::{applied, applied_onto, axpy, dot};
use crate::model::{Flight, Lanes, Mask, Real, State};

/// An impact that begins in contact, as a deviation meets it.
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

/// An impact that begins in free flight, as the deviation of the end of its step meets it.
#[derive(Clone, Copy, Debug)]
pub struct FreeSaltation<L, const N: usize> {
    /// d·v−.
    pub velocity: L,
    /// d·v+ − d·v−.
    pub kick: L,
    /// d·x'' before it.
    pub pull: L,
    /// What a change of d·v by 1 has become at the end of the step.
    pub wake: State<L, N>,
}

/// A tangent vector: a deviation of the state at fixed time.
///
/// One that is carried along with a trajectory is, while a step of free flight is under way, the deviation of the end of that step
/// as it would be without another impact: an impact adds what its jump has become by then, and a flight to the impact changes
/// nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T, const N: usize>(pub State<T, N>);

impl<T: Real, const N: usize> Tangent<T, N> {
    /// A time `s` later with the contacts that hold, |s| ≤ h; in free flight `s` may be negative.
    ///
    /// By the Taylor polynomial of the equations of motion; see [`Point::flown`](super::Point::flown).
    #[inline(never)]
    #[must_use]
    pub fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        T::fused(Flown { from: self, flight, s, contact })
    }

    /// Just after an impact that begins in contact: the saltation of the impact law.
    ///
    /// A deviation d·ξ shifts the impact by −d·ξ/d·v−; what differs on either side of it (v along the response, and x'')
    /// acts for that long.
    #[inline(always)]
    #[must_use]
    pub fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        let normal = &flight.normals[impact.normal];
        let shift = dot(&normal.direction, &self.0.x) / impact.velocity;
        // −(1 + r), as it acted.
        let factor = impact.kick / impact.velocity;
        let along =
            (-dot(&normal.direction, &impact.before)).times_plus(shift, dot(&normal.direction, &self.0.v));
        let mut v = axpy(factor * along, &normal.response, &self.0.v);
        for (v, (after, before)) in v.iter_mut().zip(impact.after.iter().zip(&impact.before)) {
            *v = (*after - *before).times_plus(shift, *v);
        }
        let struck = Tangent(State { x: axpy(impact.kick * shift, &normal.response, &self.0.x), v });
        if impact.contact.is_free() { struck } else { struck.caught(flight, impact.contact) }
    }

    /// Once the contacts hold: what the deviation had along their normals is lost.
    #[inline(always)]
    #[must_use]
    pub fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        Tangent(State { x: spared(flight, contact, self.0.x), v: spared(flight, contact, self.0.v) })
    }
}

impl<T: Real, const N: usize> NullaryFnOnce for Flown<'_, Tangent<T, N>, T, N> {
    type Output = Tangent<T, N>;

    #[inline(always)]
    fn call(self) -> Tangent<T, N> {
        let Flown { from, flight, s, contact } = self;
        let series = Series::new(flight, s, contact);
        let mut before = from.0.v;
        let mut last = series.first(flight, contact, &from.0.x, &before);
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
            (before, last) = (last, series.next(&before, &last, &[T::zero(); N]));
        }
        Tangent(State { x: axpy(s, &mean, &from.0.x), v: velocity })
    }
}

impl<L: Lanes, const N: usize> Tangent<L, N> {
    /// One whole step h of free flight later.
    #[inline(always)]
    #[must_use]
    pub fn stepped_freely(&self, flight: &Flight<L, N>) -> Self {
        Tangent(flight.step.of_deviation(&self.0))
    }

    /// The deviation of the end of a step after an impact in it, `back` being the row that gives d·x of a deviation then.
    ///
    /// With y' = G y in free flight, the saltation of [`Tangent::struck`] adds a g + b G g to the deviation at the impact,
    /// g = (0, response), and so as much of exp(G s) g, the wake, to that of the end of the step: exp(G s) and G commute.
    #[inline(always)]
    #[must_use]
    pub fn struck_ahead(
        &self,
        flight: &Flight<L, N>,
        back: &State<L, N>,
        impact: &FreeSaltation<L, N>,
    ) -> Self {
        let FreeSaltation { velocity, kick, pull, wake } = impact;
        let inverse = velocity.all(1.0) / *velocity;
        // −(1 + r), as it acted.
        let factor = *kick * inverse;
        let there = back.dot(&self.0);
        let along = (-(*pull * inverse)).times_plus(there, back.dot(&rate(flight, &self.0)));
        Tangent(self.0.plus(factor * along, wake).plus(factor * there, &rate(flight, wake)))
    }
}

/// The squares of lengths between which a tangent vector is left to grow or shrink.
pub const SHORT_SQUARE: f64 = 1e-12;
/// See [`SHORT_SQUARE`].
pub const LONG_SQUARE: f64 = 1e12;

impl<L: Lanes, const N: usize> Tangent<L, N> {
    /// The square of the deviation's Euclidean length.
    #[inline(always)]
    pub fn square(&self) -> L {
        self.0.square()
    }

    /// Where it is not far from unit length, `square` being the square of its length, and may be left to grow or shrink.
    #[inline(always)]
    pub fn may_be_left(square: L) -> L::Mask {
        square.all(SHORT_SQUARE).below(square).and(square.below(square.all(LONG_SQUARE)))
    }
}

/// All deviations a time `s` later; see [`Tangent::flown`].
#[inline(always)]
pub(super) fn fly_all<T: Real, const N: usize>(
    tangents: &mut [Tangent<T, N>],
    flight: &Flight<T, N>,
    s: T,
    contact: Contact,
) {
    for tangent in tangents {
        *tangent = tangent.flown(flight, s, contact);
    }
}

/// All deviations once the contacts hold; see [`Tangent::caught`].
#[inline(always)]
pub(crate) fn catch_all<T: Real, const N: usize>(
    tangents: &mut [Tangent<T, N>],
    flight: &Flight<T, N>,
    contact: Contact,
) {
    for tangent in tangents {
        *tangent = tangent.caught(flight, contact);
    }
}

/// All deviations of the end of the step after an impact along a normal, the share `rest` of a whole step before that end.
#[inline(always)]
pub(super) fn strike_all<T: Real, const N: usize>(
    tangents: &mut [Tangent<T, N>],
    flight: &Flight<T, N>,
    normal: usize,
    rest: T,
    impact: &FreeSaltation<T, N>,
) {
    if !tangents.is_empty() {
        let back = flight.normals[normal].look_back(rest);
        for tangent in tangents {
            *tangent = tangent.struck_ahead(flight, &back, impact);
        }
    }
}

/// G y, the derivative of a deviation in free flight.
#[inline(always)]
fn rate<L: Lanes, const N: usize>(flight: &Flight<L, N>, y: &State<L, N>) -> State<L, N> {
    let pulled = applied(&flight.stiffness, &y.x);
    State { x: y.v, v: applied_onto(&flight.damping, &y.v, &pulled) }
}

impl<T: Real, const N: usize> Tangent<T, N> {
    /// The deviation every measurement begins with: all components alike, of unit length.
    pub fn seed() -> Self {
        let each = T::of(1.0 / (2.0 * N as f64).sqrt());
        Tangent(State { x: [each; N], v: [each; N] })
    }

    /// Brings the deviation back to unit length, `square` being the square of its length, and says what it had grown by, ln of a
    /// factor. One that was lost altogether becomes the seed, and has grown by nothing.
    #[inline(never)]
    pub fn bring_back(&mut self, square: T) -> T {
        let length = square.sqrt();
        if length > T::zero() && length.is_finite() {
            *self = self.scaled(T::one() / length);
            length.logarithm()
        } else {
            *self = Tangent::seed();
            T::zero()
        }
    }

    /// Whether nothing is left of it: of no other deviation is anything left then.
    #[inline(always)]
    pub fn is_lost(&self) -> bool {
        let mut lost = true;
        for i in 0..N {
            lost &= self.0.x[i] == T::zero() && self.0.v[i] == T::zero();
        }
        lost
    }

    /// The deviation divided by a number.
    #[inline(always)]
    pub fn scaled(&self, factor: T) -> Self {
        Tangent(self.0.scaled(factor))
    }
}

#[cfg(test)]
mod tests;
