//! How the values of an axis are spaced: by equal differences, or by equal ratios.

use serde::{Deserialize, Serialize};

/// How the values of an axis are spaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Spacing {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios; both ends are positive.
    Log,
}

impl Spacing {
    /// The value a share of the way from `first` to `last`; beyond them for shares below 0 and above 1.
    pub fn at(self, first: f64, last: f64, share: f64) -> f64 {
        match self {
            Spacing::Linear => first + share * (last - first),
            Spacing::Log => first * libm::exp(libm::log(last / first) * share),
        }
    }

    /// The share of the way from `first` to `last` at which a value stands: 0 at the first, 1 at the last.
    ///
    /// On a logarithmic scale, −∞ or ∞ for a value of 0 and NaN for one below.
    pub fn share(self, first: f64, last: f64, value: f64) -> f64 {
        match self {
            Spacing::Linear => (value - first) / (last - first),
            Spacing::Log => libm::log(value / first) / libm::log(last / first),
        }
    }

    /// Whether differences are equal.
    pub fn is_linear(&self) -> bool {
        *self == Spacing::Linear
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_and_values_undo_each_other() {
        for spacing in [Spacing::Linear, Spacing::Log] {
            for (first, last) in [(0.1, 10.0), (5.0, 0.2), (1e-9, 1e9)] {
                for share in [-0.1, 0.0, 0.3, 1.0, 1.2] {
                    let value = spacing.at(first, last, share);
                    assert!((spacing.share(first, last, value) - share).abs() < 1e-9, "{spacing:?} {share}");
                }
            }
        }
        assert!((Spacing::Log.at(0.1, 10.0, 0.5) - 1.0).abs() < 1e-12);
        assert!((Spacing::Linear.at(0.1, 10.0, 0.5) - 5.05).abs() < 1e-12);
    }

    #[test]
    fn nothing_below_zero_has_a_place_on_a_logarithmic_scale() {
        assert_eq!(Spacing::Log.share(0.1, 10.0, 0.0), f64::NEG_INFINITY);
        assert!(Spacing::Log.share(0.1, 10.0, -1.0).is_nan());
    }
}
