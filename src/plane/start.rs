//! How a cell's trajectory begins; part of every result, since the plane is multistable.

use std::str::FromStr;

use derive_more::Display;
use nalgebra::DVector;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::model::{Number, StateVector, System, joined};
use crate::system::{Family, Plant};
use crate::theory::{SymmetricStarts, symmetric_start};

/// A start that lies beyond a stop by no more than this share of the numbers that say so lies on it.
const ROUNDING: f64 = 1e-12;

/// How a trajectory begins, at forcing phase 0.
#[derive(Clone, Copy, Debug, PartialEq, Display, Serialize, Deserialize)]
#[display(rename_all = "lowercase")]
#[serde(rename_all = "lowercase")]
pub enum Start {
    /// All masses at rest at the origin, moved within the stops where it lies beyond one.
    Rest,
    /// The stable-branch 1-1-1 symmetric motion, nudged, where it exists and is physical; rest elsewhere, and
    /// where a system has no mirror.
    Symmetric,
    /// The given (x1 … xn, v1 … vn); non-dimensional.
    #[display("{}", joined(_0, ","))]
    State(StateVector),
}

impl Start {
    /// The state (x1 … xn, v1 … vn) that a trajectory of this system begins with, at forcing phase 0; non-dimensional.
    ///
    /// Rest is the origin, moved onto a stop beyond which it would lie. A given state is moved so by what rounding has put it
    /// beyond a stop; one that lies farther beyond is what it is.
    pub fn state(&self, system: &System) -> StateVector {
        self.begun(system).unwrap_or_else(|Inadmissible(state)| state)
    }

    /// The same, where nothing stands in the way of the start.
    ///
    /// # Errors
    /// [`Inadmissible`] for a given state that lies beyond a stop of the system.
    pub fn begun(&self, system: &System) -> Result<StateVector, Inadmissible> {
        self.begun_by(system, &mut SymmetricStarts::default())
    }

    /// The same of one system after the other.
    ///
    /// # Errors
    /// As [`Start::begun`].
    pub fn begun_by(
        &self,
        system: &System,
        symmetric: &mut SymmetricStarts,
    ) -> Result<StateVector, Inadmissible> {
        let rest = || {
            let origin = StateVector::zeros(system.coordinates());
            let is_between = system.stops().all(|(_, stop)| stop.gap >= 0.0);
            if is_between { origin } else { system.between_stops(origin) }
        };
        match *self {
            Start::Rest => Ok(rest()),
            Start::Symmetric => {
                let found = symmetric.of(system).and_then(|state| StateVector::from_slice(&state));
                Ok(found.unwrap_or_else(rest))
            }
            Start::State(state) => {
                let places = system.stops().map(|(direction, stop)| Place::of(&state, direction, stop.gap));
                match places.max().unwrap_or(Place::Between) {
                    Place::Between => Ok(state),
                    Place::Rounded => Ok(system.between_stops(state)),
                    Place::Beyond => Err(Inadmissible(state)),
                }
            }
        }
    }

    /// Whether a motion of a plant begins with it.
    pub fn begins(&self, plant: &Plant) -> bool {
        let Start::State(state) = self else { return true };
        plant.stops.iter().all(|stop| Place::of(state, &stop.direction, stop.gap) < Place::Beyond)
    }

    /// The start that is really taken: rest where there is no symmetric motion to begin on.
    pub fn taken(&self, system: &System) -> Self {
        if *self == Start::Symmetric && symmetric_start(system).is_none() { Start::Rest } else { *self }
    }

    /// Checks that the start has as many components as a family's states.
    ///
    /// # Errors
    /// [`StartError::Components`] with both numbers, and [`StartError::NotFinite`].
    pub fn fits(&self, family: &Family) -> Result<(), StartError> {
        match *self {
            Start::State(state) if state.coordinates() != family.n() => {
                Err(StartError::Components { given: state.len(), needed: 2 * family.n() })
            }
            Start::State(state) if !state.iter().all(|value| value.is_finite()) => {
                Err(StartError::NotFinite(self.to_string()))
            }
            _ => Ok(()),
        }
    }

