//! What was asked of two back ends: a plane, or a plane under control.

use impact_atlas::model::{Number, Setting};
use impact_atlas::plane::{Axis, Control, Plane, Quantity};
use serde::Serialize;

/// A plane, or a plane under control.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(untagged)]
pub enum Compared<'a> {
    /// A plane.
    Free(&'a Plane),
    /// A plane under control.
    Controlled(&'a Plane<Control>),
}

impl Compared<'_> {
    /// The axes, the horizontal one first.
    pub fn axes(&self) -> [&Axis; 2] {
        match self {
            Compared::Free(plane) => [&plane.x, &plane.y],
            Compared::Controlled(plane) => [&plane.x, &plane.y],
        }
    }

    /// The command that holds the two back ends against each other on one cell alone, and writes nothing.
    pub fn command(&self, column: u32, row: u32, candidate: &str) -> String {
        let [x, y] = self.axes();
        let varied = |quantity: Quantity| [x.quantity, y.quantity].contains(&quantity);
        let (method, parameters, start) = match self {
            Compared::Free(plane) => (String::new(), &plane.parameters, plane.start),
            Compared::Controlled(plane) => {
                let scheme = plane.task.scheme;
                let is_varied = |setting| varied(Quantity::Control(setting));
                let settings = scheme.options(plane.parameters.family(), &is_varied);
                (format!(" --control {}{settings}", scheme.method().name), &plane.parameters, plane.start)
            }
        };
        let family = parameters.family();
        let defaults = Setting::defaults(family);
        let system = if family.is_paper() { String::new() } else { format!(" --system {}", family.origin) };
        let sets: String = parameters
            .entries()
            .filter(|&(p, value)| !varied(Quantity::Parameter(p)) && value != defaults.get(p))
            .map(|(p, value)| format!(" --set {p}={}", Number(value)))
            .collect();
        let [x, y] = [one(x, column), one(y, row)];
        let lengths = self.lengths();
        format!(
            "impact-atlas validate{system}{method} --x {x} --y {y}{sets} --start={start} {lengths} {candidate}"
        )
    }

    /// The options that say how long a cell is followed.
    fn lengths(&self) -> String {
        match self {
            Compared::Free(plane) => {
                let schedule = plane.task;
                let fixed = if schedule.fixed_periods { " --fixed-periods" } else { "" };
                format!(
                    "--transient {} --observe {} --max-period {}{fixed}",
                    schedule.transient, schedule.observe, schedule.max_period
                )
            }
            Compared::Controlled(plane) => {
                let iterates = plane.task.schedule;
                format!(
                    "--from {} --iterates {} --max-period {}",
                    iterates.from, iterates.iterates, iterates.max_period
                )
            }
        }
    }
}

/// An axis with one of its values alone.
fn one(axis: &Axis, i: u32) -> String {
    let value = Number(axis.value(i));
    format!("{}={value}:{value}:1", axis.quantity.name())
}
