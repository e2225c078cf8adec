//! What is asked of an instruction set: what `pulp` has for each precision, under the same names for both.

use std::fmt::Debug;

use bytemuck::Pod;
use pulp::Simd;

use super::real::Real;

/// An instruction set with its truth values as bits: one instruction.
pub trait Registers: Simd {
    /// What lies on a boundary of a register's size.
    type Boundary: Copy + Debug + Send + Sync + 'static;

    /// A bit for each lane of f64.
    fn bits_of_m64s(self, truths: Self::m64s) -> u32;

    /// A bit for each lane of f32.
    fn bits_of_m32s(self, truths: Self::m32s) -> u32;
}

/// A precision in the registers of the instruction set `S`: operations in all lanes, each of an instruction or two.
pub trait Packed<S: Registers>: Real + Pod {
    /// As many numbers as a register holds.
    type Numbers: Copy + Debug + Send + Sync + Pod;
    /// A truth value for each of them.
    type Truths: Copy + Debug + Send + Sync + 'static;
    /// How many there are.
    const LANES: usize;

    fn splat(simd: S, value: Self) -> Self::Numbers;
    fn add(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn sub(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn mul(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn div(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// See [`Lanes::times_plus`](super::real::Lanes::times_plus).
    fn times_plus(simd: S, a: Self::Numbers, factor: Self::Numbers, term: Self::Numbers) -> Self::Numbers;
    fn neg(simd: S, a: Self::Numbers) -> Self::Numbers;
    fn magnitude(simd: S, a: Self::Numbers) -> Self::Numbers;
    fn root(simd: S, a: Self::Numbers) -> Self::Numbers;
    /// The second number where either is none, or both are zeros.
    fn max(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    /// See `max`.
    fn min(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Numbers;
    fn below(simd: S, a: Self::Numbers, b: Self::Numbers) -> Self::Truths;
    fn select(simd: S, truths: Self::Truths, yes: Self::Numbers, no: Self::Numbers) -> Self::Numbers;
    fn and(simd: S, a: Self::Truths, b: Self::Truths) -> Self::Truths;
    fn or(simd: S, a: Self::Truths, b: Self::Truths) -> Self::Truths;
    fn not(simd: S, a: Self::Truths) -> Self::Truths;
    fn bits(simd: S, truths: Self::Truths) -> u32;
    /// True in one lane.
    fn only(simd: S, lane: usize) -> Self::Truths;
}

macro_rules! packed {
    (
        $real:ident in $word:ident: $lanes:ident of $numbers:ident, $truths:ident,
        pairs { $($of_two:ident: $two:ident),* $(,)? }
        truths { $($of_truths:ident: $both:ident),* $(,)? }
        $splat:ident, $and:ident, $xor:ident, $root:ident, $below:ident, $select:ident, $not:ident, $bits:ident, $between:ident,
        times_plus: $times_plus:expr
    ) => {
        impl<S: Registers> Packed<S> for $real {
            type Numbers = S::$numbers;
            type Truths = S::$truths;
            const LANES: usize = S::$lanes;

            $(
                #[inline(always)]
                fn $of_two(simd: S, a: S::$numbers, b: S::$numbers) -> S::$numbers {
                    simd.$two(a, b)
                }
            )*

            $(
                #[inline(always)]
                fn $of_truths(simd: S, a: S::$truths, b: S::$truths) -> S::$truths {
                    simd.$both(a, b)
                }
            )*

            #[inline(always)]
            fn splat(simd: S, value: $real) -> S::$numbers {
                simd.$splat(value)
            }

            #[inline(always)]
            fn times_plus(simd: S, a: S::$numbers, factor: S::$numbers, term: S::$numbers) -> S::$numbers {
                $times_plus(simd, a, factor, term)
            }

            #[inline(always)]
            fn neg(simd: S, a: S::$numbers) -> S::$numbers {
                simd.$xor(a, simd.$splat(-0.0))
            }

            #[inline(always)]
            fn magnitude(simd: S, a: S::$numbers) -> S::$numbers {
                simd.$and(a, simd.$splat($real::from_bits($word::MAX >> 1)))
            }

            #[inline(always)]
            fn root(simd: S, a: S::$numbers) -> S::$numbers {
                simd.$root(a)
            }

            #[inline(always)]
            fn below(simd: S, a: S::$numbers, b: S::$numbers) -> S::$truths {
                simd.$below(a, b)
            }

            #[inline(always)]
            fn select(simd: S, truths: S::$truths, yes: S::$numbers, no: S::$numbers) -> S::$numbers {
                bytemuck::cast(simd.$select(truths, bytemuck::cast(yes), bytemuck::cast(no)))
            }

            #[inline(always)]
            fn not(simd: S, a: S::$truths) -> S::$truths {
                simd.$not(a)
            }

            #[inline(always)]
            fn bits(simd: S, truths: S::$truths) -> u32 {
                simd.$bits(truths)
            }

            #[inline(always)]
            fn only(simd: S, lane: usize) -> S::$truths {
                simd.$between(lane as $word, lane as $word + 1).mask()
            }
        }
    };
}

packed!(
    f64 in u64: F64_LANES of f64s, m64s,
    pairs { add: add_f64s, sub: sub_f64s, mul: mul_f64s, div: div_f64s, max: max_f64s, min: min_f64s }
    truths { and: and_m64s, or: or_m64s }
    splat_f64s, and_f64s, xor_f64s, sqrt_f64s, less_than_f64s, select_u64s, not_m64s, bits_of_m64s, mask_between_m64s,
    times_plus: Simd::mul_add_f64s
);
packed!(
    f32 in u32: F32_LANES of f32s, m32s,
    pairs { add: add_f32s, sub: sub_f32s, mul: mul_f32s, div: div_f32s, max: max_f32s, min: min_f32s }
    truths { and: and_m32s, or: or_m32s }
    splat_f32s, and_f32s, xor_f32s, sqrt_f32s, less_than_f32s, select_u32s, not_m32s, bits_of_m32s, mask_between_m32s,
    times_plus: rounded_twice
);

#[inline(always)]
fn rounded_twice<S: Simd>(simd: S, a: S::f32s, factor: S::f32s, term: S::f32s) -> S::f32s {
    simd.add_f32s(simd.mul_f32s(a, factor), term)
}

/// See [`Registers::Boundary`].
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct Of32Bytes;

/// See [`Registers::Boundary`].
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Of64Bytes;

impl Registers for pulp::x86::V3 {
    type Boundary = Of32Bytes;

    #[inline(always)]
    fn bits_of_m64s(self, truths: Self::m64s) -> u32 {
        self.avx._mm256_movemask_pd(bytemuck::cast(truths)) as u32
    }

    #[inline(always)]
    fn bits_of_m32s(self, truths: Self::m32s) -> u32 {
        self.avx._mm256_movemask_ps(bytemuck::cast(truths)) as u32
    }
}

impl Registers for pulp::x86::V4 {
    type Boundary = Of64Bytes;

    #[inline(always)]
    fn bits_of_m64s(self, truths: Self::m64s) -> u32 {
        u32::from(truths.0)
    }

    #[inline(always)]
    fn bits_of_m32s(self, truths: Self::m32s) -> u32 {
        u32::from(truths.0)
    }
}
