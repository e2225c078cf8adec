//! Why an axis is refused.

use thiserror::Error;

use crate::model::{Number, ParameterError};

/// The most values an axis may have.
pub(super) const MOST_VALUES: u32 = 65_536;

/// Why an axis was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AxisError {
    /// Not of the form NAME=FIRST:LAST:COUNT or NAME=FIRST:LAST:COUNT:log.
    #[error(
        "`{0}` is not an axis: write NAME=FIRST:LAST:COUNT, for example omega=0.2:5:800, with :log behind it for \
         equal ratios"
    )]
    Malformed(String),
    /// Neither a parameter nor a component of the start.
    #[error(
        "unknown axis `{name}`; an axis is one of the parameters or a component of the start: {known} (or, with \
         --control, a setting of the method: gain, delay, amplitude, alpha, dead_band, gamma, phase, period, noise, \
         target_v1, target_x2, target_v2, target_tau)"
    )]
    UnknownName {
        /// The name.
        name: String,
        /// The names that there are.
        known: String,
    },
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
    /// Several values, all alike.
    #[error("axis {name}={}:{} is empty: give two different ends, or a COUNT of 1", Number(*first), Number(*last))]
    Empty {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
    },
    /// A logarithmic axis through or below zero.
    #[error("axis {name}={}:{} cannot be logarithmic: give two ends above 0, or drop :log", Number(*first), Number(*last))]
    NotPositive {
        /// The axis.
        name: &'static str,
        /// Its first value.
        first: f64,
        /// Its last value.
        last: f64,
    },
    /// Too few or too many values.
    #[error("axis {name} has a COUNT of {count}: give 1 to {}", MOST_VALUES)]
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
