//! Placeholder of the recorded orbit.

use std::fmt;

use crate::model::System;

/// A stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stop {
    /// x1 = +δ.
    A,
    /// x1 = −δ.
    B,
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stop::A => "A",
            Stop::B => "B",
        })
    }
}

/// An impact; everything non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct ImpactEvent {
    pub time: f64,
    pub stop: Stop,
    pub velocity_before: f64,
    pub velocity_after: f64,
    pub x2: f64,
    pub v2: f64,
    pub phase: f64,
}

/// A point of the trajectory; everything non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Sample {
    pub time: f64,
    pub x1: f64,
    pub x2: f64,
    pub v1: f64,
    pub v2: f64,
}

/// A recorded orbit.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs)]
pub struct Recording {
    pub impacts: Vec<ImpactEvent>,
    pub samples: Vec<Sample>,
}

/// Follows an orbit.
pub fn record(
    _system: &System,
    _start: [f64; 4],
    _transient: u32,
    _periods: u32,
    _samples_per_period: u32,
) -> Recording {
    Recording { impacts: Vec::new(), samples: Vec::new() }
}
