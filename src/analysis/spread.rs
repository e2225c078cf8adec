//! Whether the motion is stationary: the spread of its strobe points early in the observation against that late in it.

use crate::model::{Real, State};

/// First and second moments of the strobe points, about a reference point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Moments<T, const N: usize> {
    sum: State<T, N>,
    square: T,
}

/// Compares how far the strobe points scatter in the first and the second half of an observation.
///
/// On a quasi-periodic motion the two agree; on one that still spirals in or out they do not.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread<T, const N: usize> {
    about: State<T, N>,
    early: Moments<T, N>,
    late: Moments<T, N>,
}

/// The largest ratio of the later to the earlier variance, or its inverse, of a stationary motion.
pub const STATIONARY: f64 = 1.25;

impl<T: Real, const N: usize> Spread<T, N> {
    /// Begins at a strobe point.
    pub fn about(point: &State<T, N>) -> Self {
        let none = Moments { sum: State::zero(), square: T::zero() };
        Spread { about: *point, early: none, late: none }
    }

    /// Adds a strobe point to the earlier or the later half.
    #[inline(always)]
    pub fn at_strobe(&mut self, point: &State<T, N>, late: bool) {
        let away = point.plus(-T::one(), &self.about);
        let moments = if late { &mut self.late } else { &mut self.early };
        moments.sum = moments.sum.added(&away);
        moments.square = moments.square + away.square();
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

impl<T: Real, const N: usize> Moments<T, N> {
    fn variance(&self, count: T) -> T {
        self.square / count - self.sum.map(|value| value / count).square()
    }
}
