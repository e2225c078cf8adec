//! Several lanes of f64 in the registers of a processor.
//!
//! Of `pulp`, only methods that are one instruction are called, and no closures: what is not compiled into its caller has no
//! instructions for the registers.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::real::{Lanes, Mask};
use super::registers::Registers;

/// As many f64 as a register of the instruction set `S` holds.
///
/// They lie as a register of four likes it: a load across two cache lines takes twice as long.
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Pack<S: Registers> {
    simd: S,
    values: S::f64s,
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
        Pack { simd, values: simd.splat_f64s(0.0) }
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

/// Two packs that take every step together, so that one waits less for its own results.
///
/// They begin on a cache line: the widest register fills one, and a load from within two of them would take twice as long.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Twin<L>(pub L, pub L);

/// A truth value for each lane of a [`Twin`].
#[derive(Clone, Copy, Debug)]
pub struct TwinMask<M>(M, M);

macro_rules! twin_operator {
    ($operator:ident, $method:ident) => {
        impl<L: Lanes> $operator for Twin<L> {
            type Output = Self;

            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Twin(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
    };
}

twin_operator!(Add, add);
twin_operator!(Sub, sub);
twin_operator!(Mul, mul);
twin_operator!(Div, div);

impl<L: Lanes> Neg for Twin<L> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Twin(-self.0, -self.1)
    }
}

impl<L: Lanes> Lanes for Twin<L> {
    type Real = L::Real;
    type Mask = TwinMask<L::Mask>;
    const WIDTH: usize = 2 * L::WIDTH;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Twin(self.0.all(value), self.1.all(value))
    }

    #[inline(always)]
    fn times_plus(self, factor: Self, term: Self) -> Self {
        Twin(self.0.times_plus(factor.0, term.0), self.1.times_plus(factor.1, term.1))
    }

    #[inline(always)]
    fn magnitude(self) -> Self {
        Twin(self.0.magnitude(), self.1.magnitude())
    }

    #[inline(always)]
    fn root(self) -> Self {
        Twin(self.0.root(), self.1.root())
    }

    #[inline(always)]
    fn below(self, other: Self) -> TwinMask<L::Mask> {
        TwinMask(self.0.below(other.0), self.1.below(other.1))
    }

    #[inline(always)]
    fn select(mask: TwinMask<L::Mask>, yes: Self, no: Self) -> Self {
        Twin(L::select(mask.0, yes.0, no.0), L::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Twin(self.0.larger(other.0), self.1.larger(other.1))
    }

    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Twin(self.0.smaller(other.0), self.1.smaller(other.1))
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> L::Real {
        if lane < L::WIDTH { self.0.lane(lane) } else { self.1.lane(lane - L::WIDTH) }
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, value: L::Real) {
        if lane < L::WIDTH {
            self.0.set_lane(lane, value);
        } else {
            self.1.set_lane(lane - L::WIDTH, value);
        }
    }
}

impl<M: Mask> Mask for TwinMask<M> {
    const WIDTH: usize = 2 * M::WIDTH;

    #[inline(always)]
    fn and(self, other: Self) -> Self {
        TwinMask(self.0.and(other.0), self.1.and(other.1))
    }

    #[inline(always)]
    fn or(self, other: Self) -> Self {
        TwinMask(self.0.or(other.0), self.1.or(other.1))
    }

    #[inline(always)]
    fn not(self) -> Self {
        TwinMask(self.0.not(), self.1.not())
    }

    #[inline(always)]
    fn bits(self) -> u32 {
        self.0.bits() | self.1.bits() << M::WIDTH
    }

    #[inline(always)]
    fn set_lane(&mut self, lane: usize, holds: bool) {
        if lane < M::WIDTH {
            self.0.set_lane(lane, holds);
        } else {
            self.1.set_lane(lane - M::WIDTH, holds);
        }
    }
}

#[cfg(test)]
mod tests;
