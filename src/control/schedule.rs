//! How long a controlled trajectory is followed, in iterates on σ.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::memory::LONGEST;

/// When control is switched on, and how long the trajectory is followed; lengths in iterates on σ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ControlSchedule {
    /// The first iterate that is controlled.
    pub from: u32,
    /// Iterates altogether.
    pub iterates: u32,
    /// Whether all of them are run; otherwise a motion that has settled under control finishes early.
    pub fixed: bool,
    /// The largest number of iterates in one period of the motion that is looked for; with more it is unresolved, or
    /// whatever else a motion without a period is.
    #[serde(default = "ControlSchedule::usual_period")]
    pub max_period: u32,
}

impl ControlSchedule {
    /// The most iterates that are accepted.
    pub const LONGEST: u32 = 10_000_000;
    /// The fewest controlled iterates from which anything can be concluded.
    pub const SHORTEST: u32 = 16;

    /// The largest number of iterates in one period that is looked for unless something else is asked for.
    pub const MAX_PERIOD: u32 = 8;

    /// What files say that do not say it.
    const fn usual_period() -> u32 {
        Self::MAX_PERIOD
    }

    /// Checks the lengths.
    ///
    /// # Errors
    /// The length that cannot be used, with its bounds.
    pub fn check(&self) -> Result<(), ControlScheduleError> {
        let ControlSchedule { from, iterates, max_period, .. } = *self;
        if !(1..=LONGEST as u32).contains(&max_period) {
            return Err(ControlScheduleError::MaxPeriod(max_period));
        }
        if iterates > Self::LONGEST {
            return Err(ControlScheduleError::TooLong(iterates));
        }
        if iterates < from.saturating_add(Self::SHORTEST) {
            return Err(ControlScheduleError::TooShort { from, iterates });
        }
        Ok(())
    }

    /// The iterates at the end for which the motion is observed: half of those under control.
    pub fn observed(&self) -> u32 {
        ((self.iterates - self.from) / 2).max(1)
    }
}

/// Why a schedule was refused.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum ControlScheduleError {
    /// Too many iterates.
    #[error("{0} iterates are too many: at most {longest} are accepted", longest = ControlSchedule::LONGEST)]
    TooLong(u32),
    /// The largest period is 0 or too large.
    #[error("a largest period of {0} iterates cannot be looked for: give 1 to {LONGEST}")]
    MaxPeriod(u32),
    /// Too few iterates under control.
    #[error(
        "{iterates} iterates with control from iterate {from} are too few: give at least {shortest} more than {from}",
        shortest = ControlSchedule::SHORTEST
    )]
    TooShort {
        /// The first controlled iterate.
        from: u32,
        /// Iterates altogether.
        iterates: u32,
    },
}
