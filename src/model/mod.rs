//! The system: its parameters, the equations of motion, and the constants of linear flight.

mod abreast;
mod contact_normal;
mod drive;
mod equations;
mod flight;
mod flow;
mod forced;
mod lanes;
mod line;
mod logarithm;
mod pack;
mod parameters;
mod quiet;
mod real;
mod shared;
mod state;
mod system;
mod system_error;
pub mod vector;

pub use crate::system::{Number, joined, whole};
pub use crate::system::{Parameter, ParameterError, Setting};
pub use contact_normal::{ContactNormal, FAR};
pub use drive::Drive;
pub use equations::{Equations, are_parallel};
pub use flight::Flight;
pub use forced::{ForcedResponse, Trap};
pub use line::Line;
pub use logarithm::{INVERSE_ODD, logarithm};
pub use pack::{Pack, Twin};
pub use parameters::Parameters;
pub use quiet::Quiet;
pub use real::{Lanes, Mask, Real};
pub use shared::Flights;
pub use state::{State, StateVector};
pub use system::System;
pub use system_error::SystemError;
