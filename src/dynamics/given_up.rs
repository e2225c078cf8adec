//! Why a recording ends before its time.

use thiserror::Error;

/// The most impacts of one recording.
pub(super) const MOST_IMPACTS: usize = 10_000_000;

/// A trajectory that was not followed to its end: the period in which it was given up, counted from 0 at its start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum GivenUp {
    /// Too many moves in forcing period after forcing period: rebounds that accumulate without end.
    #[error(
        "the trajectory was given up in forcing period {0}: it makes too many moves to come to its end; \
         less restitution, more damping or a faster forcing end rebounds sooner"
    )]
    Moves(u32),
    /// A motion that grows beyond all bounds.
    #[error(
        "the trajectory was given up in forcing period {0}: the motion grows without bounds; \
         more damping, or a start or forcing that is not as large, keeps it within them"
    )]
    Growth(u32),
    /// More impacts than are recorded.
    #[error(
        "the recording was given up in forcing period {0}: it holds more than {MOST_IMPACTS} impacts; \
         record fewer periods"
    )]
    Impacts(u32),
}
