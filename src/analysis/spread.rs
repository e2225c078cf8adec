//! Is the motion stationary? The spread of its strobe points, early against late.

use crate::dynamics::Point;
use crate::model::Real;

/// First and second moments of the second mass's strobe points, about a reference point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moments<T> {
    x2: T,
    v2: T,
    square: T,
}

/// Compares how far the strobe points scatter in the first and the second half of an observation.
///
/// On a quasi-periodic motion the two agree; on one that still spirals in or out they do not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<T> {
    x2: T,
    v2: T,
    early: Moments<T>,
    late: Moments<T>,
}

/// The largest ratio of the later to the earlier variance, or its inverse, of a stationary motion.
pub const STATIONARY: f64 = 1.25;

impl<T: Real> Spread<T> {
    /// Begins at a strobe point.
    pub fn about<D>(point: &Point<T, D>) -> Self {
        let none = Moments { x2: T::zero(), v2: T::zero(), square: T::zero() };
        Spread { x2: point.x2, v2: point.v2, early: none, late: none }
    }

    /// Adds a strobe point to the earlier or the later half.
    #[inline(always)]
    pub fn at_strobe<D>(&mut self, point: &Point<T, D>, late: bool) {
        let x2 = point.x2 - self.x2;
        let v2 = point.v2 - self.v2;
        let moments = if late { &mut self.late } else { &mut self.early };
        moments.x2 = moments.x2 + x2;
        moments.v2 = moments.v2 + v2;
        moments.square = moments.square + (x2 * x2 + v2 * v2);
    }

    /// Whether the two halves, of `half` points each, scatter alike.
    pub fn is_stationary(&self, half: u32) -> bool {
        let count = T::of(f64::from(half));
        let early = self.early.variance(count);
        let late = self.late.variance(count);
        let ratio = T::of(STATIONARY);
        early <= ratio * late && late <= ratio * early
    }
}

impl<T: Real> Moments<T> {
    fn variance(&self, count: T) -> T {
        let x2 = self.x2 / count;
        let v2 = self.v2 / count;
        self.square / count - (x2 * x2 + v2 * v2)
    }
}
