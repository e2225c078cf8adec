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
    /// The value at index `i`; the ends are exact, and so is 0 where it is one of equal steps.
    pub fn value(&self, i: u32) -> f64 {
        match self.spacing {
            _ if i == 0 => self.first,
            _ if i + 1 == self.count => self.last,
            Spacing::Linear => {
                let value = self.first + (self.last - self.first) * f64::from(i) / f64::from(self.count - 1);
                // What is left of it by rounding alone is nothing.
                let rounding = 4.0 * f64::EPSILON * self.first.abs().max(self.last.abs());
                if value.abs() <= rounding { 0.0 } else { value }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_and_zero_are_exact() {
        let steps = |first, last, count| Steps { first, last, count, spacing: Spacing::Linear };
        for (first, last, count, zero) in
            [(-0.1, 0.5, 7, 1), (-0.3, 0.4, 8, 3), (0.9, -0.3, 13, 9), (-1e-9, 2e-9, 4, 1)]
        {
            let values = steps(first, last, count).values();
            assert_eq!((values[0], values[zero], *values.last().unwrap()), (first, 0.0, last));
            assert!(values.iter().enumerate().all(|(i, value)| (*value == 0.0) == (i == zero)), "{values:?}");
        }
        // Unrounded it would be something else.
        assert_ne!(-0.1 + (0.5 + 0.1) / 6.0, 0.0);
        assert_eq!(steps(1e-18, 1.0, 2).value(0), 1e-18, "an end is what was given");
    }
}
