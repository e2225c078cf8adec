//! Systems: what a plant is.

mod plant;

pub use plant::{Plant, PlantStop};
