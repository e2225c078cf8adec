//! Where a controlled trajectory is in its schedule.

use strum::VariantArray;

/// Where a controlled trajectory is in its schedule; the codes of the GPU are generated from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, VariantArray)]
#[repr(u32)]
pub enum Progress {
    /// Not observed: before control, and while the controlled motion settles.
    Settling = 0,
    /// Observed, with a deviation carried along.
    Observed = 1,
    /// At the end of its schedule.
    Done = 2,
    /// σ was not reached any more.
    Lost = 3,
    /// Given up: a non-finite state, or too many moves in one period.
    Failed = 4,
    /// Control has driven the points on σ beyond all bounds.
    Runaway = 5,
}

impl Progress {
    /// Whether the trajectory is at its end.
    pub fn is_over(self) -> bool {
        !matches!(self, Progress::Settling | Progress::Observed)
    }
}
