//! Axes: a quantity in equal steps or at equal ratios.

use std::fmt;
use std::str::FromStr;

use derive_more::Deref;
use serde::Serialize;

use super::axis_error::{AxisError, MOST_VALUES};
use super::quantity::Quantity;
use crate::control::ControlQuantity;
use crate::figure::{Spacing, Steps};
use crate::model::{Number, whole};
use crate::system::Family;

/// An axis of a plane: what is varied, in some steps.
#[derive(Clone, Copy, Debug, PartialEq, Deref, Serialize)]
pub struct Axis {
    /// What is varied.
    pub quantity: Quantity,
    /// Its values.
    #[deref]
    #[serde(flatten)]
    pub steps: Steps,
}

impl Axis {
    /// The most values an axis may have.
    pub const LARGEST: u32 = MOST_VALUES;

    /// A checked axis of equal steps; see [`Axis::spaced`].
    ///
    /// # Errors
    /// Those of [`Axis::spaced`].
    pub fn new(quantity: Quantity, first: f64, last: f64, count: u32) -> Result<Self, AxisError> {
        Axis::spaced(quantity, first, last, count, Spacing::Linear)
    }

    /// A checked axis.
    ///
    /// # Errors
    /// Ends that are not finite, or too far apart for their difference to be, or on a logarithmic axis not positive or without a
    /// ratio; equal ends for several values, one value for two different ends, a count outside 1 to [`Axis::LARGEST`], and ends
    /// outside the physical range of a parameter.
    pub fn spaced(
        quantity: Quantity,
        first: f64,
        last: f64,
        count: u32,
        spacing: Spacing,
    ) -> Result<Self, AxisError> {
        let name = quantity.name();
        let ends = |problem| {
            let axis = format!("{name}={}:{}", Number(first), Number(last));
            Err(AxisError::Ends { axis, problem })
        };
        if !first.is_finite() || !last.is_finite() {
            return ends("has an end that is not a finite number");
        }
        if !(1..=Self::LARGEST).contains(&count) {
            return Err(AxisError::Count { name, count: u64::from(count) });
        }
        if !(last - first).is_finite() {
            return ends("has ends that are too far apart for numbers in between: bring them closer");
        }
        if first == last && count > 1 {
            return ends("is empty: give two different ends, or a COUNT of 1");
        }
        if first != last && count == 1 {
            return ends("has two ends but a COUNT of 1: give 2 or more, or equal ends");
        }
        if spacing == Spacing::Log && first.min(last) <= 0.0 {
            return ends("cannot be logarithmic: give two ends above 0, or drop :log");
        }
        if spacing == Spacing::Log && !(last / first).is_normal() {
            return ends("has ends whose ratio is no number: bring them closer");
        }
        if let Quantity::Parameter(parameter) = quantity {
            parameter.check(first)?;
            parameter.check(last)?;
        }
        let axis = Axis { quantity, steps: Steps { first, last, count, spacing } };
        let whole = axis.control().is_some_and(|setting| setting.is_whole);
        if whole && axis.values().iter().any(|value| value.fract() != 0.0 || *value < 0.0) {
            let axis = format!("{name}={}:{}:{count}", Number(first), Number(last));
            let problem = "has values that are not whole numbers: choose a COUNT so that all are";
            return Err(AxisError::Ends { axis, problem });
        }
        Ok(axis)
    }

    /// Checks that it is what [`Axis::spaced`] makes, of a quantity that systems of a family have.
    ///
    /// # Errors
    /// [`AxisError::Foreign`], and those of [`Axis::spaced`].
    pub fn check(&self, family: &Family) -> Result<(), AxisError> {
        if !self.quantity.is_of(family) {
            return Err(AxisError::Foreign { name: self.quantity.name(), family: family.name.clone() });
        }
        Axis::spaced(self.quantity, self.first, self.last, self.count, self.spacing).map(drop)
    }

    /// The values that lie between two, both included: the index of the first, and how many; none if there are none.
    pub fn between(&self, a: f64, b: f64) -> Option<(u32, u32)> {
        let (low, high) = (a.min(b), a.max(b));
        // A value that is written in a few digits stands for the nearest value of the axis.
        let slack = 1e-9 * self.first.abs().max(self.last.abs());
        let inside = |i: &u32| (low - slack..=high + slack).contains(&self.value(*i));
        let first = (0..self.count).find(inside)?;
        let last = (0..self.count).rev().find(inside)?;
        Some((first, last - first + 1))
    }

    /// The axis of `count` of its values, those from index `first` on.
    ///
    /// # Panics
    /// If there are not so many, or none are asked for.
    #[must_use]
    pub fn part(&self, first: u32, count: u32) -> Axis {
        assert!(count > 0 && first + count <= self.count, "{count} values from {first} on of {self}");
        let steps =
            Steps { first: self.value(first), last: self.value(first + count - 1), count, ..self.steps };
        Axis { steps, ..*self }
    }

    /// The indices in order of falling, or of rising, values.
    pub fn order(&self, falling: bool) -> Vec<u32> {
        let as_written = (self.first > self.last) == falling;
        if as_written { (0..self.count).collect() } else { (0..self.count).rev().collect() }
    }

    /// The setting of a control method that the axis varies, if it does.
    pub fn control(&self) -> Option<ControlQuantity> {
        match self.quantity {
            Quantity::Control(setting) => Some(setting),
            Quantity::Parameter(_) | Quantity::Start(_) => None,
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spacing = if self.spacing.is_linear() { "" } else { ":log" };
        let (first, last) = (Number(self.first), Number(self.last));
        write!(f, "{}={first}:{last}:{}{spacing}", self.quantity.name(), self.count)
    }
}

impl FromStr for Axis {
    type Err = AxisError;

