//! Axes: a parameter, or a component of the start, in equal steps.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::control::ControlQuantity;
use crate::model::{Number, Parameter, ParameterError, whole};

/// A component of the start state, at forcing phase 0; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Component {
    /// Displacement of the first mass, between the stops.
    X1,
    /// Displacement of the second mass.
    X2,
    /// Velocity of the first mass.
    V1,
    /// Velocity of the second mass.
    V2,
}

impl Component {
    /// Every component, in the order of a state.
    pub const ALL: [Component; 4] = [Component::X1, Component::X2, Component::V1, Component::V2];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Component::X1 => "x1",
            Component::X2 => "x2",
            Component::V1 => "v1",
            Component::V2 => "v2",
        }
    }

    /// Where the component stands in a state.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// What an axis varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Quantity {
    /// A parameter of the system.
    Parameter(Parameter),
    /// A component of the start.
    Start(Component),
    /// A setting of a control method.
    Control(ControlQuantity),
}

impl Quantity {
    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Quantity::Parameter(parameter) => parameter.name(),
            Quantity::Start(component) => component.name(),
            Quantity::Control(setting) => setting.name(),
        }
    }
}

impl FromStr for Quantity {
    type Err = AxisError;

    fn from_str(name: &str) -> Result<Self, AxisError> {
        if let Some(component) = Component::ALL.into_iter().find(|c| c.name() == name) {
            return Ok(Quantity::Start(component));
        }
        if let Some(setting) = ControlQuantity::ALL.into_iter().find(|c| c.name() == name) {
            return Ok(Quantity::Control(setting));
        }
        name.parse().map(Quantity::Parameter).map_err(|_| AxisError::UnknownName(name.to_owned()))
    }
}

/// An axis of a plane: `count` equally spaced values from `first` to `last`, both included.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What is varied.
    pub quantity: Quantity,
    /// The first value.
    pub first: f64,
    /// The last value; greater than the first, or equal to it where there is but one.
    pub last: f64,
    /// How many values.
    pub count: u32,
}

impl Axis {
    /// The most values an axis may have.
    pub const LARGEST: u32 = 65_536;

    /// A checked axis.
    ///
    /// # Errors
    /// Values that are not finite or not increasing, a count outside 1 to [`Axis::LARGEST`], one value for two
    /// different ends, and ends outside the physical range of a parameter.
    pub fn new(quantity: Quantity, first: f64, last: f64, count: u32) -> Result<Self, AxisError> {
        let name = quantity.name();
        if !first.is_finite() || !last.is_finite() {
            return Err(AxisError::NotFinite { name, first, last });
        }
        if !(1..=Self::LARGEST).contains(&count) {
            return Err(AxisError::Count { name, count: u64::from(count) });
        }
        if first >= last && !(first == last && count == 1) {
            return Err(AxisError::NotIncreasing { name, first, last });
        }
        if first < last && count == 1 {
            return Err(AxisError::OneValue { name, first, last });
        }
        if let Quantity::Parameter(parameter) = quantity {
            parameter.check(first)?;
            parameter.check(last)?;
        }
        let axis = Axis { quantity, first, last, count };
        let whole = axis.control().is_some_and(ControlQuantity::is_whole);
        if whole && axis.values().iter().any(|value| value.fract() != 0.0 || *value < 0.0) {
            return Err(AxisError::NotWhole { name, first, last, count });
        }
        Ok(axis)
    }

    /// The value at index `i`; the ends are exact.
    pub fn value(&self, i: u32) -> f64 {
        if i + 1 == self.count {
            return self.last;
        }
        self.first + (self.last - self.first) * f64::from(i) / f64::from(self.count - 1)
    }

    /// The setting of a control method that the axis varies, if it does.
    pub fn control(&self) -> Option<ControlQuantity> {
        match self.quantity {
            Quantity::Control(setting) => Some(setting),
            Quantity::Parameter(_) | Quantity::Start(_) => None,
        }
    }

    /// All values, in order.
    pub fn values(&self) -> Vec<f64> {
        (0..self.count).map(|i| self.value(i)).collect()
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}:{}:{}", self.quantity.name(), Number(self.first), Number(self.last), self.count)
    }
}

