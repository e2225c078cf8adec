//! What lies in the GPU's buffers, byte for byte as the shaders declare it.

mod control;
mod flight;
mod follow;
mod record;
#[cfg(test)]
mod tests;
mod trace;

pub use control::{
    CONTROLLED_BYTES, Control, ControlDispatch, ControlSchedule, METHOD_DELAY, METHOD_NONE, METHOD_PULSE,
    METHOD_SINE, Outcome,
};
pub use flight::{Flight, KICK_TERMS, Kick};
pub use follow::{Dispatch, NOT_MEASURED, OBSERVER_BYTES, Schedule, Verdict};
pub use record::Record;
pub use trace::{Trace, TraceDispatch};