    /// Reads an axis of the paper's oscillator.
    fn from_str(text: &str) -> Result<Self, AxisError> {
        Axis::of_family(text, Family::paper())
    }
}

impl Axis {
    /// Reads `NAME=FIRST:LAST:COUNT` or `NAME=FIRST:LAST:COUNT:log`, with the names of a family.
    ///
    /// # Errors
    /// What is wrong with the text, and those of [`Axis::spaced`].
    pub fn of_family(text: &str, family: &'static Family) -> Result<Self, AxisError> {
        let malformed = || AxisError::Malformed(text.to_owned());
        let (name, range) = text.split_once('=').ok_or_else(malformed)?;
        let quantity = Quantity::named(name.trim(), family)?;
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let (first, last, count, spacing) = match parts[..] {
            [first, last, count] => (first, last, count, Spacing::Linear),
            [first, last, count, "log"] => (first, last, count, Spacing::Log),
            _ => return Err(malformed()),
        };
        let first = first.parse().map_err(|_| malformed())?;
        let last = last.parse().map_err(|_| malformed())?;
        let count = whole(count).ok_or_else(malformed)?;
        let count = u32::try_from(count).map_err(|_| AxisError::Count { name: quantity.name(), count })?;
        Axis::spaced(quantity, first, last, count, spacing)
    }
}

#[cfg(test)]
mod tests {
    use super::super::written::WrittenAxis;
    use super::*;

    #[test]
    fn an_axis_reads_back_what_it_prints() {
        let axis: Axis = "omega=0.2:5:800".parse().unwrap();
        assert_eq!(axis.to_string().parse::<Axis>().unwrap(), axis);
        assert_eq!((axis.value(0), axis.value(799)), (0.2, 5.0));
        assert_eq!(axis.values().len(), 800);
        assert_eq!("delta=0.1:0.1:1".parse::<Axis>().unwrap().values(), [0.1]);
        let axis: Axis = "delta=1e-100:1:1e3".parse().unwrap();
        assert_eq!((axis.count, axis.to_string().as_str()), (1000, "delta=1e-100:1:1000"));
    }

    #[test]
    fn an_axis_may_fall_and_may_have_equal_ratios() {
        let down: Axis = "omega=5:1:401".parse().unwrap();
        let up: Axis = "omega=1:5:401".parse().unwrap();
        assert!((0..401).all(|i| (down.value(i) - up.value(400 - i)).abs() < 1e-14));
        assert_eq!((up.order(false)[0], up.order(true)[0]), (0, 400));
        assert_eq!((down.order(false)[0], down.order(true)[0]), (400, 0));
        for text in ["omega=0.1:10:401:log", "omega=10:0.1:401:log", "omega=3:3:1:log"] {
            let axis: Axis = text.parse().unwrap();
            assert_eq!(axis.to_string(), text);
            assert_eq!((axis.value(0), axis.value(axis.count - 1)), (axis.first, axis.last));
            let values = axis.values();
            let ratio = |pair: &[f64]| pair[1] / pair[0];
            assert!(values.windows(2).all(|pair| (ratio(pair) - ratio(&values[..2])).abs() < 1e-12));
            let stored = serde_json::to_string(&WrittenAxis::of(&axis)).unwrap();
            let read: WrittenAxis = serde_json::from_str(&stored).unwrap();
            assert_eq!(read.read(Family::paper()), Ok(axis));
        }
        let log: Axis = "omega=0.1:10:401:log".parse().unwrap();
        assert!((log.value(200) - 1.0).abs() < 1e-12 && (log.place(1.0) - 200.0).abs() < 1e-9);
        let linear: Axis = "omega=0.2:5:800".parse().unwrap();
        assert!(!serde_json::to_string(&linear).unwrap().contains("spacing"));
    }

    #[test]
    fn bad_axes_are_named() {
        let errors = [
            ("omega", "NAME=FIRST:LAST:COUNT"),
            ("omgea=1:2:3", "omgea"),
            ("omega=2:1:1", "COUNT of 1"),
            ("omega=1:2:3:lin", "NAME=FIRST:LAST:COUNT"),
            ("x2=-1:2:3:log", "above 0"),
            ("x2=2:0:3:log", "drop :log"),
            ("omega=1:1:3", "empty"),
            ("omega=1:2:1", "COUNT of 1"),
            ("omega=1:2:0", "COUNT of 0"),
            ("omega=1:2:1000000000", "COUNT of 1000000000"),
            ("omega=1:2:99999999999", "COUNT of 99999999999"),
            ("omega=1:2:-1", "NAME=FIRST:LAST:COUNT"),
            ("omega=1:2:2.5", "NAME=FIRST:LAST:COUNT"),
            ("delta=3e-100:3e-100:5", "delta=3e-100:3e-100"),
            ("omega=NaN:2:3", "finite"),
            ("omega=1:inf:3", "finite"),
            ("x2=-1e308:1e308:3", "too far apart"),
            ("delta=1e-300:1e10:3:log", "ratio"),
            ("delta=5e-324:0.5:3:log", "ratio"),
        ];
        for (text, part) in errors {
            let message = text.parse::<Axis>().unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
        assert!(matches!("omega=0:2:3".parse::<Axis>(), Err(AxisError::Parameter(_))));
        assert!(matches!("r=0.5:1.1:3".parse::<Axis>(), Err(AxisError::Parameter(_))));
    }
}
