//! Placeholder of the dynamics.

mod recording;

pub use recording::{ImpactEvent, Recording, Sample, Stop, record};
