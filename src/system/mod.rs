#![doc = include_str!("format.md")]

mod block;
mod builtin;
mod error;
mod expression;
mod family;
mod file;
mod limits;
mod mirror;
mod mooring;
mod named;
mod near;
mod number;
mod parameter;
mod plant;
mod plant_error;
mod setting;
mod sized;
mod stop_place;
mod stop_values;
mod stops;
mod struck;
mod table;

pub use builtin::{BUILTIN, Builtin, builtin};
pub use error::{CellError, CellFault, FamilyError, Place};
pub use expression::{ExpressionError, Fault};
pub use family::{DefaultPlane, Family, FamilyStop};
pub use mirror::Mirror;
pub use mooring::Mooring;
pub(crate) use named::named;
pub(crate) use near::near;
pub use number::{Number, joined, whole};
pub use parameter::{Bound, Parameter as ParameterRecord, ParameterError, ParameterId, Range};
pub use plant::Plant;
pub use plant_error::{Part, PlantError};
pub use setting::{MOST_PARAMETERS, PAPER, Parameter, Setting, StopParameters};
pub(crate) use sized::sized;
pub use stop_place::{Gap, StopPlace, Term};
pub(crate) use stops::own_coordinate;
pub use stops::{PlantStop, StopValues};

#[cfg(test)]
mod tests;
