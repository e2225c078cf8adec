//! The last points on σ, and whether they repeat.

use super::section_point::SectionPoint;
use crate::analysis::{
    INFINITELY_MANY,
    constants::{LEAST_RETURNS, RETURNED},
};
use crate::model::{Real, vector::MOST};

/// The largest number of iterates in one period of a controlled motion that can be looked for.
pub const LONGEST: usize = 32;

/// The same on a GPU, where every trajectory's memory is copied with each dispatch: software adapters take minutes to
/// compile a larger one.
pub const LONGEST_ON_DEVICE: usize = 8;

/// The longest delay.
pub const LONGEST_DELAY: usize = 8;

/// Points that are remembered: the present one and those that it is compared with.
pub const DEPTH: usize = LONGEST + 1;

/// Impacts at each stop, in the plant's order.
pub type Counts = [u32; MOST];

/// The last points on σ, the present one first, with what lay before each of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory<T, const N: usize> {
    /// The points, as corrected.
    pub points: [SectionPoint<T, N>; DEPTH],
    /// The forcing periods from the point before.
    pub turns: [T; DEPTH],
    /// Impacts at each stop since the point before, its own with them; [`INFINITELY_MANY`] with complete chatter.
    pub impacts: [Counts; DEPTH],
    /// The largest number of iterates in one period that is looked for.
    pub reach: u32,
    /// How many points have been taken in.
    pub seen: u32,
    /// For each period m − 1: the first iterate from which on every point lay within 1e-4 of the one m before.
    pub returning: [u32; LONGEST],
    /// The same within [`Real::AT_REST`], closely enough that a slow approach is not taken for a motion.
    pub settled: [u32; LONGEST],
}

impl<T: Real, const N: usize> Memory<T, N> {
    /// A memory of nothing, for periods of up to `reach` iterates.
    pub fn new(reach: u32) -> Self {
        Memory {
            reach: reach.clamp(1, LONGEST as u32),
            points: [SectionPoint::zero(); DEPTH],
            turns: [T::zero(); DEPTH],
            impacts: [[0; MOST]; DEPTH],
            seen: 0,
            returning: [0; LONGEST],
            settled: [0; LONGEST],
        }
    }

    /// Takes in the point of the present return; `unit` is what is of order one.
    pub fn push(&mut self, unit: T, point: SectionPoint<T, N>, turns: T, impacts: Counts) {
        let kept = (self.reach as usize).max(LONGEST_DELAY);
        for i in (1..=kept).rev() {
            self.points[i] = self.points[i - 1];
            self.turns[i] = self.turns[i - 1];
            self.impacts[i] = self.impacts[i - 1];
        }
        self.points[0] = point;
        self.turns[0] = turns;
        self.impacts[0] = impacts;
        self.seen += 1;
        for m in 1..=self.reach as usize {
            let away = if self.seen > m as u32 { point.away_from(&self.points[m], unit) } else { T::one() };
            if away > T::of(RETURNED) {
                self.returning[m - 1] = self.seen;
            }
            if away > T::of(T::AT_REST) {
                self.settled[m - 1] = self.seen;
            }
        }
    }

    /// Forgets that anything ever returned: what went before was under other rules.
    pub fn start_over(&mut self) {
        self.returning = [self.seen; LONGEST];
        self.settled = [self.seen; LONGEST];
    }

    /// The least period m whose points have kept returning for `proof` iterates, and at least `LEAST_RETURNS` times; 0 if none.
    pub fn period(&self, proof: u32) -> u32 {
        self.least(&self.returning, proof)
    }

    /// Whether the points have settled for `proof` iterates.
    pub fn is_settled(&self, proof: u32) -> bool {
        self.least(&self.settled, proof) > 0
    }

    fn least(&self, since: &[u32; LONGEST], proof: u32) -> u32 {
        for m in 1..=self.reach {
            let kept = self.seen - since[m as usize - 1];
            if kept >= proof && kept >= LEAST_RETURNS * m {
                return m;
            }
        }
        0
    }

    /// N and the impacts at each stop in one period of `period` iterates; N is the time in forcing periods, to the nearest
    /// whole number.
    pub fn counts(&self, period: u32) -> (u32, Counts) {
        let mut turns = T::zero();
        let mut impacts = [0; MOST];
        for i in 0..period as usize {
            turns = turns + self.turns[i];
            impacts = std::array::from_fn(|stop| added(impacts[stop], self.impacts[i][stop]));
        }
        ((turns + T::of(0.5)).floor().widen() as u32, impacts)
    }

    /// The point of one period that is the hardest impact, by the velocity into the stop that it has afterwards: which of
    /// them is met last says nothing.
    pub fn hardest(&self, period: u32, approach: impl Fn(&SectionPoint<T, N>) -> T) -> SectionPoint<T, N> {
        let mut hardest = self.points[0];
        for i in 1..period as usize {
            if approach(&self.points[i]) < approach(&hardest) {
                hardest = self.points[i];
            }
        }
        hardest
    }
}

/// The sum of two impact counts, either of which may be infinite.
pub fn added(a: u32, b: u32) -> u32 {
    let infinite = u32::from(INFINITELY_MANY);
    if a == infinite || b == infinite { infinite } else { (a + b).min(infinite - 1) }
}
