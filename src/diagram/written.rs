//! Diagrams as files carry them: names in place of stops and components, and the whole family.

use serde::{Serialize, Serializer};

use super::axis::SweepAxis;
use super::spec::DiagramSpec;
use super::sweep::Sweep;
use super::unit::ExponentUnit;
use crate::analysis::Schedule;
use crate::plane::Start;
use crate::plane::written::{WrittenParameters, WrittenSystem, parameters};

/// A diagram as files carry it.
#[derive(Clone, Debug, Serialize)]
struct WrittenDiagram {
    x: SweepAxis,
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
#[derive(Clone, Debug, Serialize)]
struct WrittenProbe {
    section: String,
    reading: String,
}

impl From<DiagramSpec> for WrittenDiagram {
    fn from(spec: DiagramSpec) -> Self {
        let family = spec.parameters.family();
        WrittenDiagram {
            x: spec.x,
            system: WrittenSystem::of(family),
            parameters: parameters(&spec.parameters),
            sweep: spec.sweep,
            start: spec.start,
            probe: WrittenProbe {
                section: spec.probe.section.name(family).to_owned(),
                reading: spec.probe.reading.name(family),
            },
            schedule: spec.schedule,
            capacity: spec.capacity,
            spectrum: spec.spectrum,
        }
    }
}

impl Serialize for DiagramSpec {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        WrittenDiagram::from(self.clone()).serialize(serializer)
    }
}
