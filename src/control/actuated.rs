//! What a controller can set on a trajectory: a force on the first mass, and how a deviation flies under it.

use crate::dynamics::{Contact, Drive, Phasor, Point, Saltation, Tangent, Variation};
use crate::model::{Flight, Real};

/// A drive that a controller can set.
pub trait Actuated<T: Real>: Drive<T, 2> {
    /// A deviation of the trajectory, and of this drive with it.
    type Deviation: Variation<T, 2> + std::fmt::Debug + PartialEq;

    /// The drive with amplitude `b` and the given sine and cosine of its phase.
    #[must_use]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self;

    /// The deviation at fixed time of a trajectory whose drive is behind in phase by `lag` times a small number.
    fn deviating(&self, tangent: Tangent<T, 2>, lag: T) -> Self::Deviation;

    /// The deviation of the trajectory alone.
    fn tangent(deviation: &Self::Deviation) -> Tangent<T, 2>;
}

/// Nothing to set: methods that change the section point only.
impl<T: Real> Actuated<T> for () {
    type Deviation = Tangent<T, 2>;

    #[inline(always)]
    fn actuated(&self, _: T, _: [T; 2]) -> Self {}

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T, 2>, _: T) -> Tangent<T, 2> {
        tangent
    }

    #[inline(always)]
    fn tangent(deviation: &Tangent<T, 2>) -> Tangent<T, 2> {
        *deviation
    }
}

impl<'a, T: Real> Actuated<T> for Phasor<'a, T, 2> {
    type Deviation = Lagging<'a, T>;

    #[inline(always)]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self {
        Phasor::new(self.constants, b, phase)
    }

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T, 2>, lag: T) -> Lagging<'a, T> {
        let drive = Phasor { sin: -(self.cos * lag), cos: self.sin * lag, ..*self };
        Lagging::new(tangent, drive)
    }

    #[inline(always)]
    fn tangent(deviation: &Lagging<'a, T>) -> Tangent<T, 2> {
        deviation.tangent()
    }
}

/// A tangent vector with the deviation of the force on the first mass: flight is linear, so together they fly as a
/// point does that no forcing drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lagging<'a, T> {
    point: Point<T, 2, Phasor<'a, T, 2>>,
}

impl<'a, T: Real> Lagging<'a, T> {
    fn new(Tangent(state): Tangent<T, 2>, drive: Phasor<'a, T, 2>) -> Self {
        let none = T::zero();
        Lagging { point: Point { state, sin: none, cos: none, one: none, drive } }
    }

    fn tangent(&self) -> Tangent<T, 2> {
        Tangent(self.point.state)
    }
}

impl<T: Real> Variation<T, 2> for Lagging<'_, T> {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T, 2>) -> Self {
        Lagging { point: self.point.stepped(flight) }
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T, 2>, s: T, contact: Contact) -> Self {
        Lagging { point: self.point.flown(flight, s, contact) }
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T, 2>, impact: &Saltation<T, 2>) -> Self {
        Lagging::new(self.tangent().struck(flight, impact), self.point.drive)
    }

    #[inline(always)]
    fn caught(&self, flight: &Flight<T, 2>, contact: Contact) -> Self {
        Lagging::new(self.tangent().caught(flight, contact), self.point.drive)
    }
}
