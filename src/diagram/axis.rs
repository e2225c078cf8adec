//! The axis of a diagram, which may run downwards.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::plane::{Axis, AxisError, Quantity};

/// An axis whose first value may be greater than its last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SweepAxis(Axis);

impl SweepAxis {
    /// A checked axis: `count` equally spaced values from `first` to `last`, both included.
    ///
    /// # Errors
    /// Those of [`Axis::new`], except that the values may decrease.
    pub fn new(quantity: Quantity, first: f64, last: f64, count: u32) -> Result<Self, AxisError> {
        let axis = Axis::new(quantity, first.min(last), first.max(last), count)?;
        Ok(SweepAxis(Axis { first, last, ..axis }))
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
        self.0.first.min(self.0.last)
    }

    /// The value at index `i`; the ends are exact.
    pub fn value(&self, i: u32) -> f64 {
        self.0.value(i)
    }

    /// All values, in order of writing.
    pub fn values(&self) -> Vec<f64> {
        self.0.values()
    }

    /// The distance from one value to the next.
    pub fn step(&self) -> f64 {
        (self.0.last - self.0.first).abs() / f64::from(self.0.count.max(2) - 1)
    }

    /// The indices in order of falling, or of rising, values.
    pub fn order(&self, falling: bool) -> Vec<u32> {
        let as_written = (self.0.first > self.0.last) == falling;
        let indices = 0..self.0.count;
        if as_written { indices.collect() } else { indices.rev().collect() }
    }
}

impl fmt::Display for SweepAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl FromStr for SweepAxis {
    type Err = AxisError;

    /// Reads `NAME=FIRST:LAST:COUNT`.
    fn from_str(text: &str) -> Result<Self, AxisError> {
        let Some((name, range)) = text.split_once('=') else { return text.parse().map(SweepAxis) };
        let parts: Vec<&str> = range.split(':').collect();
        let [first, last, count] = parts[..] else { return text.parse().map(SweepAxis) };
        let falling =
            matches!((first.trim().parse::<f64>(), last.trim().parse::<f64>()), (Ok(a), Ok(b)) if a > b);
        if !falling {
            return text.parse().map(SweepAxis);
        }
        let Axis { quantity, first, last, count } = format!("{name}={last}:{first}:{count}").parse()?;
        Ok(SweepAxis(Axis { quantity, first: last, last: first, count }))
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
