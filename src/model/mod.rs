//! The system: its parameters, the equations of motion, and the constants of linear flight.

mod abreast;
mod drive;
mod equations;
mod flight;
mod flow;
mod forced;
mod lanes;
mod line;
mod pack;
mod parameters;
mod real;
mod shared;
mod state;
mod system;
pub mod vector;

pub use crate::system::{Number, joined, whole};
pub use crate::system::{Parameter, ParameterError, Setting};
pub use drive::Drive;
pub use equations::{Equations, are_parallel};
pub use flight::{ContactNormal, FAR, Flight, Quiet};
pub use forced::{ForcedResponse, Trap};
pub use line::Line;
pub use pack::{Pack, Twin};
pub use parameters::Parameters;
pub use real::{Lanes, Mask, Real};
pub use shared::Flights;
pub use state::{State, StateVector};
pub use system::{System, SystemError};