impl FromStr for Axis {
    type Err = AxisError;

    /// Reads `NAME=FIRST:LAST:COUNT`.
    fn from_str(text: &str) -> Result<Self, AxisError> {
        let malformed = || AxisError::Malformed(text.to_owned());
        let (name, range) = text.split_once('=').ok_or_else(malformed)?;
        let quantity: Quantity = name.trim().parse()?;
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let [first, last, count] = parts[..] else { return Err(malformed()) };
        let first = first.parse().map_err(|_| malformed())?;
        let last = last.parse().map_err(|_| malformed())?;
        let count = whole(count).ok_or_else(malformed)?;
        let count = u32::try_from(count).map_err(|_| AxisError::Count { name: quantity.name(), count })?;
        Axis::new(quantity, first, last, count)
    }
}

/// Why an axis was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AxisError {
    /// Not of the form NAME=FIRST:LAST:COUNT.
    #[error("`{0}` is not an axis: write NAME=FIRST:LAST:COUNT, for example omega=0.2:5:800")]
    Malformed(String),
    /// Neither a parameter nor a component of the start.
    #[error(
        "unknown axis `{0}`; an axis is one of the parameters omega, delta, zeta, r, mu_m, mu_k, mu_c, f20 \
         or a component of the start x1, x2, v1, v2 (or, with --control, a setting of the method: gain, delay, \
         amplitude, alpha, dead_band, gamma, phase, period, noise, target_v1, target_x2, target_v2, target_tau)"
    )]
    UnknownName(String),
    /// An end is NaN or infinite.
    #[error("axis {name}={}:{} has an end that is not a finite number", Number(*first), Number(*last))]
    NotFinite {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
    },
    /// Reversed or empty.
    #[error("axis {name}={}:{} is empty or reversed: the last value must be greater than the first", Number(*first), Number(*last))]
    NotIncreasing {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
    },
    /// Too few or too many values.
    #[error("axis {name} has a COUNT of {count}: give 1 to {}", Axis::LARGEST)]
    Count {
        /// The axis.
        name: &'static str,
        /// The count that was asked for.
        count: u64,
    },
    /// Whole numbers are wanted.
    #[error(
        "axis {name}={}:{}:{count} has values that are not whole numbers: choose a COUNT so that all are",
        Number(*first),
        Number(*last)
    )]
    NotWhole {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
        /// How many values.
        count: u32,
    },
    /// Two ends but one value.
    #[error("axis {name}={}:{} has two ends but a COUNT of 1: give 2 or more, or equal ends", Number(*first), Number(*last))]
    OneValue {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
    },
    /// An end is outside the physical range of the parameter.
    #[error("an end of the axis cannot be used")]
    Parameter(#[from] ParameterError),
}

#[cfg(test)]
mod tests {
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
    fn bad_axes_are_named() {
        let errors = [
            ("omega", "NAME=FIRST:LAST:COUNT"),
            ("omgea=1:2:3", "omgea"),
            ("omega=2:1:3", "reversed"),
            ("omega=1:1:3", "empty"),
            ("omega=1:2:1", "COUNT of 1"),
            ("omega=1:2:0", "COUNT of 0"),
            ("omega=1:2:1000000000", "COUNT of 1000000000"),
            ("omega=1:2:99999999999", "COUNT of 99999999999"),
            ("omega=1:2:-1", "NAME=FIRST:LAST:COUNT"),
            ("omega=1:2:2.5", "NAME=FIRST:LAST:COUNT"),
            ("delta=3e-100:2e-100:5", "delta=3e-100:2e-100"),
            ("omega=NaN:2:3", "finite"),
            ("omega=1:inf:3", "finite"),
        ];
        for (text, part) in errors {
            let message = text.parse::<Axis>().unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
        assert!(matches!("omega=0:2:3".parse::<Axis>(), Err(AxisError::Parameter(_))));
        assert!(matches!("r=0.5:1.1:3".parse::<Axis>(), Err(AxisError::Parameter(_))));
    }
}
