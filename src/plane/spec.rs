//! The plane to compute: two axes over fixed parameters, a start, and a schedule.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::axis::{Axis, Component, Quantity};
use super::start::{Start, StartError};
use crate::analysis::{Schedule, ScheduleError};
use crate::model::{Parameter, ParameterError, Parameters};

/// A plane of parameter pairs (or of start components), cell by cell in rows of equal y.
///
/// Together with the version, back end and adapter this is everything needed to compute a map again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis; its first value is the first row.
    pub y: Axis,
    /// The parameters that no axis varies (those of an axis are overridden cell by cell).
    pub parameters: Parameters,
    /// How every cell begins; an axis over a start component overrides that component.
    pub start: Start,
    /// How long every cell runs.
    pub schedule: Schedule,
}

impl Plane {
    /// The largest number of cells in one plane.
    pub const LARGEST: u64 = 1 << 26;

    /// Checks that every cell can be computed: ranges, distinct axes, size, schedule and starts.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check(&self) -> Result<(), PlaneError> {
        if self.x.quantity == self.y.quantity {
            return Err(PlaneError::SameAxis(self.x.quantity.name()));
        }
        if self.cells() > Self::LARGEST {
            return Err(PlaneError::TooLarge { x: self.x.count, y: self.y.count });
        }
        if let Some(setting) = [&self.x, &self.y].into_iter().find_map(|axis| axis.control()) {
            return Err(PlaneError::NoControl(setting.name()));
        }
        self.schedule.check()?;
        self.check_cells()
    }

    /// Checks parameters and starts, whatever else an axis varies.
    pub(super) fn check_cells(&self) -> Result<(), PlaneError> {
        self.parameters.check()?;
        self.check_starts()
    }

    fn check_starts(&self) -> Result<(), PlaneError> {
        let varied = |c: Component| [&self.x, &self.y].into_iter().find(|a| a.quantity == Quantity::Start(c));
        let any_varied = Component::ALL.into_iter().any(|c| varied(c).is_some());
        if self.start == Start::Symmetric && any_varied {
            return Err(PlaneError::SymmetricStartVaried);
        }
        let farthest = match (varied(Component::X1), self.start) {
            (Some(axis), _) if axis.first.abs() > axis.last.abs() => axis.first,
            (Some(axis), _) => axis.last,
            (None, Start::State([x1, ..])) => x1,
            (None, _) => 0.0,
        };
        let narrowest = [&self.x, &self.y]
            .into_iter()
            .find(|axis| axis.quantity == Quantity::Parameter(Parameter::Delta))
            .map_or(self.parameters.delta, Axis::least);
        Ok(Start::State([farthest, 0.0, 0.0, 0.0]).check(narrowest)?)
    }

    /// How many cells the plane has.
    pub fn cells(&self) -> u64 {
        u64::from(self.x.count) * u64::from(self.y.count)
    }

    /// The parameters of the cell in column `column` of row `row`.
    pub fn parameters_at(&self, column: u32, row: u32) -> Parameters {
        [(&self.x, column), (&self.y, row)].into_iter().fold(self.parameters, |parameters, (axis, i)| {
            match axis.quantity {
                Quantity::Parameter(parameter) => parameters.with(parameter, axis.value(i)),
                Quantity::Start(_) | Quantity::Control(_) => parameters,
            }
        })
    }

    /// The start of the cell in column `column` of row `row`.
    pub fn start_at(&self, column: u32, row: u32) -> Start {
        [(&self.x, column), (&self.y, row)].into_iter().fold(self.start, |start, (axis, i)| {
            match (axis.quantity, start) {
                (Quantity::Parameter(_) | Quantity::Control(_), start) => start,
                (Quantity::Start(component), start) => {
                    let mut state = if let Start::State(state) = start { state } else { [0.0; 4] };
                    state[component.index()] = axis.value(i);
                    Start::State(state)
                }
            }
        })
    }
}

/// Why a plane was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlaneError {
    /// Both axes vary the same thing.
    #[error("both axes are {0}: choose two different names")]
    SameAxis(&'static str),
    /// An axis varies a setting of a control method, and there is none.
    #[error("axis {0} is a setting of a control method: choose one with --control sine, pulse or delay")]
    NoControl(&'static str),
    /// More cells than [`Plane::LARGEST`].
    #[error("a plane of {x} × {y} cells is too large: at most {} cells are accepted", Plane::LARGEST)]
    TooLarge {
        /// Columns.
        x: u32,
        /// Rows.
        y: u32,
    },
    /// An axis over a start component needs a start that it can change.
    #[error("an axis over a component of the start needs --start rest or --start X1,X2,V1,V2, not symmetric")]
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
