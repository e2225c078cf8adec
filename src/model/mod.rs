//! The system: its parameters, the equations of motion (2), and the constants of linear flight.

mod drive;
mod flight;
pub(crate) mod generator;
mod number;
mod parameters;
mod real;
mod system;

pub use drive::Drive;
pub use flight::Flight;
pub use number::{Number, joined, whole};
pub use parameters::{Parameter, ParameterError, Parameters};
pub use real::Real;
pub use system::{System, SystemError};
