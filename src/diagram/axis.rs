//! The axis of a diagram: one of a plane, in an order of its own.

use std::fmt;
use std::str::FromStr;

use serde::Serialize;

use crate::plane::{Axis, AxisError, Quantity};

/// An axis whose values are visited in rising or in falling order.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(transparent)]
pub struct SweepAxis(Axis);

impl SweepAxis {
    /// A checked axis: `count` equally spaced values from `first` to `last`, both included.
    ///
    /// # Errors
    /// Those of [`Axis::new`].
    pub fn new(quantity: Quantity, first: f64, last: f64, count: u32) -> Result<Self, AxisError> {
        Axis::new(quantity, first, last, count).map(SweepAxis)
    }

    /// The axis itself.
    pub fn axis(&self) -> &Axis {
        &self.0
    }

    /// What is varied.
    pub fn quantity(&self) -> Quantity {
        self.0.quantity
    }

    /// How many values.
    pub fn count(&self) -> u32 {
        self.0.count
    }

    /// The ends, in order of writing.
    pub fn ends(&self) -> [f64; 2] {
        [self.0.first, self.0.last]
    }

    /// The least value.
    pub fn least(&self) -> f64 {
        self.0.least()
    }

    /// The value at index `i`; the ends are exact.
    pub fn value(&self, i: u32) -> f64 {
        self.0.value(i)
    }

    /// All values, in order of writing.
    pub fn values(&self) -> Vec<f64> {
        self.0.values()
    }

    /// The indices in order of falling, or of rising, values.
    pub fn order(&self, falling: bool) -> Vec<u32> {
        let as_written = (self.0.first > self.0.last) == falling;
        let indices = 0..self.0.count;
        if as_written { indices.collect() } else { indices.rev().collect() }
    }
}

impl From<Axis> for SweepAxis {
    fn from(axis: Axis) -> Self {
        SweepAxis(axis)
    }
}

impl fmt::Display for SweepAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for SweepAxis {
    type Err = AxisError;

    /// Reads what [`Axis`] does.
    fn from_str(text: &str) -> Result<Self, AxisError> {
        text.parse().map(SweepAxis)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_run_either_way() {
        let down: SweepAxis = "omega=5:0.2:25".parse().unwrap();
        assert_eq!((down.value(0), down.value(24), down.least()), (5.0, 0.2, 0.2));
        assert_eq!(down.to_string().parse(), Ok(down));
        let up: SweepAxis = "omega=0.2:5:25".parse().unwrap();
        for i in 0..25 {
            assert!((up.value(i) - down.value(24 - i)).abs() < 1e-14);
        }
        assert_eq!((up.order(false)[0], up.order(true)[0]), (0, 24));
        assert_eq!((down.order(false)[0], down.order(true)[0]), (24, 0));
        let log: SweepAxis = "omega=10:0.1:25:log".parse().unwrap();
        assert!((log.value(12) - 1.0).abs() < 1e-12);
        assert_eq!((log.order(false)[0], log.order(true)[0]), (24, 0));
    }

    #[test]
    fn bad_axes_are_named_as_elsewhere() {
        for (text, part) in [
            ("omega", "NAME=FIRST:LAST:COUNT"),
            ("omega=2:1", "NAME=FIRST:LAST:COUNT"),
            ("omgea=2:1:3", "omgea"),
            ("omega=1:1:3", "empty"),
            ("omega=2:1:1", "COUNT of 1"),
            ("omega=2:1:0", "COUNT of 0"),
            ("omega=nan:1:3", "finite"),
        ] {
            let message = text.parse::<SweepAxis>().unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
        assert!(matches!("r=1.5:0.5:3".parse::<SweepAxis>(), Err(AxisError::Parameter(_))));
    }
}
