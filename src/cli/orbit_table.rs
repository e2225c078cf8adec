//! The tables of an orbit: which components of the state they have.

use impact_atlas::dynamics::ImpactEvent;
use impact_atlas::model::System;
use impact_atlas::plane::Component;
use impact_atlas::system::Family;
use serde::Serialize;

/// The columns of the tables: components by their names and their places in a state.
#[derive(Debug)]
pub struct Columns {
    components: Vec<Component>,
    /// Those that do not follow from the stop at an impact.
    at_impacts: Vec<Component>,
}

impl Columns {
    /// Those of a family.
    pub fn of(family: &Family) -> Self {
        let known = family.struck_coordinate();
        let components: Vec<Component> = Component::all(family.n()).collect();
        let at_impacts = components.iter().copied().filter(|component| Some(component.coordinate()) != known);
        Columns { at_impacts: at_impacts.collect(), components }
    }

    /// The columns of the table of impacts.
    pub fn of_impacts(&self) -> Vec<&'static str> {
        let components = self.at_impacts.iter().map(|component| component.name());
        let first = ["time", "stop", "velocity_before", "velocity_after"].into_iter();
        first.chain(components).chain(["phase"]).collect()
    }

    /// The columns of the table of the trajectory.
    pub fn of_trajectory(&self) -> Vec<&'static str> {
        ["time"].into_iter().chain(self.components.iter().map(|component| component.name())).collect()
    }

    /// A row of the table of impacts.
    pub fn row(&self, impact: &ImpactEvent, system: &System) -> impl Serialize + use<> {
        let stop = system.stop_name(impact.stop.index());
        let components: Vec<f64> = self.at_impacts.iter().map(|c| impact.state[c.index()]).collect();
        // A speed of -0 is 0.
        let [before, after] = [impact.velocity_before, impact.velocity_after].map(|speed| speed + 0.0);
        (impact.time, stop, before, after, components, impact.phase)
    }
}
