//! The regime of a motion that impacts, from what was observed of it.

use super::exponent::Exponent;
use super::regime::Regime;
use super::spread::Spread;
use crate::model::Real;

/// Total logarithmic growth below which a tangent vector neither grows nor shrinks: the exponent is zero.
pub const NEUTRAL_GROWTH: f64 = 3.0;
/// Total logarithmic growth above which the exponent can be positive.
pub const CHAOTIC_GROWTH: f64 = 5.0;
/// Total logarithmic growth above which chaos is plain after half an observation, of which half is left for the tangent vector to
/// align.
pub const PLAIN_GROWTH: f64 = 10.0;
/// Standard errors by which a positive exponent must exceed zero.
pub const SIGNIFICANCE: f64 = 3.0;

/// What was observed of a motion that impacts, strobe by strobe or from return to return on a section.
#[derive(Clone, Copy, Debug)]
pub struct Evidence<'a, T, const N: usize> {
    /// Whether its points keep returning.
    pub returns: bool,
    /// Whether what returns is a motion that was reached.
    pub settled: bool,
    /// Whether a mass rested on a stop.
    pub sticks: bool,
    /// The growth of a tangent vector; none where it was lost.
    pub exponent: Option<&'a Exponent<T>>,
    /// How its points are spread, early and late.
    pub spread: &'a Spread<T, N>,
    /// The points in either half of the observation.
    pub half: u32,
}

impl<T: Real, const N: usize> Evidence<'_, T, N> {
    /// The regime: periodic where it returns and has settled, aperiodic with sticking where it sticks and does not return, and
    /// otherwise what the growth of a tangent vector says.
    pub fn regime(&self) -> Regime {
        if self.returns && self.settled {
            return if self.sticks { Regime::PeriodicSticking } else { Regime::Periodic };
        }
        if self.sticks && !self.returns {
            return Regime::AperiodicSticking;
        }
        let Some(exponent) = self.exponent.filter(|exponent| exponent.batches > 0) else {
            return Regime::Unresolved;
        };
        if grows(exponent, CHAOTIC_GROWTH) && !self.sticks {
            Regime::Chaotic
        } else if !self.returns
            && exponent.total_growth().abs() < T::of(NEUTRAL_GROWTH)
            && self.spread.is_stationary(self.half)
        {
            Regime::QuasiPeriodic
        } else {
            Regime::Unresolved
        }
    }
}

/// Whether a tangent vector grows, by more than that in all and by more than may be chance.
pub(super) fn grows<T: Real>(exponent: &Exponent<T>, least: f64) -> bool {
    let significant = exponent.per_period() > T::of(SIGNIFICANCE) * exponent.standard_error();
    exponent.total_growth() > T::of(least) && significant
}
