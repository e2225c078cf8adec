//! The plane: what is asked (axes, fixed parameters, start, schedule) and what came out of every cell.

mod axis;
mod controlled;
mod region_map;
mod spec;
mod start;

pub use axis::{Axis, AxisError, Component, Quantity};
pub use controlled::{ControlMap, ControlPlane, ControlPlaneError};
pub use region_map::{Multipliers, Provenance, RegionMap};
pub use spec::{Plane, PlaneError};
pub use start::{Start, StartError};
