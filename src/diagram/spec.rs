//! The bifurcation diagram to compute: an axis, how its columns begin, and what is read where.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::axis::SweepAxis;
use super::unit::ExponentUnit;
use super::written::WrittenDiagram;
use crate::analysis::{Probe, Schedule, ScheduleError};
use crate::model::{ParameterError, Setting, StateVector};
use crate::plane::{Component, Quantity, Start, StartError};

/// How the columns of a diagram begin.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Sweep {
    /// Every column by itself, from the same kind of start.
    Each(Start),
    /// With falling values, each column where the one before it ended.
    Down,
    /// With rising values, each column where the one before it ended.
    Up,
    /// Once down and once up.
    Both,
}

impl Sweep {
    /// The branches that the sweep gives.
    pub fn branches(self) -> &'static [Direction] {
        match self {
            Sweep::Each(_) => &[Direction::Each],
            Sweep::Down => &[Direction::Down],
            Sweep::Up => &[Direction::Up],
            Sweep::Both => &[Direction::Down, Direction::Up],
        }
    }

    /// Whether the state is carried from column to column.
    pub fn is_carried(self) -> bool {
        !matches!(self, Sweep::Each(_))
    }
}

impl fmt::Display for Sweep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Sweep::Each(start) => start.fmt(f),
            Sweep::Down => f.write_str("down"),
            Sweep::Up => f.write_str("up"),
            Sweep::Both => f.write_str("both"),
        }
    }
}

impl FromStr for Sweep {
    type Err = DiagramError;

    fn from_str(text: &str) -> Result<Self, DiagramError> {
        match text {
            "down" => Ok(Sweep::Down),
            "up" => Ok(Sweep::Up),
            "both" => Ok(Sweep::Both),
            text => match text.parse() {
                Ok(start) => Ok(Sweep::Each(start)),
                Err(StartError::Malformed(_)) => Err(DiagramError::Sweep(text.to_owned())),
                Err(error) => Err(error.into()),
            },
        }
    }
}

impl From<Sweep> for String {
    fn from(sweep: Sweep) -> String {
        sweep.to_string()
    }
}

impl TryFrom<String> for Sweep {
    type Error = DiagramError;

    fn try_from(text: String) -> Result<Self, DiagramError> {
        text.parse()
    }
}

/// How the columns of a branch follow each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Direction {
    /// They do not: each begins by itself.
    Each,
    /// With falling values of the axis.
    Down,
    /// With rising values of the axis.
    Up,
}

impl Direction {
    /// The name used in files, in keys and on the terminal.
    pub fn name(self) -> &'static str {
        match self {
            Direction::Each => "each",
            Direction::Down => "down",
            Direction::Up => "up",
        }
    }
}

/// A bifurcation diagram to compute.
///
/// Together with the version, back end and adapter this is everything needed to compute it again.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "WrittenDiagram")]
pub struct DiagramSpec {
    /// The horizontal axis: a parameter, or a component of the start.
    pub x: SweepAxis,
    /// The parameters that the axis does not vary.
    pub parameters: Setting,
    /// How columns begin.
    pub sweep: Sweep,
    /// How the first column of a carried sweep begins.
    pub start: Start,
    /// What is read where.
    pub probe: Probe,
    /// Forcing periods before and while the section is read; never cut short.
    pub schedule: Schedule,
    /// The most readings that are kept of one column.
    pub capacity: u32,
    /// The unit of the Lyapunov spectrum, if that is computed as well.
    pub spectrum: Option<ExponentUnit>,
}

impl DiagramSpec {
    /// The most readings that a diagram may have to hold.
    pub const LARGEST: u64 = 1 << 27;

    /// A schedule that is never cut short, so that early settling does not change what is drawn.
    pub fn schedule(transient: u32, observe: u32, max_period: u32) -> Schedule {
        Schedule { transient, observe, max_period, fixed_periods: true }
    }

