//! How long a trajectory is followed, and what may end it early.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// How long a trajectory runs before and while it is observed; lengths in forcing periods.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Schedule {
    /// Forcing periods before the observation starts.
    pub transient: u32,
    /// Forcing periods of the observation.
    pub observe: u32,
    /// Largest N looked for in N-p-q.
    pub max_period: u32,
    /// Whether every cell runs `transient` + `observe` periods; otherwise a settled one finishes early, and so does
    /// one that is plainly chaotic after half its observation.
    pub fixed_periods: bool,
}

impl Schedule {
    /// The longest transient and the longest observation that are accepted, in forcing periods.
    pub const LONGEST: u32 = 100_000_000;
    /// The largest N that may be looked for.
    pub const LARGEST_PERIOD: u32 = 1024;

    /// Checks the lengths.
    ///
    /// # Errors
    /// The length that cannot be used, with its bounds.
    pub fn check(&self) -> Result<(), ScheduleError> {
        if self.transient > Self::LONGEST {
            return Err(ScheduleError::Transient(self.transient));
        }
        if !(1..=Self::LONGEST).contains(&self.observe) {
            return Err(ScheduleError::Observe(self.observe));
        }
        if !(1..=Self::LARGEST_PERIOD).contains(&self.max_period) {
            return Err(ScheduleError::MaxPeriod(self.max_period));
        }
        Ok(())
    }
}

/// Why a schedule was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum ScheduleError {
    /// The transient is too long.
    #[error("a transient of {0} forcing periods is too long: at most {longest} are accepted", longest = Schedule::LONGEST)]
    Transient(u32),
    /// The observation is empty or too long.
    #[error("an observation of {0} forcing periods cannot be used: give 1 to {longest}", longest = Schedule::LONGEST)]
    Observe(u32),
    /// The largest period is 0 or too large.
    #[error("a largest period of {0} cannot be used: give 1 to {largest}", largest = Schedule::LARGEST_PERIOD)]
    MaxPeriod(u32),
}
