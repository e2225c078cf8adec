//! Several lanes in the registers of a processor.
//!
//! Nothing is called that is more than an instruction or two, and no closures: what is not compiled into its caller has no
//! instructions for the registers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{Lanes, Mask};
use super::registers::{Packed, Registers};

/// As many numbers of a precision as a register of the instruction set `S` holds.
///
/// They lie as a register does, on a boundary of its size: a load across two cache lines takes twice as long.
#[derive(Clone, Copy, Debug)]
pub struct Pack<S: Registers, T: Packed<S>> {
    simd: S,
    values: T::Numbers,
    _boundary: [S::Boundary; 0],
}

/// A truth value for each lane of a [`Pack`].
#[derive(Clone, Copy, Debug)]
pub struct PackMask<S: Registers, T: Packed<S>> {
    simd: S,
    values: T::Truths,
}

impl<S: Registers, T: Packed<S>> Pack<S, T> {
    /// Zero in every lane.
    #[inline(always)]
    pub fn zero(simd: S) -> Self {
        Pack { simd, values: T::splat(simd, T::zero()), _boundary: [] }
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident) => {
        impl<S: Registers, T: Packed<S>> $operator for Pack<S, T> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pack { values: <T as Packed<S>>::$method(self.simd, self.values, other.values), ..self }
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<S: Registers, T: Packed<S>> Neg for Pack<S, T> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Pack { values: <T as Packed<S>>::neg(self.simd, self.values), ..self }
    }
}

impl<S: Registers, T: Packed<S>> Lanes for Pack<S, T> {
    type Real = T;
    type Mask = PackMask<S, T>;
    const WIDTH: usize = <T as Packed<S>>::LANES;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Pack { values: T::splat(self.simd, T::of(value)), ..self }
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        let values = <T as Packed<S>>::times_plus(self.simd, self.values, factor.values, term.values);
        Pack { values, ..self }
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        Pack { values: <T as Packed<S>>::magnitude(self.simd, self.values), ..self }
    }

    #[inline(always)]
    fn root(self) -> Self {
        Pack { values: <T as Packed<S>>::root(self.simd, self.values), ..self }
    }

    #[inline(always)]
    fn below(self, other: Self) -> PackMask<S, T> {
        PackMask { simd: self.simd, values: <T as Packed<S>>::below(self.simd, self.values, other.values) }
    }

    #[inline(always)]
    fn select(mask: PackMask<S, T>, yes: Self, no: Self) -> Self {
        Pack { values: <T as Packed<S>>::select(yes.simd, mask.values, yes.values, no.values), ..yes }
    }

    /// One instruction on x86, which takes the second number where either is none, or both are zeros.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Pack { values: <T as Packed<S>>::max(self.simd, self.values, other.values), ..self }
    }

    /// See `larger`.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Pack { values: <T as Packed<S>>::min(self.simd, self.values, other.values), ..self }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> T {
        bytemuck::cast_slice::<T::Numbers, T>(std::slice::from_ref(&self.values))[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: T) {
        bytemuck::cast_slice_mut::<T::Numbers, T>(std::slice::from_mut(&mut self.values))[lane] = value;
    }
}

impl<S: Registers, T: Packed<S>> Mask for PackMask<S, T> {
    const WIDTH: usize = T::LANES;

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        PackMask { values: T::and(self.simd, self.values, other.values), ..self }
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        PackMask { values: T::or(self.simd, self.values, other.values), ..self }
    }

    #[inline(always)]
    fn not(self) -> Self {
        PackMask { values: T::not(self.simd, self.values), ..self }
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        T::bits(self.simd, self.values)
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, holds: bool) {
        let here = T::only(self.simd, lane);
        self.values = if holds {
            T::or(self.simd, self.values, here)
        } else {
            T::and(self.simd, self.values, T::not(self.simd, here))
        };
    }
}

#[cfg(test)]
mod tests;
