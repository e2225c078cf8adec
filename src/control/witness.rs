//! What is heard of a controlled trajectory: its moves, and its returns to σ.

use super::section::Section;
use crate::dynamics::{Move, Trajectory};
use crate::model::Flight;

/// What happened at one return to σ; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return<T> {
    /// The iterate n: 0 at the first return.
    pub iterate: u32,
    /// The point as it arrived, F(X(n−1)).
    pub arrived: Section<T>,
    /// The point as corrected, X(n).
    pub section: Section<T>,
    /// The control signal: B, or the length of the correction that was wanted.
    pub signal: T,
    /// Whether the correction was left out because it led off the section.
    pub escaped: bool,
    /// Impacts at Ā since the last return; [`INFINITELY_MANY`](crate::analysis::INFINITELY_MANY) with complete chatter.
    pub at_b: u32,
    /// Forcing periods since the last return.
    pub turns: T,
}

/// Hears how a controlled trajectory goes on.
pub trait Witness<T, D> {
    /// A move went from `before` to `after`; where it met σ, control has yet to act.
    #[inline(always)]
    fn moved(
        &mut self,
        flight: &Flight<T, 2>,
        before: &Trajectory<T, 2, D>,
        taken: &Move<T>,
        after: &Trajectory<T, 2, D>,
    ) {
        let _ = (flight, before, taken, after);
    }

    /// σ was met, and control has acted.
    #[inline(always)]
    fn returned(&mut self, met: &Return<T>) {
        let _ = met;
    }
}

/// Nobody hears.
impl<T, D> Witness<T, D> for () {}
