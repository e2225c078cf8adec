//! Values in equal steps or at equal ratios.

use serde::{Deserialize, Serialize};

use super::spacing::Spacing;

/// `count` values from `first` to `last`, both included; they may rise or fall.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Steps {
    /// The first value.
    pub first: f64,
    /// The last value; another than the first, or equal to it where there is but one.
    pub last: f64,
    /// How many values.
    pub count: u32,
    /// How they are spaced.
    #[serde(default, skip_serializing_if = "Spacing::is_linear")]
    pub spacing: Spacing,
}

impl Steps {
    /// The value at index `i`; the ends are exact.
    pub fn value(&self, i: u32) -> f64 {
        if i + 1 == self.count {
            return self.last;
        }
        match self.spacing {
            Spacing::Linear => {
                self.first + (self.last - self.first) * f64::from(i) / f64::from(self.count - 1)
            }
            Spacing::Log => self.at(f64::from(i)),
        }
    }

    /// The value at a place counted in values from the first one; it may lie between two of them, or beyond the ends.
    pub fn at(&self, place: f64) -> f64 {
        self.spacing.at(self.first, self.last, place / f64::from(self.count.max(2) - 1))
    }

    /// Where a value stands, counted in values from the first one.
    pub fn place(&self, value: f64) -> f64 {
        self.share(value) * f64::from(self.count.saturating_sub(1))
    }

    /// The share of the way from the first to the last value at which a value stands.
    pub fn share(&self, value: f64) -> f64 {
        self.spacing.share(self.first, self.last, value)
    }

    /// All values, in order.
    pub fn values(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.value(i)).collect()
    }
}
