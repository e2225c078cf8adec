//! How many moves a trajectory may make.

use super::trajectory::Event;

/// Moves beyond their share at which a trajectory is given up.
pub const MOST_MOVES: u32 = 1 << 24;

/// The share of moves in each forcing period. Where rebounds neither die out nor come to rest, as at r = 1 under a slow
/// force, there may be many more of them in every period; the trajectory is then given up after a few.
pub const FAIR_MOVES: u32 = 1 << 16;

/// Moves that a trajectory has made beyond its share of [`FAIR_MOVES`] in each forcing period.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moves(u32);

impl Moves {
    /// Moves in a forcing period after which a trajectory keeps others waiting.
    pub const MANY: u32 = 1 << 12;

    /// So many.
    #[inline(always)]
    pub fn counted(moves: u32) -> Self {
        Moves(moves)
    }

    /// How many.
    #[inline(always)]
    pub fn count(self) -> u32 {
        self.0
    }

    /// One more move.
    #[inline(always)]
    pub fn add(&mut self) {
        self.0 += 1;
    }

    /// Counts a move by what ended it: the end of a step and phase π are none, and phase 0 ends a forcing period.
    pub fn note<T>(&mut self, event: &Event<T>) {
        match event {
            Event::Strobe => self.pass_period(),
            Event::StepEnd | Event::HalfPeriod => {}
            _ => self.add(),
        }
    }

    /// Whether there was more than one. A strobe is a move: just after it, whether there were others since the last, or too many
    /// before.
    #[inline(always)]
    pub fn are_more_than_one(self) -> bool {
        self.0 > 1
    }

    /// A forcing period is over.
    #[inline(always)]
    pub fn pass_period(&mut self) {
        self.0 = self.0.saturating_sub(FAIR_MOVES);
    }

    /// Whether they are so many that the trajectory is followed by itself: others would wait for it.
    #[inline(always)]
    pub fn are_many(self) -> bool {
        self.0 > Self::MANY
    }

    /// Whether they are more than [`MOST_MOVES`].
    #[inline(always)]
    pub fn are_too_many(self) -> bool {
        self.0 > MOST_MOVES
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The forcing periods that a trajectory lasts with so many moves in each.
    fn lasts(moves: u32, periods: u32) -> u32 {
        let mut made = Moves::default();
        (0..periods)
            .find(|_| {
                (0..moves).for_each(|_| made.add());
                let over = made.are_too_many();
                made.pass_period();
                over
            })
            .unwrap_or(periods)
    }

    #[test]
    fn a_share_can_be_made_for_ever_and_more_only_for_a_while() {
        assert_eq!(lasts(FAIR_MOVES, 600), 600);
        assert_eq!(lasts(MOST_MOVES, 2), 1);
        assert_eq!(lasts(MOST_MOVES + 1, 2), 0);
        // Four shares too many in each period: MOST_MOVES is 256 shares.
        assert_eq!(lasts(5 * FAIR_MOVES, 600), 63);
    }
}
