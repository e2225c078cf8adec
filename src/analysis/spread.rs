//! Whether the motion is stationary: the spread of its strobe points early in the observation against that late in it.

use crate::dynamics::{Moments, Scattering};
use crate::model::{Real, State};

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
        let none = Moments::none(T::zero());
        Spread { about: *point, early: none, late: none }
    }

    /// Adds a strobe point to the earlier or the later half.
    #[inline(always)]
    pub fn at_strobe(&mut self, point: &State<T, N>, late: bool) {
        let about = self.about;
        self.half(late).add(true, point, &about);
    }

    /// What the earlier or the later half scatters by so far.
    pub fn scattering(&self, late: bool) -> Scattering<T, N> {
        Scattering { about: self.about, moments: if late { self.late } else { self.early } }
    }

    /// Goes on from what the earlier or the later half scatters by.
    pub fn go_on(&mut self, late: bool, moments: Moments<T, N>) {
        *self.half(late) = moments;
    }

    #[inline(always)]
    fn half(&mut self, late: bool) -> &mut Moments<T, N> {
        if late { &mut self.late } else { &mut self.early }
    }

    /// Whether the two halves, of `half` points each, scatter alike.
    pub fn is_stationary(&self, half: u32) -> bool {
        let count = T::of(f64::from(half));
        let [early, late] = [&self.early, &self.late].map(|moments| variance(moments, count));
        let ratio = T::of(STATIONARY);
        early <= ratio * late && late <= ratio * early
    }
}

fn variance<T: Real, const N: usize>(moments: &Moments<T, N>, count: T) -> T {
    moments.square / count - moments.sum.map(|value| value / count).square()
}
