//! What a controller can set on a trajectory: a force on one coordinate, and how a deviation flies under it.

use crate::dynamics::{Contact, Drive, Phasor, Point, Saltation, Tangent, Variation};
use crate::model::{Flight, Real};

/// A drive that a controller can set.
pub trait Actuated<T: Real, const N: usize>: Drive<T, N> {
    /// A deviation of the trajectory, and of this drive with it.
    type Deviation: Variation<T, N> + std::fmt::Debug + PartialEq;

    /// The drive with amplitude `b` and the given sine and cosine of its phase.
    #[must_use]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self;

    /// The deviation at fixed time of a trajectory whose drive is behind in phase by `lag` times a small number.
    fn deviating(&self, tangent: Tangent<T, N>, lag: T) -> Self::Deviation;

    /// The deviation of the trajectory alone.
    fn tangent(deviation: &Self::Deviation) -> Tangent<T, N>;
}

/// Nothing to set: methods that change the section point only.
impl<T: Real, const N: usize> Actuated<T, N> for () {
    type Deviation = Tangent<T, N>;

    #[inline(always)]
    fn actuated(&self, _: T, _: [T; 2]) -> Self {}

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T, N>, _: T) -> Tangent<T, N> {
        tangent
    }

    #[inline(always)]
    fn tangent(deviation: &Tangent<T, N>) -> Tangent<T, N> {
        *deviation
    }
}

impl<'a, T: Real, const N: usize> Actuated<T, N> for Phasor<'a, T, N> {
    type Deviation = Lagging<'a, T, N>;

    #[inline(always)]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self {
        Phasor::new(self.constants, b, phase)
    }

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T, N>, lag: T) -> Lagging<'a, T, N> {
        let drive = Phasor { sin: -(self.cos * lag), cos: self.sin * lag, ..*self };
        Lagging::new(tangent, drive)
    }

    #[inline(always)]
    fn tangent(deviation: &Lagging<'a, T, N>) -> Tangent<T, N> {
        deviation.tangent()
    }
}

/// A tangent vector with the deviation of the force: flight is linear, so together they fly as a
/// point does that no forcing drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lagging<'a, T, const N: usize> {
    point: Point<T, N, Phasor<'a, T, N>>,
}

impl<'a, T: Real, const N: usize> Lagging<'a, T, N> {
    fn new(Tangent(state): Tangent<T, N>, drive: Phasor<'a, T, N>) -> Self {
        let none = T::zero();
        Lagging { point: Point { state, sin: none, cos: none, one: none, drive } }
    }

    fn tangent(&self) -> Tangent<T, N> {
        Tangent(self.point.state)
    }
}

impl<T: Real, const N: usize> Variation<T, N> for Lagging<'_, T, N> {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, N>) -> Self {
        Lagging { point: self.point.stepped(flight) }
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        Lagging { point: self.point.flown(flight, s, contact) }
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T, N>, impact: &Saltation<T, N>) -> Self {
        Lagging::new(self.tangent().struck(flight, impact), self.point.drive)
    }

    #[inline(always)]
    fn caught(&self, flight: &Flight<T, N>, contact: Contact) -> Self {
        Lagging::new(self.tangent().caught(flight, contact), self.point.drive)
    }
}
