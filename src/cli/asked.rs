//! What was asked of two back ends: a plane, or a plane under control.

use impact_atlas::model::{Parameter, Parameters};
use impact_atlas::plane::{Axis, ControlPlane, Plane};
use serde::Serialize;

use super::controlled;

/// A plane, or a plane under control.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
pub enum Asked<'a> {
    /// A plane.
    Free(&'a Plane),
    /// A plane under control.
    Controlled(&'a ControlPlane),
}

impl Asked<'_> {
    /// The axes, the horizontal one first.
    pub fn axes(&self) -> [&Axis; 2] {
        match self {
            Asked::Free(plane) => [&plane.x, &plane.y],
            Asked::Controlled(plane) => [&plane.x, &plane.y],
        }
    }

    /// The command that computes a cell alone.
    pub fn command(&self, column: u32, row: u32, backend: &str) -> String {
        match self {
            Asked::Free(plane) => classify(plane, column, row, backend),
            Asked::Controlled(plane) => controlled::command(plane, column, row, backend),
        }
    }
}

/// The command that follows a cell's trajectory alone.
fn classify(plane: &Plane, column: u32, row: u32, backend: &str) -> String {
    let parameters = plane.parameters_at(column, row);
    let named = |p: Parameter| matches!(p, Parameter::Omega | Parameter::Delta);
    let sets: String = Parameter::ALL
        .into_iter()
        .filter(|&p| named(p) || parameters.get(p) != Parameters::default().get(p))
        .map(|p| format!(" --set {p}={}", parameters.get(p)))
        .collect();
    let schedule = plane.schedule;
    let fixed = if schedule.fixed_periods { " --fixed-periods" } else { "" };
    format!(
        "impact-atlas classify{sets} --start {} --transient {} --observe {} --max-period {}{fixed} {backend} --json",
        plane.start_at(column, row),
        schedule.transient,
        schedule.observe,
        schedule.max_period
    )
}
