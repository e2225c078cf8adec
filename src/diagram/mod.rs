//! Bifurcation diagrams: what is asked, what came out of every column, and where branches coexist.

mod axis;
mod coexistence;
mod result;
mod spec;
mod unit;
mod written;

pub use axis::SweepAxis;
pub use coexistence::{Coexistence, Pair};
pub use result::{Branch, Diagram};
pub use spec::{DiagramError, DiagramSpec, Direction, Sweep};
pub use unit::ExponentUnit;
