//! How long a controlled trajectory is followed, in iterates on σ.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// When control is switched on, and how long the trajectory is followed; lengths in iterates on σ.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ControlSchedule {
    /// The first iterate that is controlled.
    pub from: u32,
    /// Iterates altogether.
    pub iterates: u32,
    /// Whether all of them are run; otherwise a motion that has settled under control finishes early.
    pub fixed: bool,
}

impl ControlSchedule {
    /// The most iterates that are accepted.
    pub const LONGEST: u32 = 10_000_000;
    /// The fewest controlled iterates from which anything can be concluded.
    pub const SHORTEST: u32 = 16;

    /// Checks the lengths.
    ///
    /// # Errors
    /// The length that cannot be used, with its bounds.
    pub fn check(&self) -> Result<(), ControlScheduleError> {
        let ControlSchedule { from, iterates, .. } = *self;
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
