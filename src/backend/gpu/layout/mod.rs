//! What lies in the GPU's buffers, byte for byte as the shaders declare it.

mod control;
mod extent;
mod flight;
mod follow;
mod record;
#[cfg(test)]
mod tests;
mod trace;

pub use control::{
    Control, ControlDispatch, ControlSchedule, METHOD_DELAY, METHOD_NONE, METHOD_PULSE, METHOD_SINE, Outcome,
};
pub use extent::{Extent, ExtentDispatch};
pub use flight::{KICK_TERMS, write_flight, write_kicks};
pub use follow::{Dispatch, NOT_MEASURED, Schedule, Verdict};
pub use record::Record;
pub use trace::{Trace, TraceDispatch};

use super::shader::Shape;
use crate::backend::Job;
use crate::model;

/// The structs `ContactNormal` and `Flight` as a shader of this shape declares them.
pub fn declarations_for(shape: &Shape) -> String {
    match shape.coordinates {
        1 => flight::declarations::<1>(shape),
        2 => flight::declarations::<2>(shape),
        3 => flight::declarations::<3>(shape),
        _ => flight::declarations::<4>(shape),
    }
}

/// The constants of one cell as the shader reads them: of flight, of kicks, and its start.
pub struct Cell {
    pub flight: Vec<u32>,
    pub kicks: Vec<u32>,
    pub start: Vec<f32>,
}

impl Cell {
    /// Prepares a job.
    pub fn of(job: &Job) -> Self {
        match job.system.plant().n {
            1 => Cell::with::<1>(job),
            2 => Cell::with::<2>(job),
            3 => Cell::with::<3>(job),
            _ => Cell::with::<4>(job),
        }
    }

    fn with<const N: usize>(job: &Job) -> Self {
        let constants = model::Flight::<f64, N>::new(&job.system).round::<f32>();
        let (mut flight, mut kicks) = (Vec::new(), Vec::new());
        write_flight(&constants, &mut flight);
        write_kicks(&constants, &mut kicks);
        Cell { flight, kicks, start: job.start.iter().map(|&value| value as f32).collect() }
    }
}
