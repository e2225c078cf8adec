//! Twice as many lanes: while one half waits for what it computes, a processor computes with the other.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{Lanes, Mask};

/// The lanes of two, those of the first before those of the second.
#[derive(Clone, Copy, Debug)]
pub struct Pair<P>([P; 2]);

impl<P: Copy> Pair<P> {
    /// The same in either half.
    #[inline(always)]
    pub fn both(half: P) -> Self {
        Pair([half; 2])
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<P: Lanes> $operator for Pair<P> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pair([self.0[0].$method(other.0[0]), self.0[1].$method(other.0[1])])
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<P: Lanes> Neg for Pair<P> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Pair([-self.0[0], -self.0[1]])
    }
}

impl<P: Lanes> Lanes for Pair<P> {
    type Real = P::Real;
    type Mask = Pair<P::Mask>;
    const WIDTH: usize = 2 * P::WIDTH;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Pair::both(self.0[0].all(value))
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        let [a, b] = self.0;
        Pair([a.times_plus(factor.0[0], term.0[0]), b.times_plus(factor.0[1], term.0[1])])
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        Pair([self.0[0].magnitude(), self.0[1].magnitude()])
    }

    #[inline(always)]
    fn root(self) -> Self {
        Pair([self.0[0].root(), self.0[1].root()])
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        Pair([self.0[0].below(other.0[0]), self.0[1].below(other.0[1])])
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Pair([P::select(mask.0[0], yes.0[0], no.0[0]), P::select(mask.0[1], yes.0[1], no.0[1])])
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Pair([self.0[0].larger(other.0[0]), self.0[1].larger(other.0[1])])
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Pair([self.0[0].smaller(other.0[0]), self.0[1].smaller(other.0[1])])
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> P::Real {
        self.0[lane / P::WIDTH].lane(lane % P::WIDTH)
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: P::Real) {
        self.0[lane / P::WIDTH].set_lane(lane % P::WIDTH, value);
    }
}

impl<M: Mask> Mask for Pair<M> {
    const WIDTH: usize = 2 * M::WIDTH;

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        Pair([self.0[0].and(other.0[0]), self.0[1].and(other.0[1])])
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        Pair([self.0[0].or(other.0[0]), self.0[1].or(other.0[1])])
    }

    #[inline(always)]
    fn not(self) -> Self {
        Pair([self.0[0].not(), self.0[1].not()])
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.0[0].bits() | self.0[1].bits() << M::WIDTH
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, holds: bool) {
        self.0[lane / M::WIDTH].set_lane(lane % M::WIDTH, holds);
    }
}