    /// Checks that every column can be computed.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check(&self) -> Result<(), DiagramError> {
        self.schedule.check()?;
        if !self.probe.fits(self.parameters.family()) {
            return Err(DiagramError::Probe(self.parameters.family().name()));
        }
        let branches = self.sweep.branches().len() as u64;
        let readings = branches * u64::from(self.x.count()) * u64::from(self.capacity);
        if self.capacity == 0 || readings > Self::LARGEST {
            return Err(DiagramError::Capacity { columns: self.x.count(), capacity: self.capacity });
        }
        self.parameters.check()?;
        if let Quantity::Control(setting) = self.x.quantity() {
            return Err(DiagramError::Control(setting.name()));
        }
        let varies_start = matches!(self.x.quantity(), Quantity::Start(_));
        if varies_start && self.sweep.is_carried() {
            return Err(DiagramError::CarriedStart {
                axis: self.x.to_string(),
                sweep: self.sweep.to_string(),
            });
        }
        if varies_start && self.sweep == Sweep::Each(Start::Symmetric) {
            return Err(DiagramError::SymmetricStartVaried);
        }
        let first = if self.sweep.is_carried() { self.start } else { Start::Rest };
        for end in [0, self.x.count() - 1] {
            self.start_at(end).fits(self.parameters.family())?;
            let Ok(plant) = self.parameters_at(end).plant() else { continue };
            first.check(&plant, self.parameters.family())?;
            self.start_at(end).check(&plant, self.parameters.family())?;
        }
        Ok(())
    }

    /// The parameters of a column.
    pub fn parameters_at(&self, column: u32) -> Setting {
        match self.x.quantity() {
            Quantity::Parameter(parameter) => self.parameters.with(parameter, self.x.value(column)),
            Quantity::Start(_) | Quantity::Control(_) => self.parameters,
        }
    }

    /// The start of a column that begins by itself.
    pub fn start_at(&self, column: u32) -> Start {
        let start = match self.sweep {
            Sweep::Each(start) => start,
            Sweep::Down | Sweep::Up | Sweep::Both => self.start,
        };
        match self.x.quantity() {
            Quantity::Parameter(_) | Quantity::Control(_) => start,
            Quantity::Start(component) => {
                start_with(start, component, self.x.value(column), self.parameters.family().n())
            }
        }
    }
}

fn start_with(start: Start, component: Component, value: f64, coordinates: usize) -> Start {
    let mut state = if let Start::State(state) = start { state } else { StateVector::zeros(coordinates) };
    state[component.index()] = value;
    Start::State(state)
}

/// Why a diagram was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DiagramError {
    /// The probe is of another system.
    #[error("{0} has no such section, or no such quantity on it: choose its own stops and components")]
    Probe(&'static str),
    /// No such way to begin.
    #[error(
        "`{0}` is no sweep: write rest, symmetric, a state X1,X2,V1,V2 (x1 … xn, v1 … vn), down, up or both"
    )]
    Sweep(String),
    /// Nothing, or too much, would be kept.
    #[error(
        "{columns} columns with up to {capacity} points each cannot be kept: give --points 1 or more, and at most {} in \
         all (by default 16 for each period observed)",
        DiagramSpec::LARGEST
    )]
    Capacity {
        /// Columns.
        columns: u32,
        /// Readings of each.
        capacity: u32,
    },
    /// Diagrams are of motion without control.
    #[error(
        "axis {0} is a setting of a control method, and a diagram has none: choose a parameter or a component of \
         the start, or draw a map --control"
    )]
    Control(&'static str),
    /// A carried state has no start that could be varied.
    #[error("--sweep {sweep} carries the state along, and --x {axis} varies the start: choose --sweep rest")]
    CarriedStart {
        /// The axis.
        axis: String,
        /// The sweep.
        sweep: String,
    },
    /// An axis over a start component needs a start that it can change.
    #[error("an axis over a component of the start needs --sweep rest or --sweep X1,X2,V1,V2, not symmetric")]
    SymmetricStartVaried,
    /// The schedule cannot be used.
    #[error(transparent)]
    Schedule(#[from] ScheduleError),
    /// A parameter cannot be used.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A start cannot be used.
    #[error(transparent)]
    Start(#[from] StartError),
}
