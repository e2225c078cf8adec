//! What a controller can set on a trajectory: a force on the first mass, and how a deviation flies under it.

use crate::dynamics::{Drive, Phasor, Point, Tangent, Variation};
use crate::model::{Flight, Real};

/// A drive that a controller can set.
pub trait Actuated<T: Real>: Drive<T> {
    /// A deviation of the trajectory, and of this drive with it.
    type Deviation: Variation<T> + std::fmt::Debug + PartialEq;

    /// The drive with amplitude `b` and the given sine and cosine of its phase.
    #[must_use]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self;

    /// The deviation at fixed time of a trajectory whose drive is behind in phase by `lag` times a small number.
    fn deviating(&self, tangent: Tangent<T>, lag: T) -> Self::Deviation;

    /// The deviation of the trajectory alone.
    fn tangent(deviation: &Self::Deviation) -> Tangent<T>;
}

/// Nothing to set: methods that change the section point only.
impl<T: Real> Actuated<T> for () {
    type Deviation = Tangent<T>;

    #[inline(always)]
    fn actuated(&self, _: T, _: [T; 2]) -> Self {}

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T>, _: T) -> Tangent<T> {
        tangent
    }

    #[inline(always)]
    fn tangent(deviation: &Tangent<T>) -> Tangent<T> {
        *deviation
    }
}

impl<'a, T: Real> Actuated<T> for Phasor<'a, T> {
    type Deviation = Lagging<'a, T>;

    #[inline(always)]
    fn actuated(&self, b: T, phase: [T; 2]) -> Self {
        Phasor::new(self.constants, b, phase)
    }

    #[inline(always)]
    fn deviating(&self, tangent: Tangent<T>, lag: T) -> Lagging<'a, T> {
        let drive = Phasor { sin: -(self.cos * lag), cos: self.sin * lag, ..*self };
        Lagging::new(tangent, drive)
    }

    #[inline(always)]
    fn tangent(deviation: &Lagging<'a, T>) -> Tangent<T> {
        deviation.tangent()
    }
}

/// A tangent vector with the deviation of the force on the first mass: flight is linear, so together they fly as a
/// point does that no forcing drives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lagging<'a, T> {
    point: Point<T, Phasor<'a, T>>,
}

impl<'a, T: Real> Lagging<'a, T> {
    fn new(Tangent { x1, x2, v1, v2 }: Tangent<T>, drive: Phasor<'a, T>) -> Self {
        Lagging { point: Point { x1, x2, v1, v2, sin: T::zero(), cos: T::zero(), drive } }
    }

    fn tangent(&self) -> Tangent<T> {
        let [x1, x2, v1, v2] = self.point.state();
        Tangent { x1, x2, v1, v2 }
    }
}

impl<T: Real> Variation<T> for Lagging<'_, T> {
    #[inline(always)]
    fn stepped(&self, flight: &Flight<T>) -> Self {
        Lagging { point: self.point.stepped(flight) }
    }

    #[inline(always)]
    fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self {
        Lagging { point: self.point.flown(flight, s, free) }
    }

    #[inline(always)]
    fn struck(&self, flight: &Flight<T>, velocity: T, kick: T, before: T, after: T) -> Self {
        Lagging::new(self.tangent().struck(flight, velocity, kick, before, after), self.point.drive)
    }

    #[inline(always)]
    fn caught(&self) -> Self {
        Lagging::new(self.tangent().caught(), self.point.drive)
    }
}
