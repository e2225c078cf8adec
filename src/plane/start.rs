//! How a cell's trajectory begins; part of every result, since the plane is multistable.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::model::{Number, System, joined};
use crate::theory::symmetric_start;

/// How a trajectory begins, at forcing phase 0.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// Both masses at rest at their equilibrium.
    Rest,
    /// The stable-branch 1-1-1 symmetric motion, nudged, where it exists and is physical; rest elsewhere.
    Symmetric,
    /// The given (x1, x2, v1, v2); non-dimensional.
    State([f64; 4]),
}

impl Start {
    /// The (x1, x2, v1, v2) that a trajectory of this system begins with, at forcing phase 0; non-dimensional.
    pub fn state(&self, system: &System) -> [f64; 4] {
        match *self {
            Start::Rest => [0.0; 4],
            Start::Symmetric => symmetric_start(system).unwrap_or([0.0; 4]),
            Start::State(state) => state,
        }
    }

    /// Checks that the first mass begins between stops at ±`delta`.
    ///
    /// # Errors
    /// [`StartError::OutsideStops`] with both values.
    pub fn check(&self, delta: f64) -> Result<(), StartError> {
        match *self {
            Start::State([x1, ..]) if x1.abs() > delta => Err(StartError::OutsideStops { x1, delta }),
            _ => Ok(()),
        }
    }
}

impl fmt::Display for Start {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Start::Rest => f.write_str("rest"),
            Start::Symmetric => f.write_str("symmetric"),
            Start::State(state) => f.write_str(&joined(state, ",")),
        }
    }
}

impl FromStr for Start {
    type Err = StartError;

    fn from_str(text: &str) -> Result<Self, StartError> {
        match text {
            "rest" => return Ok(Start::Rest),
            "symmetric" => return Ok(Start::Symmetric),
            _ => {}
        }
        let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
        let numbers = numbers.map_err(|_| StartError::Malformed(text.to_owned()))?;
        let state: [f64; 4] = numbers.try_into().map_err(|_| StartError::Malformed(text.to_owned()))?;
        if state.iter().all(|value| value.is_finite()) {
            Ok(Start::State(state))
        } else {
            Err(StartError::NotFinite(text.to_owned()))
        }
    }
}

/// Why a start was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum StartError {
    /// Neither a name nor four numbers.
    #[error("`{0}` is not a start: write rest, symmetric, or four numbers X1,X2,V1,V2")]
    Malformed(String),
    /// A component is NaN or infinite.
    #[error("start `{0}` has a component that is not a finite number")]
    NotFinite(String),
    /// The first mass would begin beyond a stop.
    #[error("the start x1 = {} lies outside the stops at ±{delta} (delta = {delta}); choose |x1| ≤ delta", Number(*x1), delta = Number(*delta))]
    OutsideStops {
        /// The first mass's displacement.
        x1: f64,
        /// The half clearance.
        delta: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_start_lies_between_the_stops() {
        assert_eq!(Start::Rest.check(0.0), Ok(()));
        assert_eq!(Start::State([-0.1, 9.0, 9.0, 9.0]).check(0.1), Ok(()));
        let outside = Start::State([-0.2, 0.0, 0.0, 0.0]).check(0.1);
        assert_eq!(outside, Err(StartError::OutsideStops { x1: -0.2, delta: 0.1 }));
    }

    #[test]
    fn starts_round_trip_and_bad_ones_are_named() {
        for start in [Start::Rest, Start::Symmetric, Start::State([0.05, -1.5, 0.0, 2e-3])] {
            assert_eq!(start.to_string().parse(), Ok(start));
        }
        for text in ["", "Rest", "1,2,3", "1,2,3,4,5", "a,b,c,d"] {
            assert_eq!(text.parse::<Start>(), Err(StartError::Malformed(text.to_owned())));
        }
        assert!(matches!("0,inf,0,0".parse::<Start>(), Err(StartError::NotFinite(_))));
    }
}
