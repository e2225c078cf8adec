//! What the time of a device's work goes into.

use std::ops::AddAssign;
use std::time::Instant;

use serde::Serialize;

/// Where time went, in seconds; of several tiles at a time, those of all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spent {
    /// Preparing the constants of cells, on the processor.
    pub preparing: f64,
    /// Bringing them to the adapter.
    pub transferring: f64,
    /// From handing a dispatch over until it is done and the list of what is unfinished is back; those of other tiles may have come
    /// before it.
    pub dispatching: f64,
    /// In the kernel itself, by the adapter's own clock; none where it offers none.
    pub kernel: Option<f64>,
    /// Reading the results back, and widening them.
    pub reading: f64,
    /// Dispatches.
    pub dispatches: u64,
}

impl AddAssign for Spent {
    fn add_assign(&mut self, other: Self) {
        self.preparing += other.preparing;
        self.transferring += other.transferring;
        self.dispatching += other.dispatching;
        self.kernel = match (self.kernel, other.kernel) {
            (None, None) => None,
            (a, b) => Some(a.unwrap_or(0.0) + b.unwrap_or(0.0)),
        };
        self.reading += other.reading;
        self.dispatches += other.dispatches;
    }
}

/// What a piece of work gives, and the seconds that it takes.
pub fn timed<R>(work: impl FnOnce() -> R) -> (R, f64) {
    let began = Instant::now();
    let result = work();
    (result, began.elapsed().as_secs_f64())
}
