//! Diagrams as files carry them: names in place of stops and components, and the whole family.

use serde::{Serialize, Serializer};

use super::spec::DiagramSpec;
use super::sweep::Sweep;
use super::unit::ExponentUnit;
use crate::analysis::Schedule;
use crate::plane::written::{WrittenParameters, WrittenSystem, parameters};
use crate::plane::{Axis, Start};

/// A diagram as files carry it.
#[derive(Serialize)]
struct WrittenDiagram {
    x: Axis,
    system: WrittenSystem,
    parameters: WrittenParameters,
    sweep: Sweep,
    start: Start,
    probe: WrittenProbe,
    schedule: Schedule,
    capacity: u32,
    spectrum: Option<ExponentUnit>,
}

/// A quantity on a section, by their names in the family.
#[derive(Serialize)]
struct WrittenProbe {
    section: String,
    reading: String,
}

impl Serialize for DiagramSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let family = self.parameters.family();
        WrittenDiagram {
            x: self.x,
            system: WrittenSystem::of(family),
            parameters: parameters(&self.parameters),
            sweep: self.sweep,
            start: self.start,
            probe: WrittenProbe {
                section: self.probe.section.name(family).to_owned(),
                reading: self.probe.reading.name(family),
            },
            schedule: self.schedule,
            capacity: self.capacity,
            spectrum: self.spectrum,
        }
        .serialize(serializer)
    }
}