    /// Checks that the masses begin between the stops of a family's plant.
    ///
    /// # Errors
    /// [`StartError::OutsideStops`] with the place, and [`StartError::Components`].
    pub fn check(&self, plant: &Plant, family: &Family) -> Result<(), StartError> {
        self.fits(family)?;
        let Start::State(state) = *self else { return Ok(()) };
        for (number, stop) in plant.stops.iter().enumerate() {
            if Place::of(&state, &stop.direction, stop.gap) == Place::Beyond {
                let place = along(&stop.direction, &state);
                let met = family.stop_place(number);
                let along = met.to_string();
                let along = along.split_once(" = ").map_or("d·x", |(along, _)| along);
                // One coordinate that meets its stop from above.
                let sign = if met.negative { "-" } else { "" };
                let place = format!("{sign}{along} = {}", Number(place));
                return Err(StartError::OutsideStops {
                    start: Box::new(*self),
                    stop: family.stops()[number].plain_name().to_owned(),
                    place: place.into(),
                    gap: stop.gap,
                });
            }
        }
        Ok(())
    }
}

/// d·x.
fn along(direction: &DVector<f64>, state: &StateVector) -> f64 {
    direction.iter().zip(state.iter()).map(|(d, x)| d * x).sum()
}

/// Where a state lies at a stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Between,
    /// Beyond the stop by rounding: it stands for one that lies on it.
    Rounded,
    Beyond,
}

impl Place {
    fn of(state: &StateVector, direction: &DVector<f64>, gap: f64) -> Self {
        let excess = along(direction, state) - gap;
        let size: f64 = direction.iter().zip(state.iter()).map(|(d, x)| (d * x).abs()).sum();
        match excess {
            excess if excess <= 0.0 => Place::Between,
            excess if excess <= ROUNDING * (size + gap.abs()) => Place::Rounded,
            _ => Place::Beyond,
        }
    }
}

/// A state (x1 … xn, v1 … vn) that lies beyond a stop, so that no motion begins there; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inadmissible(pub StateVector);

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
        let state =
            StateVector::from_slice(&numbers).ok_or_else(|| StartError::Malformed(text.to_owned()))?;
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
    /// Neither a name nor the numbers of a state.
    #[error(
        "`{0}` is not a start: write rest, symmetric, or a state X1,X2,V1,V2 (x1 … xn, v1 … vn: two numbers for each coordinate)"
    )]
    Malformed(String),
    /// A component is NaN or infinite.
    #[error("start `{0}` has a component that is not a finite number")]
    NotFinite(String),
    /// The system has another number of coordinates.
    #[error(
        "the start has {given} components, and a state of this system has {needed}: give x1 … xn, v1 … vn"
    )]
    Components {
        /// The components given.
        given: usize,
        /// The components of a state.
        needed: usize,
    },
    /// A mass would begin beyond a stop.
    #[error(
        "the start {start} lies beyond stop {stop}: {place}, and the gap is {}",
        Number(*gap)
    )]
    OutsideStops {
        /// The start.
        start: Box<Start>,
        /// Which stop, by its name.
        stop: String,
        /// Where it would begin, in words: direction · x, which is to stay below the gap.
        place: Box<str>,
        /// The stop's gap.
        gap: f64,
    },
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setting;

    #[test]
    fn a_start_lies_between_the_stops() {
        let plant = Setting::defaults(Family::paper()).plant().unwrap();
        assert_eq!(Start::Rest.check(&plant, Family::paper()), Ok(()));
        assert_eq!(Start::State([-0.1, 9.0, 9.0, 9.0].into()).check(&plant, Family::paper()), Ok(()));
        let start = Start::State([-0.2, 0.0, 0.0, 0.0].into());
        assert_eq!(
            start.check(&plant, Family::paper()),
            Err(StartError::OutsideStops {
                start: start.into(),
                stop: "B".into(),
                place: "-x1 = 0.2".into(),
                gap: 0.1
            })
        );
        let nowhere = Start::State([0.0, f64::NAN, 0.0, 0.0].into());
        assert!(matches!(nowhere.check(&plant, Family::paper()), Err(StartError::NotFinite(_))));
        let short = Start::State(StateVector::zeros(1));
        assert_eq!(short.check(&plant, Family::paper()), Err(StartError::Components { given: 2, needed: 4 }));
    }

    #[test]
    fn starts_round_trip_and_bad_ones_are_named() {
        for start in [Start::Rest, Start::Symmetric, Start::State([0.05, -1.5, 0.0, 2e-3].into())] {
            assert_eq!(start.to_string().parse(), Ok(start));
        }
        for text in ["", "Rest", "1,2,3", "1,2,3,4,5,6,7,8,9,10", "a,b,c,d"] {
            assert_eq!(text.parse::<Start>(), Err(StartError::Malformed(text.to_owned())));
        }
        assert!(matches!("0,inf,0,0".parse::<Start>(), Err(StartError::NotFinite(_))));
    }
}
