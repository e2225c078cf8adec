//! Several lanes of f64 in the registers of a processor.
//!
//! Of `pulp`, only methods that are one instruction are called, and no closures: what is not compiled into its caller has no
//! instructions for the registers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{Lanes, Mask};
use super::registers::Registers;

/// As many f64 as a register of the instruction set `S` holds.
///
/// They lie as a register does, on a boundary of its size: a load across two cache lines takes twice as long.
#[derive(Clone, Copy, Debug)]
pub struct Pack<S: Registers> {
    simd: S,
    values: S::f64s,
    _boundary: [S::Boundary; 0],
}

/// A truth value for each lane of a [`Pack`].
#[derive(Clone, Copy, Debug)]
pub struct PackMask<S: Registers> {
    simd: S,
    values: S::m64s,
}

impl<S: Registers> Pack<S> {
    /// Zero in every lane.
    #[inline(always)]
    pub fn zero(simd: S) -> Self {
        Pack { simd, values: simd.splat_f64s(0.0), _boundary: [] }
    }
}

macro_rules! operator {
    ($operator:ident, $method:ident, $of:ident) => {
        impl<S: Registers> $operator for Pack<S> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Pack { values: self.simd.$of(self.values, other.values), ..self }
            }
        }
    };
}

operator!(Add, add, add_f64s);
operator!(Sub, sub, sub_f64s);
operator!(Mul, mul, mul_f64s);
operator!(Div, div, div_f64s);

impl<S: Registers> Neg for Pack<S> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Pack { values: self.simd.xor_f64s(self.values, self.simd.splat_f64s(-0.0)), ..self }
    }
}

impl<S: Registers> Lanes for Pack<S> {
    type Real = f64;
    type Mask = PackMask<S>;
    const WIDTH: usize = S::F64_LANES;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Pack { values: self.simd.splat_f64s(value), ..self }
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Pack { values: self.simd.mul_add_f64s(self.values, factor.values, term.values), ..self }
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        let but_sign = self.simd.splat_f64s(f64::from_bits(u64::MAX >> 1));
        Pack { values: self.simd.and_f64s(self.values, but_sign), ..self }
    }

    #[inline(always)]
    fn root(self) -> Self {
        Pack { values: self.simd.sqrt_f64s(self.values), ..self }
    }

    #[inline(always)]
    fn below(self, other: Self) -> PackMask<S> {
        PackMask { simd: self.simd, values: self.simd.less_than_f64s(self.values, other.values) }
    }

    #[inline(always)]
    fn select(mask: PackMask<S>, yes: Self, no: Self) -> Self {
        let [yes_bits, no_bits] = [bytemuck::cast(yes.values), bytemuck::cast(no.values)];
        Pack { values: bytemuck::cast(yes.simd.select_u64s(mask.values, yes_bits, no_bits)), ..yes }
    }

    /// One instruction on x86, which takes the second number where either is none, or both are zeros.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Pack { values: self.simd.max_f64s(self.values, other.values), ..self }
    }

    /// See `larger`.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Pack { values: self.simd.min_f64s(self.values, other.values), ..self }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        bytemuck::cast_slice::<S::f64s, f64>(std::slice::from_ref(&self.values))[lane]
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: f64) {
        bytemuck::cast_slice_mut::<S::f64s, f64>(std::slice::from_mut(&mut self.values))[lane] = value;
    }
}

impl<S: Registers> Mask for PackMask<S> {
    const WIDTH: usize = S::F64_LANES;

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        PackMask { values: self.simd.and_m64s(self.values, other.values), ..self }
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        PackMask { values: self.simd.or_m64s(self.values, other.values), ..self }
    }

    #[inline(always)]
    fn not(self) -> Self {
        PackMask { values: self.simd.not_m64s(self.values), ..self }
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.simd.bits(self.values)
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, holds: bool) {
        let here = self.simd.mask_between_m64s(lane as u64, lane as u64 + 1).mask();
        self.values = if holds {
            self.simd.or_m64s(self.values, here)
        } else {
            self.simd.and_m64s(self.values, self.simd.not_m64s(here))
        };
    }
}

#[cfg(test)]
mod tests;
