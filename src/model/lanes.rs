//! Numbers of several trajectories side by side, and the one-lane case: a plain number.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::Real;

/// Numbers side by side, one in each lane, that one operation works on together.
///
/// What is written for lanes gives the same bits in every lane at every width: each operation is exact or rounded once, and
/// nothing is summed across lanes. A [`Real`] is one lane.
pub trait Lanes:
    Copy
    + Debug
    + Send
    + Sync
    + 'static
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// The precision of each lane.
    type Real: Real;
    /// A truth value for each lane.
    type Mask: Mask;
    /// How many lanes there are.
    const WIDTH: usize;

    /// The number nearest to `value` in every lane.
    #[must_use]
    fn all(self, value: f64) -> Self;

    /// self · factor + term, rounded twice: so the bits do not depend on whether a processor multiplies and adds at once.
    #[inline(always)]
    #[must_use]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        self * factor + term
    }

    /// |self|.
    #[must_use]
    fn magnitude(self) -> Self;

    /// √self.
    #[must_use]
    fn root(self) -> Self;

    /// self < other; false where either is not a number.
    fn below(self, other: Self) -> Self::Mask;

    /// `yes` where the mask holds, `no` elsewhere.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The number in one lane.
    fn lane(&self, lane: usize) -> Self::Real;

    /// Puts a number into one lane.
    fn set_lane(&mut self, lane: usize, value: Self::Real);

    /// The larger of two numbers; `other` where self is not a number.
    #[inline(always)]
    #[must_use]
    fn larger(self, other: Self) -> Self {
        Self::select(other.below(self), self, other)
    }

    /// The smaller of two numbers; `other` where self is not a number.
    #[inline(always)]
    #[must_use]
    fn smaller(self, other: Self) -> Self {
        Self::select(self.below(other), self, other)
    }
}

/// A truth value for each lane.
pub trait Mask: Copy + Debug {
    /// Where both hold.
    #[must_use]
    fn and(self, other: Self) -> Self;

    /// Where either holds.
    #[must_use]
    fn or(self, other: Self) -> Self;

    /// Where it does not hold.
    #[must_use]
    fn not(self) -> Self;

    /// Bit k for lane k.
    fn bits(self) -> u32;
}

impl Mask for bool {
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self & other
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self | other
    }

    #[inline(always)]
    fn not(self) -> Self {
        !self
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        u32::from(self)
    }
}

macro_rules! one_lane {
    ($real:ty) => {
        impl Lanes for $real {
            type Real = $real;
            type Mask = bool;
            const WIDTH: usize = 1;

            #[inline(always)]
            fn all(self, value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            fn magnitude(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn below(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn select(mask: bool, yes: Self, no: Self) -> Self {
                if mask { yes } else { no }
            }

            #[inline(always)]
            fn lane(&self, _: usize) -> Self {
                *self
            }

            #[inline(always)]
            fn set_lane(&mut self, _: usize, value: Self) {
                *self = value;
            }
        }
    };
}

one_lane!(f64);
one_lane!(f32);
