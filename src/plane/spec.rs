//! The plane to compute: two axes over fixed parameters, a start, and a schedule.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::axis::Axis;
use super::quantity::Quantity;
use super::start::{Start, StartError};
use super::written::{WrittenAxis, WrittenParameters, WrittenSystem, parameters, setting};
use crate::analysis::{Schedule, ScheduleError};
use crate::model::{ParameterError, Setting, StateVector};

/// A plane of parameter pairs (or of start components), cell by cell in rows of equal y.
///
/// Together with the version, back end and adapter this is everything needed to compute a map again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "WrittenPlane", try_from = "WrittenPlane")]
pub struct Plane {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis; its first value is the first row.
    pub y: Axis,
    /// The parameters that no axis varies (those of an axis are overridden cell by cell).
    pub parameters: Setting,
    /// How every cell begins; an axis over a start component overrides that component.
    pub start: Start,
    /// How long every cell runs.
    pub schedule: Schedule,
}

impl Plane {
    /// The largest number of cells in one plane.
    pub const LARGEST: u64 = 1 << 31;

    /// The largest number of cells whose results are held at once; more go into a store.
    pub const LARGEST_AT_ONCE: u64 = 1 << 26;

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
        let axes = [&self.x, &self.y];
        let varies_start = |axis: &&Axis| matches!(axis.quantity, Quantity::Start(_));
        if self.start == Start::Symmetric && axes.iter().any(varies_start) {
            return Err(PlaneError::SymmetricStartVaried);
        }
        self.start.fits(self.parameters.family())?;
        // The places between the stops are convex, and the gaps are seldom anything but monotone: the corners decide.
        for column in [0, self.x.count - 1] {
            for row in [0, self.y.count - 1] {
                let Ok(plant) = self.parameters_at(column, row).plant() else { continue };
                self.start_at(column, row).check(&plant, self.parameters.family())?;
            }
        }
        Ok(())
    }

    /// Whether the system in the middle of the plane has a mirror.
    pub fn has_mirror(&self) -> bool {
        self.parameters_at(self.x.count / 2, self.y.count / 2).has_mirror()
    }

    /// How many cells the plane has.
    pub fn cells(&self) -> u64 {
        u64::from(self.x.count) * u64::from(self.y.count)
    }

    /// The parameters of the cell in column `column` of row `row`.
    pub fn parameters_at(&self, column: u32, row: u32) -> Setting {
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
                    let n = self.parameters.family().n();
                    let mut state =
                        if let Start::State(state) = start { state } else { StateVector::zeros(n) };
                    state[component.index()] = axis.value(i);
                    Start::State(state)
                }
            }
        })
    }
}

/// A plane as files carry it.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct WrittenPlane {
    x: WrittenAxis,
    y: WrittenAxis,
    #[serde(default)]
    system: Option<WrittenSystem>,
    parameters: WrittenParameters,
    start: Start,
    schedule: Schedule,
}

impl From<Plane> for WrittenPlane {
    fn from(plane: Plane) -> Self {
        WrittenPlane {
            x: WrittenAxis::of(&plane.x),
            y: WrittenAxis::of(&plane.y),
            system: Some(WrittenSystem::of(plane.parameters.family())),
            parameters: parameters(&plane.parameters),
            start: plane.start,
            schedule: plane.schedule,
        }
    }
}

impl TryFrom<WrittenPlane> for Plane {
    type Error = String;

    fn try_from(written: WrittenPlane) -> Result<Self, String> {
        let family = WrittenSystem::read(written.system.as_ref())?;
        Ok(Plane {
            x: written.x.read(family)?,
            y: written.y.read(family)?,
            parameters: setting(family, &written.parameters)?,
            start: written.start,
            schedule: written.schedule,
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
