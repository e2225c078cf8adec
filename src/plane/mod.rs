//! The plane: what is to be computed (axes, fixed parameters, start, what is asked of every cell) and what came out of every cell.

mod axis;
mod axis_error;
mod component;
mod connected;
mod error;
pub mod fields;
mod part;
mod quantity;
mod region_map;
mod some_cells;
mod spec;
mod start;
mod task;
mod window;
pub mod written;

pub use axis::Axis;
pub use axis_error::AxisError;
pub use component::Component;
pub use connected::{Adjacency, Cell, beside, connected};
pub use error::PlaneError;
pub use part::{Part, PartError, cost};
pub use quantity::Quantity;
pub use region_map::{Made, Multipliers, Provenance, RegionMap};
pub use spec::Plane;
pub use start::{Inadmissible, Start, StartError};
pub use task::{Control, Reached, Task};
pub use window::{Tiling, Window};
