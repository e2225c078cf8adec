//! The largest Lyapunov exponent, with a standard error.

use crate::dynamics::Tangent;
use crate::model::Real;

/// How many batches an observation is cut into for the standard error.
pub const BATCHES: u32 = 16;
/// The share of the batches, one in so many, that is left out at the beginning while the tangent vector aligns.
pub const ALIGNING: u32 = 4;

/// Accumulates the logarithmic growth of a tangent vector, batch by batch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponent<T> {
    /// Forcing periods in a batch.
    pub batch_periods: u32,
    /// Batches still to be left out.
    aligning: u32,
    /// Periods in the present batch.
    filled: u32,
    /// Growth in the present batch, as far as it was measured.
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

    /// Counts a period, and measures what the tangent vector has grown by where a batch ends, where that is `asked` for, and where it
    /// is far from unit length: it is brought back to that then. Otherwise it is left to grow.
    ///
    /// The growth that was measured, 0 where none was. A vector that was lost altogether (sticking can do that) starts afresh, and
    /// what it had grown by since it was measured last is lost with it.
    #[inline(always)]
    pub fn at_strobe<const N: usize>(&mut self, tangent: &mut Tangent<T, N>, asked: bool) -> T {
        let square = tangent.square();
        let far = !Tangent::<T, N>::may_be_left(square);
        let ends = self.filled + 1 >= self.batch_periods;
        let growth = if far || ends || asked { tangent.bring_back(square) } else { T::zero() };
        self.add(growth);
        growth
    }

    /// For how many periods the tangent vector may be left to grow before a batch ends.
    pub fn periods_left(&self) -> u32 {
        self.batch_periods.saturating_sub(self.filled + 1)
    }

    /// Counts periods in which the tangent vector was left to grow, before the batch ends.
    pub fn pass(&mut self, periods: u32) {
        self.filled += periods;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What is measured of a tangent vector that grows by a factor in every one of 160 periods: the exponent, and how often the vector
    /// was brought back to unit length.
    fn measured<T: Real>(factor: f64, asked: bool) -> (f64, u32) {
        let (mut exponent, mut tangent) = (Exponent::<T>::over(160), Tangent::<T, 2>::seed());
        let mut times = 0;
        for _ in 0..160 {
            tangent = tangent.scaled(T::of(factor));
            exponent.at_strobe(&mut tangent, asked);
            times += u32::from((tangent.square().widen() - 1.0).abs() < 1e-5);
        }
        (exponent.per_period().widen(), times)
    }

    fn grows_by_as_much<T: Real>() {
        // By so much it leaves the bounds in two periods, and what is left to it of ten would not be a number of f32.
        for (factor, times) in [(1e-4, 80), (0.5, 16), (3.0, 16), (1e4, 80)] {
            for (asked, times) in [(false, times), (true, 160)] {
                let (exponent, found) = measured::<T>(factor, asked);
                assert!((exponent - factor.ln()).abs() < 1e-5, "{factor}: {exponent}");
                assert_eq!(found, times, "{factor}");
            }
        }
    }

    #[test]
    fn a_vector_that_is_left_to_grow_within_a_batch_grows_by_as_much() {
        grows_by_as_much::<f64>();
        grows_by_as_much::<f32>();
        let mut tangent = Tangent::<f32, 2>::seed();
        (0..10).for_each(|_| tangent = tangent.scaled(1e4));
        assert!(!tangent.square().is_finite(), "left to grow for all of a batch it would be lost");
    }

    #[test]
    fn a_vector_that_is_lost_starts_afresh() {
        for lost in [0.0, f64::INFINITY, f64::NAN] {
            let (mut exponent, mut tangent) = (Exponent::over(160), Tangent::<f64, 2>::seed().scaled(lost));
            assert_eq!(exponent.at_strobe(&mut tangent, false), 0.0);
            assert_eq!(tangent, Tangent::seed());
        }
    }
}
