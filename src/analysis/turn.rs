//! The largest multiplier of a settled motion, from the linear map of one turn.
//!
//! A tangent vector that is carried along for many periods tells the exponent only as far as it has aligned, and a pair of
//! complex multipliers lets it sway. A motion that has settled repeats: unit vectors carried through one turn each are the
//! columns of its monodromy matrix, whose powers grow as its largest multiplier does. Of a motion that returns and comes closer
//! the same matrix says where it goes.

use pulp::NullaryFnOnce;

use super::recurrence::FARTHEST;
use crate::dynamics::Tangent;
use crate::model::{Real, State};

/// How often the matrix is squared: what its norm differs from that of its largest multiplier's power by is then divided
/// by 2¹⁶.
pub const SQUARINGS: u32 = 16;

/// What stands for the exponent −∞ of a motion that every deviation dies out on within a few turns: a kernel has no infinity.
pub const FORGETS: f64 = -2e38;
/// What stands for the exponent of a deviation that grew beyond all bounds.
pub const EXPLODES: f64 = 2e38;

/// An exponent as it is reported.
pub fn reported(exponent: f32) -> f32 {
    if exponent == FORGETS as f32 { f32::NEG_INFINITY } else { exponent }
}

/// The monodromy matrix of a motion of N coordinates, column by column, as turns complete it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn<T, const N: usize> {
    /// The forcing periods of a turn; 0 where none is measured.
    pub n: u32,
    /// What becomes of a unit displacement of each coordinate …
    x: [State<T, N>; N],
    /// … and of a unit velocity.
    v: [State<T, N>; N],
    /// The largest Lyapunov exponent per forcing period, once all columns are there.
    pub exponent: T,
    /// How far the state was from its anchor before the last leap.
    pub missed: T,
}

impl<T: Real, const N: usize> Turn<T, N> {
    /// The turns in which all columns are measured.
    pub const COLUMNS: u32 = 2 * N as u32;

    /// Nothing to be measured.
    pub fn none() -> Self {
        Turn::over(0)
    }

    /// To be measured, over `n` forcing periods.
    pub fn over(n: u32) -> Self {
        Turn {
            n,
            x: [State::zero(); N],
            v: [State::zero(); N],
            exponent: T::of(EXPLODES),
            missed: T::of(FARTHEST),
        }
    }

    /// Whether it is measured.
    #[inline(always)]
    pub fn is_measured(&self) -> bool {
        self.n > 0
    }

    /// The deviation that is carried through the turn after `turns` others.
    pub fn begins_with(turns: u32) -> Tangent<T, N> {
        let unit = |i: u32| if i == turns { T::one() } else { T::zero() };
        Tangent(State {
            x: std::array::from_fn(|i| unit(i as u32)),
            v: std::array::from_fn(|i| unit((N + i) as u32)),
        })
    }

    /// Sees the tangent vector after `turns` ≥ 1 turns.
    pub fn complete(&mut self, turns: u32, tangent: &Tangent<T, N>) {
        let column = turns as usize - 1;
        if column < N {
            self.x[column] = tangent.0;
        } else if column < 2 * N {
            self.v[column - N] = tangent.0;
        }
        if turns == Self::COLUMNS {
            self.exponent = T::fused(Measured(self));
        }
    }

    /// ln of the spectral radius over n: the limit of ln ‖Mᵏ‖ / (kn).
    #[inline(always)]
    fn measured(&self) -> T {
        if !self.x.iter().chain(&self.v).all(State::is_finite) {
            return T::of(EXPLODES);
        }
        let mut power = *self;
        let mut sum = T::zero();
        let mut share = T::one();
        for _ in 0..=SQUARINGS {
            let size = power.largest();
            let factor = T::one() / size;
            // A long turn may leave nothing that is a number.
            if !factor.is_finite() {
                return T::of(FORGETS);
            }
            sum = sum + share * size.logarithm();
            power = power.scaled(factor);
            power = power.squared();
            share = T::of(0.5) * share;
        }
        sum / T::of(f64::from(self.n))
    }

    /// Where a deviation that is added to itself, turned once, turned twice and so on ends: Σ Mᵏ y, the more terms of it at a
    /// time as the matrix is squared. Of use where its powers die out.
    pub fn followed_for_ever(&self, y: &State<T, N>) -> State<T, N> {
        T::fused(Followed(self, y))
    }

    #[inline(always)]
    fn summed(&self, y: &State<T, N>) -> State<T, N> {
        let (mut power, mut sum) = (*self, *y);
        for _ in 0..=SQUARINGS {
            sum = sum.added(&power.applied(&sum));
            if power.largest() < T::of(T::EPSILON) {
                break;
            }
            power = power.squared();
        }
        sum
    }

    /// The largest magnitude of an entry.
    #[inline(always)]
    fn largest(&self) -> T {
        let mut largest = T::zero();
        for column in self.x.iter().chain(&self.v) {
            for i in 0..2 * N {
                let size = column.get(i).abs();
                largest = if size > largest { size } else { largest };
            }
        }
        largest
    }

    #[inline(always)]
    fn scaled(&self, factor: T) -> Self {
        let mut scaled = *self;
        for i in 0..N {
            (scaled.x[i], scaled.v[i]) = (self.x[i].scaled(factor), self.v[i].scaled(factor));
        }
        scaled
    }

    #[inline(always)]
    fn squared(&self) -> Self {
        let mut squared = *self;
        for i in 0..N {
            (squared.x[i], squared.v[i]) = (self.applied(&self.x[i]), self.applied(&self.v[i]));
        }
        squared
    }

    /// The matrix times a vector.
    #[inline(always)]
    fn applied(&self, to: &State<T, N>) -> State<T, N> {
        let mut sum = self.x[0].scaled(to.x[0]);
        for i in 1..N {
            sum = sum.plus(to.x[i], &self.x[i]);
        }
        for i in 0..N {
            sum = sum.plus(to.v[i], &self.v[i]);
        }
        sum
    }
}

/// See [`Turn::measured`]; types of their own, since what a closure does is not compiled with the instructions that
/// [`Real::fused`] asks for.
struct Measured<'a, T, const N: usize>(&'a Turn<T, N>);

impl<T: Real, const N: usize> NullaryFnOnce for Measured<'_, T, N> {
    type Output = T;

    #[inline(always)]
    fn call(self) -> T {
        self.0.measured()
    }
}

/// See [`Turn::followed_for_ever`].
struct Followed<'a, T, const N: usize>(&'a Turn<T, N>, &'a State<T, N>);

impl<T: Real, const N: usize> NullaryFnOnce for Followed<'_, T, N> {
    type Output = State<T, N>;

    #[inline(always)]
    fn call(self) -> State<T, N> {
        self.0.summed(self.1)
    }
}

#[cfg(test)]
mod tests;
