//! Systems: plants, and the families that describe them.
mod mirror;
mod plant;
mod plant_error;
mod stops;

pub use mirror::Mirror;
pub use plant::{Plant, PlantStop};
pub use plant_error::{Part, PlantError};

#[cfg(test)]
mod tests;
