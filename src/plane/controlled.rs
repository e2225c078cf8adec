//! A plane under control: what is asked, and what came out of every cell.

use serde::Serialize;
use thiserror::Error;

use super::axis::Axis;
use super::quantity::Quantity;
use super::region_map::{Provenance, RegionMap};
use super::spec::{Plane, PlaneError};
use super::start::Start;
use super::written::{WrittenAxis, WrittenParameters, WrittenSystem, parameters};
use crate::analysis::Schedule;
use crate::control::{ControlError, ControlSchedule, ControlScheduleError, Outcome, Scheme};
use crate::model::Setting;

/// A plane of parameters, start components and settings of a control method, whose cells are all controlled.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "WrittenControlPlane")]
pub struct ControlPlane {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis; its first value is the first row.
    pub y: Axis,
    /// The parameters that no axis varies.
    pub parameters: Setting,
    /// How every cell begins.
    pub start: Start,
    /// What controls them; axes over its settings override those.
    pub control: Scheme,
    /// When, and for how long, in iterates on σ.
    pub iterates: ControlSchedule,
}

impl ControlPlane {
    /// Checks that every cell can be computed.
    ///
    /// # Errors
    /// The first thing that cannot be used, with its value and the remedy.
    pub fn check(&self) -> Result<(), ControlPlaneError> {
        let plane = self.plane();
        if self.x.quantity == self.y.quantity {
            return Err(PlaneError::SameAxis(self.x.quantity.name()).into());
        }
        if plane.cells() > Plane::LARGEST_AT_ONCE {
            return Err(PlaneError::TooLarge { x: self.x.count, y: self.y.count }.into());
        }
        self.iterates.check()?;
        self.control.check()?;
        for axis in [&self.x, &self.y] {
            let Some(setting) = axis.control() else { continue };
            for value in [axis.first, axis.last] {
                let method = self.control.method();
                let varied = self.control.with(setting, value);
                varied.ok_or(ControlPlaneError::NoSuchSetting { name: setting.name(), method })?.check()?;
            }
        }
        Ok(plane.check_cells()?)
    }

    /// The same plane without control: its axes, parameters and start.
    pub fn plane(&self) -> Plane {
        Plane {
            x: self.x,
            y: self.y,
            parameters: self.parameters,
            start: self.start,
            schedule: Schedule { transient: 0, observe: 1, max_period: 1, fixed_periods: true },
        }
    }

    /// The scheme of the cell in column `column` of row `row`.
    pub fn scheme_at(&self, column: u32, row: u32) -> Scheme {
        [(&self.x, column), (&self.y, row)].into_iter().fold(self.control, |scheme, (axis, i)| {
            match axis.quantity {
                Quantity::Control(setting) => scheme.with(setting, axis.value(i)).unwrap_or(scheme),
                Quantity::Parameter(_) | Quantity::Start(_) => scheme,
            }
        })
    }
}

/// A plane under control as files carry it.
#[derive(Clone, Debug, Serialize)]
struct WrittenControlPlane {
    x: WrittenAxis,
    y: WrittenAxis,
    system: WrittenSystem,
    parameters: WrittenParameters,
    start: Start,
    control: Scheme,
    iterates: ControlSchedule,
}

impl From<ControlPlane> for WrittenControlPlane {
    fn from(plane: ControlPlane) -> Self {
        WrittenControlPlane {
            x: WrittenAxis::of(&plane.x),
            y: WrittenAxis::of(&plane.y),
            system: WrittenSystem::of(plane.parameters.family()),
            parameters: parameters(&plane.parameters),
            start: plane.start,
            control: plane.control,
            iterates: plane.iterates,
        }
    }
}

/// A computed plane under control.
#[derive(Clone, Debug, PartialEq)]
pub struct ControlMap {
    /// What was asked.
    pub plane: ControlPlane,
    /// What computed it.
    pub provenance: Provenance,
    /// One outcome per cell, row by row, first row = first y value.
    pub outcomes: Vec<Outcome>,
}

impl ControlMap {
    /// The motions that the cells reach, as a map; a cell's state is its point on σ.
    pub fn motions(&self) -> RegionMap {
        RegionMap {
            plane: self.plane.plane(),
            provenance: self.provenance.clone(),
            verdicts: self.outcomes.iter().map(|outcome| outcome.verdict).collect(),
            multipliers: None,
            extents: None,
        }
    }

    /// The configuration text that files carry: the plane and its provenance, as JSON.
    pub fn config(&self) -> String {
        self.provenance.configuration(&self.plane).to_string()
    }
}

/// Why a plane under control was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ControlPlaneError {
    /// Axes, parameters or the start cannot be used.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The schedule cannot be used.
    #[error(transparent)]
    Schedule(#[from] ControlScheduleError),
    /// A setting of the method cannot be used.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The method has no such setting.
    #[error("{method} has no setting {name} to be varied: choose another axis or another --control")]
    NoSuchSetting {
        /// The setting.
        name: &'static str,
        /// The method.
        method: &'static str,
    },
}
