//! The system: its parameters, equations of motion (2) and linear flight.

mod parameters;
mod system;

pub use parameters::{Parameter, ParameterError, Parameters};
pub use system::{System, SystemError};
