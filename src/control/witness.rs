//! What is told of a controlled trajectory: its moves, and its returns to σ.

use super::memory::Counts;
use super::values::SectionValues;
use crate::dynamics::{Move, Stop, Trajectory};
use crate::model::{Flight, Real};

/// What happened at one return to σ; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Return<T> {
    /// The iterate n: 0 at the first return.
    pub iterate: u32,
    /// The stop on whose section it is.
    pub stop: Stop,
    /// The point as it arrived, F(X(n−1)).
    pub arrived: SectionValues<T>,
    /// The point as corrected, X(n).
    pub section: SectionValues<T>,
    /// d·v+ as corrected, as an [`Impact`](crate::dynamics::Impact) at this stop has it.
    pub velocity: T,
    /// The control signal: B, or the length of the correction that was wanted.
    pub signal: T,
    /// Whether the correction was left out because it led off the section.
    pub escaped: bool,
    /// Impacts at each stop since the last return, in the plant's order and this one with them;
    /// [`INFINITELY_MANY`](crate::analysis::INFINITELY_MANY) with complete chatter.
    pub impacts: Counts,
    /// Forcing periods since the last return.
    pub turns: T,
}

/// Is told of a controlled trajectory's moves and returns, whatever its number of coordinates.
pub trait Witness<T: Real> {
    /// A move of a trajectory of N coordinates, in the M that are flown with a force, went from `before` to `after`; where it
    /// met σ, control has yet to act.
    #[inline(always)]
    fn moved<const N: usize, const M: usize>(
        &mut self,
        flight: &Flight<T, M>,
        before: &Trajectory<T, M>,
        taken: &Move<T>,
        after: &Trajectory<T, M>,
    ) {
        let _ = (flight, before, taken, after);
    }

    /// σ was met, and control has acted.
    #[inline(always)]
    fn returned(&mut self, met: &Return<T>) {
        let _ = met;
    }
}

/// Control that is not watched: what happens is noted nowhere.
impl<T: Real> Witness<T> for () {}
