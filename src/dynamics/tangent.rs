//! Small deviations from the motion, carried through flight and impact.

use super::series::{INVERSE_FACTORIALS, Series, axpy};
use crate::model::{Flight, Real};

/// What is carried along with a trajectory: nothing, a tangent vector, or several of them.
pub trait Variation<T>: Copy {
    /// One whole step h of free flight later.
    #[must_use]
    fn stepped(&self, flight: &Flight<T>) -> Self;

    /// A time `s` ≤ h later, in free flight (`free` = 1) or while the first mass rests (`free` = 0).
    #[must_use]
    fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self;

    /// Just after an impact: the saltation of Eq. (3).
    ///
    /// `velocity` is v1−, `kick` is v1+ − v1−, and `before`/`after` are x1'' on either side.
    #[must_use]
    fn struck(&self, flight: &Flight<T>, velocity: T, kick: T, before: T, after: T) -> Self;

    /// Once the first mass rests on a stop.
    #[must_use]
    fn caught(&self) -> Self;
}

/// A trajectory alone, at no cost.
impl<T> Variation<T> for () {
    #[inline(always)]
    fn stepped(&self, _: &Flight<T>) -> Self {}

    #[inline(always)]
    fn flown(&self, _: &Flight<T>, _: T, _: T) -> Self {}

    #[inline(always)]
    fn struck(&self, _: &Flight<T>, _: T, _: T, _: T, _: T) -> Self {}

    #[inline(always)]
    fn caught(&self) -> Self {}
}

/// Several tangent vectors.
impl<T: Real, const N: usize> Variation<T> for [Tangent<T>; N] {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T>) -> Self {
        self.map(|tangent| tangent.stepped(flight))
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self {
        self.map(|tangent| tangent.flown(flight, s, free))
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T>, velocity: T, kick: T, before: T, after: T) -> Self {
        self.map(|tangent| tangent.struck(flight, velocity, kick, before, after))
    }

    #[inline(always)]
    fn caught(&self) -> Self {
        self.map(|tangent| tangent.caught())
    }
}

/// A tangent vector of the state at fixed time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tangent<T> {
    /// Deviation of x1.
    pub x1: T,
    /// Deviation of x2.
    pub x2: T,
    /// Deviation of v1.
    pub v1: T,
    /// Deviation of v2.
    pub v2: T,
}

impl<T: Real> Variation<T> for Tangent<T> {
    /// The deviation one whole step h of free flight later.
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T>) -> Self {
        let [c0, c1, c2, c3] = &flight.phi;
        let row = |i: usize| (c0[i] * self.x1 + c1[i] * self.x2) + (c2[i] * self.v1 + c3[i] * self.v2);
        Tangent { x1: row(0), x2: row(1), v1: row(2), v2: row(3) }
    }

    /// The deviation a time `s` ≤ h later; see [`Point::flown`](super::Point::flown).
    #[inline(always)]
    fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self {
        let series = Series::new(flight, s, free);
        let mut before = [self.v1, self.v2];
        let mut last = series.first(flight, [self.x1, self.x2], before);
        let mut velocity = before;
        let mut mean = before;
        let mut power = T::one();
        for k in 1..=T::ORDER {
            velocity = axpy(T::of(INVERSE_FACTORIALS[k]), last, velocity);
            mean = axpy(T::of(INVERSE_FACTORIALS[k + 1]), last, mean);
            let negligible;
            (power, negligible) = series.grow(power, k);
            if negligible {
                break;
            }
            (before, last) = (last, series.next(before, last, [T::zero(); 2]));
        }
        Tangent { x1: self.x1 + mean[0] * s, x2: self.x2 + mean[1] * s, v1: velocity[0], v2: velocity[1] }
    }

    /// The deviation just after an impact: the saltation of Eq. (3).
    ///
    /// A deviation δx1 shifts the impact by −δx1/v1−; what differs on either side of it (v1, x1'' and, through
    /// the damper, x2'') acts for that long.
    #[inline(always)]
    fn struck(&self, flight: &Flight<T>, velocity: T, kick: T, before: T, after: T) -> Self {
        let shift = self.x1 / velocity;
        let damper = flight.inverse_mass * flight.coupling_damping * kick;
        Tangent {
            x1: -(flight.r * self.x1),
            x2: self.x2,
            v1: (flight.r * before + after) * shift - flight.r * self.v1,
            v2: self.v2 + damper * shift,
        }
    }

    /// The deviation once the first mass rests on a stop: what it had of its own is lost.
    #[inline(always)]
    fn caught(&self) -> Self {
        Tangent { x1: T::zero(), v1: T::zero(), ..*self }
    }
}

impl<T: Real> Tangent<T> {
    /// The deviation every measurement begins with: all four components alike, of unit length.
    pub fn seed() -> Self {
        let half = T::of(0.5);
        Tangent { x1: half, x2: half, v1: half, v2: half }
    }

    /// The deviation's Euclidean length.
    #[inline(always)]
    pub fn length(&self) -> T {
        ((self.x1 * self.x1 + self.x2 * self.x2) + (self.v1 * self.v1 + self.v2 * self.v2)).sqrt()
    }

    /// The deviation divided by a number.
    #[inline(always)]
    pub fn scaled(&self, factor: T) -> Self {
        Tangent { x1: self.x1 * factor, x2: self.x2 * factor, v1: self.v1 * factor, v2: self.v2 * factor }
    }
}
