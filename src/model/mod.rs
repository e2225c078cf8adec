//! The system: its parameters, the equations of motion, and the constants of linear flight.

mod abreast;
mod at_frequency;
mod back;
mod between_stops;
mod bound;
mod by_flow;
mod common;
mod contact_normal;
mod driven;
mod economize;
mod equations;
#[cfg(test)]
mod example;
mod flight;
mod flights;
mod flow;
mod forced;
mod free_flight;
mod kick;
mod lanes;
mod line;
mod loads;
mod logarithm;
mod moored;
mod of_flow;
#[cfg(target_arch = "x86_64")]
mod pack;
#[cfg(target_arch = "x86_64")]
mod pair;
mod parameters;
mod quiet;
mod real;
#[cfg(target_arch = "x86_64")]
mod registers;
mod restopped;
mod row;
mod shared;
mod state;
mod step;
mod stops_along;
mod system;
mod system_error;
mod transition;
mod unit;
pub mod vector;
mod width;

pub use crate::system::{Number, joined, whole};
pub use crate::system::{Parameter, ParameterError, Setting};
pub use back::BACK_TERMS;
pub use bound::{Bound, OTHERS, others, sets_of_others};
pub use by_flow::ByFlow;
pub use contact_normal::{ContactNormal, FAR};
pub(crate) use equations::leave_no_room;
pub use equations::{Equations, are_parallel};
pub use flight::Flight;
pub use flights::Flights;
pub use forced::{ForcedResponse, Trap};
pub use line::Line;
pub use logarithm::{INVERSE_ODD, logarithm};
pub(crate) use of_flow::OfFlow;
pub use parameters::Parameters;
pub use quiet::Quiet;
pub use real::{Lanes, Mask, Real};
pub use row::Row;
pub use shared::Flows;
pub(crate) use state::{BOUND, are_bounded};
pub use state::{BOUNDLESS, State, StateVector};
pub use step::Step;
pub use stops_along::StopsAlong;
pub use system::System;
pub use system_error::SystemError;
pub(crate) use transition::{generator, transition};
pub(crate) use unit::{forced_by, unit};
pub use width::Width;
pub(crate) use width::{AnyWidth, AtWidth};
