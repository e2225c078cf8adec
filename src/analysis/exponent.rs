//! The largest Lyapunov exponent, with a standard error.

use crate::dynamics::Tangent;
use crate::model::Real;

/// How many batches an observation is cut into for the standard error.
pub const BATCHES: u32 = 16;
/// The share of the batches, one in so many, that is left out at the beginning while the tangent vector aligns.
pub const ALIGNING: u32 = 4;

/// Accumulates the logarithmic growth of a tangent vector, strobe by strobe.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent<T> {
    /// Forcing periods in a batch.
    pub batch_periods: u32,
    /// Batches still to be left out.
    aligning: u32,
    /// Periods in the present batch.
    filled: u32,
    /// Growth in the present batch.
    growth: T,
    /// Batches counted.
    pub batches: u32,
    /// Sum of their growths.
    sum: T,
    /// Sum of the squares of their growths.
    squares: T,
}

impl<T: Real> Exponent<T> {
    /// For an observation of so many forcing periods.
    pub fn over(observe: u32) -> Self {
        let batches = if observe < BATCHES { observe } else { BATCHES };
        Exponent {
            batch_periods: observe / batches,
            aligning: batches / ALIGNING,
            filled: 0,
            growth: T::zero(),
            batches: 0,
            sum: T::zero(),
            squares: T::zero(),
        }
    }

    /// Adds the growth since the last strobe, brings the tangent vector back to unit length and returns that growth.
    ///
    /// A vector that was lost altogether (sticking can do that) starts afresh.
    #[inline(always)]
    pub fn at_strobe<const N: usize>(&mut self, tangent: &mut Tangent<T, N>) -> T {
        let length = tangent.length();
        let growth = if length > T::zero() && length.is_finite() {
            *tangent = tangent.scaled(T::one() / length);
            length.logarithm()
        } else {
            *tangent = Tangent::seed();
            T::zero()
        };
        self.add(growth);
        growth
    }

    /// Adds the growth of one period (or iterate), ln of a factor.
    #[inline(always)]
    pub fn add(&mut self, growth: T) {
        self.growth = self.growth + growth;
        self.filled += 1;
        if self.filled < self.batch_periods {
            return;
        }
        if self.aligning > 0 {
            self.aligning -= 1;
        } else {
            self.batches += 1;
            self.sum = self.sum + self.growth;
            self.squares = self.squares + self.growth * self.growth;
        }
        self.filled = 0;
        self.growth = T::zero();
    }

    /// The exponent per forcing period.
    pub fn per_period(&self) -> T {
        self.sum / T::of(f64::from(self.batches * self.batch_periods))
    }

    /// Its standard error per forcing period, from the scatter of the batches.
    pub fn standard_error(&self) -> T {
        let count = T::of(f64::from(self.batches));
        let mean = self.sum / count;
        let variance = self.squares / count - mean * mean;
        let variance = if variance > T::zero() { variance } else { T::zero() };
        (variance / count).sqrt() / T::of(f64::from(self.batch_periods))
    }

    /// The growth of the tangent vector over everything counted, ln of a factor.
    pub fn total_growth(&self) -> T {
        self.sum
    }
}
