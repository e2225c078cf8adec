//! The stages of a schedule.

use strum::VariantArray;

/// Where in its schedule a trajectory is; the codes of the GPU are generated from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, VariantArray)]
#[repr(u32)]
pub enum Stage {
    /// Before the observation.
    Transient = 0,
    /// Being observed.
    Observation = 1,
    /// Observed to the end.
    Observed = 2,
    /// Proven to stay off the stops for ever.
    Quiet = 3,
    /// Given up: a non-finite state, or too many moves in one period.
    Failed = 4,
}

impl Stage {
    /// Whether the trajectory is at its end.
    pub fn is_over(self) -> bool {
        matches!(self, Stage::Observed | Stage::Quiet | Stage::Failed)
    }
}
