//! The stages of a schedule.

/// Where in its schedule a trajectory is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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

    /// Every stage, in the order of the codes that the GPU gets generated from here.
    pub const ALL: [Stage; 5] =
        [Stage::Transient, Stage::Observation, Stage::Observed, Stage::Quiet, Stage::Failed];
}
