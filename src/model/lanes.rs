//! One lane: a plain number, and its truth value.

use super::real::{Lanes, Mask};

impl Mask for bool {
    const WIDTH: usize = 1;

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

    #[inline(always)]
    fn set_lane(&mut self, _: usize, holds: bool) {
        *self = holds;
    }
}

macro_rules! one_lane {
    ($real:ty, $times_plus:expr) => {
        impl Lanes for $real {
            type Real = $real;
            type Mask = bool;
            const WIDTH: usize = 1;

            #[inline(always)]
            fn all(self, value: f64) -> Self {
                value as $real
            }

            #[inline(always)]
            fn times_plus(self, factor: Self, term: Self) -> Self {
                $times_plus(self, factor, term)
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

one_lane!(f64, f64::mul_add);
one_lane!(f32, rounded_twice);

#[inline(always)]
fn rounded_twice(a: f32, factor: f32, term: f32) -> f32 {
    a * factor + term
}
