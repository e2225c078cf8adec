//! Bifurcation diagrams: what is asked, what came out of every column, and where branches coexist.

mod coexistence;
mod error;
mod result;
mod spec;
mod sweep;
mod unit;
mod written;

pub use coexistence::{Coexistence, Pair};
pub use error::DiagramError;
pub use result::{Branch, Diagram};
pub use spec::DiagramSpec;
pub use sweep::{Direction, Sweep};
pub use unit::ExponentUnit;
