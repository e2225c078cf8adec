//! What lies in the GPU's buffers: the shaders' declarations are written from what is declared here.
//!
//! Constants of a cell and of a controller are as long as its system has coordinates, normals and stops: those of flight are
//! written by one list of members, for either side, and the words of a controller are held to their declaration by a test.

#[macro_use]
mod declared;
mod control;
mod extent;
mod flight;
mod follow;
mod record;
#[cfg(test)]
mod tests;
mod trace;

pub use control::{
    ControlDispatch, ControlSchedule, Outcome, code, control_words, declaration_of_adapted,
    declaration_of_control,
};
pub use extent::{Extent, ExtentCode, ExtentDispatch};
pub use flight::{
    BACK_TERMS, CellConstants, KICK_TERMS, NORMAL_TERMS, write_cell, write_flight, write_kicks,
};
pub use follow::{Dispatch, NOT_MEASURED, Schedule, Verdict};
pub use record::FINISHED;
pub use trace::{Rebounds, Trace, TraceDispatch};

use rayon::prelude::*;

use super::followed::Followed;
use super::shader::Shape;
use crate::backend::Job;
use crate::model::{self, ByFlow};

/// The structs of one size that the shaders share, as they declare them.
pub const STRUCTS: [&str; 11] = [
    Schedule::WGSL,
    Dispatch::WGSL,
    Verdict::WGSL,
    Rebounds::WGSL,
    Trace::WGSL,
    TraceDispatch::WGSL,
    Extent::WGSL,
    ExtentDispatch::WGSL,
    ControlSchedule::WGSL,
    ControlDispatch::WGSL,
    Outcome::WGSL,
];

/// The structs `ContactNormal`, `Flight` and `Cell` as a shader of this shape declares them.
pub fn declarations_for(shape: &Shape) -> String {
    match shape.coordinates {
        1 => flight::declarations::<1>(shape),
        2 => flight::declarations::<2>(shape),
        3 => flight::declarations::<3>(shape),
        _ => flight::declarations::<4>(shape),
    }
}

/// Words of records one after the other, in the parts that threads wrote.
pub type Parts = Vec<Vec<u32>>;

/// What the shader reads of cells: the constants of their distinct flows and the polynomials of their impacts, and what each
/// cell has beside them.
pub struct Cells {
    pub flights: Parts,
    pub kicks: Parts,
    pub cells: Parts,
    /// The cells, those with the same flow beside each other: what lies beside each other is followed together, and reads
    /// the same constants.
    pub order: Vec<u32>,
}

/// Records that one thread writes at a time.
const CHUNK: usize = 256;

impl Cells {
    /// Prepares jobs, all of them with as many coordinates; the constants of a flow are computed once for all its cells.
    pub fn of<F: Followed>(jobs: &[F], by_flow: &ByFlow<'_>) -> Self {
        match jobs.first().map_or(1, |first| first.job().system.coordinates()) {
            1 => Cells::with::<1, F>(jobs, by_flow),
            2 => Cells::with::<2, F>(jobs, by_flow),
            3 => Cells::with::<3, F>(jobs, by_flow),
            _ => Cells::with::<4, F>(jobs, by_flow),
        }
    }

    fn with<const N: usize, F: Followed>(jobs: &[F], by_flow: &ByFlow<'_>) -> Self {
        // Constants are large: those of a flow are let go of once they are written.
        let flows = by_flow.distinct.par_chunks(CHUNK).map(|systems| {
            let (mut constants, mut kicks, mut stops) = (Vec::new(), Vec::new(), Vec::new());
            for system in systems {
                let flight = model::Flight::<f64, N>::new(system);
                stops.push((flight.stops(system), flight.forced));
                let rounded = flight.round::<f32>();
                write_flight(&rounded, &mut constants);
                write_kicks(&rounded, &mut kicks);
            }
            (constants, (kicks, stops))
        });
        let (flights, (kicks, stops)): (Parts, (Parts, Vec<_>)) = flows.unzip();
        let stops_of_flows = stops.concat();
        let cells = jobs.par_chunks(CHUNK).zip(by_flow.of_cell.par_chunks(CHUNK)).map(|(jobs, flows)| {
            let (mut words, mut stops) = (Vec::new(), Vec::new());
            for (Job { system, start }, &flow) in jobs.iter().map(F::job).zip(flows) {
                let (of_flow, forced) = &stops_of_flows[flow as usize];
                stops.clear();
                stops.extend(of_flow.iter().map(|along| along.with_values_of(system)));
                let unit = system.unit_of(*forced) as f32;
                write_cell::<N>(&CellConstants { flow, unit, stops: &stops, start }, &mut words);
            }
            words
        });
        let (cells, order) = rayon::join(|| cells.collect(), || by_flow.order());
        Cells { flights, kicks, cells, order }
    }
}
