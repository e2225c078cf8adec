//! The settings of each method, and the ranges they must lie in.

use serde::{Deserialize, Serialize};

use super::error::ControlError;
use super::quantity::ControlQuantity;
use super::target::Target;
use crate::control::memory::LONGEST_DELAY;
use crate::control::sine::Convention;
use crate::control::values::SectionValues;
use crate::dynamics::Stop;

/// Settings of the adapted sine force; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SineSetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// What u = B sin(γωt + φ) is.
    pub convention: Convention,
    /// The coordinate that a force acts on, from 0.
    #[serde(default)]
    pub coordinate: usize,
    /// B before the first adaptation.
    pub amplitude: f64,
    /// α, 0 ≤ α ≤ 1; with 0 the amplitude stays as it is.
    pub alpha: f64,
    /// Δ ≥ 0.
    pub dead_band: f64,
    /// γ > 0.
    pub gamma: f64,
    /// φ.
    pub phase: f64,
    /// Which component of X is held to that of the target, in the order of
    /// [`section_names`](crate::control::section_names): 0 to 3 for the paper's v1+, x2, v2, τ.
    pub component: usize,
    /// The target.
    pub target: Target,
}

/// Settings of the period pulse; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PulseSetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// P ≥ 1, iterates from one pulse to the next.
    pub period: u32,
    /// X0.
    pub target: Target,
    /// E ≥ 0, the largest error of a measured component.
    pub noise: f64,
    /// What the errors are drawn from.
    pub seed: u32,
}

/// Settings of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DelaySetting {
    /// The stop on whose section it acts.
    #[serde(default)]
    pub stop: Stop,
    /// The diagonal of G, each between 0 and 1: one for each component of X.
    pub gains: SectionValues<f64>,
    /// p, iterates, 1 to [`LONGEST_DELAY`](crate::control::LONGEST_DELAY).
    pub delay: u32,
    /// The sign of the feedback.
    pub sign: Sign,
}

/// The sign of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, strum::IntoStaticStr)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
#[strum(serialize_all = "lowercase")]
pub enum Sign {
    /// X(n+1) = F(X(n)) + G (X(n) − X(n−p)), which stabilises.
    Stabilising,
    /// X(n+1) = F(X(n)) + G (X(n−p) − X(n)), as Eq. (30) is printed.
    Printed,
}

impl SineSetting {
    pub(super) fn check(&self) -> Result<(), ControlError> {
        let ranges = [
            (ControlQuantity::Amplitude, self.amplitude, self.amplitude.is_finite(), "a finite number"),
            (ControlQuantity::Alpha, self.alpha, (0.0..=1.0).contains(&self.alpha), "between 0 and 1"),
            (
                ControlQuantity::DeadBand,
                self.dead_band,
                self.dead_band >= 0.0 && self.dead_band.is_finite(),
                "0 or greater",
            ),
            (
                ControlQuantity::Gamma,
                self.gamma,
                self.gamma > 0.0 && self.gamma <= Self::FASTEST,
                "greater than 0, and at most 100",
            ),
            (ControlQuantity::Phase, self.phase, self.phase.is_finite(), "a finite number"),
        ];
        check_ranges(&ranges)?;
        self.target.check()
    }

    /// The largest γ.
    pub const FASTEST: f64 = 100.0;
}

impl PulseSetting {
    pub(super) fn check(&self) -> Result<(), ControlError> {
        let (period, noise) = (f64::from(self.period), self.noise);
        check_ranges(&[
            (ControlQuantity::Period, period, self.period > 0, "1 or greater"),
            (ControlQuantity::Noise, noise, noise >= 0.0 && noise.is_finite(), "0 or greater"),
        ])?;
        self.target.check()
    }
}

impl DelaySetting {
    pub(super) fn check(&self) -> Result<(), ControlError> {
        let gain = |g: f64| (ControlQuantity::Gain, g, (0.0..=1.0).contains(&g), GAIN_RANGE);
        let whole = (1..=LONGEST_DELAY as u32).contains(&self.delay);
        check_ranges(&self.gains.iter().map(|&g| gain(g)).collect::<Vec<_>>())?;
        check_ranges(&[(ControlQuantity::Delay, f64::from(self.delay), whole, "a whole number from 1 to 8")])
    }
}

/// Each multiplier λ of F gives μ² − (λ + g) μ + g = 0, whose roots have the product g.
const GAIN_RANGE: &str =
    "between 0 and 1: a larger gain makes every motion unstable (for the other sign see --sign)";

type Range = (ControlQuantity, f64, bool, &'static str);

fn check_ranges(ranges: &[Range]) -> Result<(), ControlError> {
    match ranges.iter().find(|(_, _, admitted, _)| !admitted) {
        Some(&(quantity, value, _, range)) => {
            Err(ControlError::OutOfRange { name: quantity.name(), value, range })
        }
        None => Ok(()),
    }
}
