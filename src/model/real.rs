//! The numbers that trajectories are computed in: two precisions, f64 for the reference and f32 for the GPU's twin, and several
//! such numbers side by side.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use num_traits::Float;
use pulp::NullaryFnOnce;

/// A floating-point type that trajectories are computed in.
///
/// Tolerances that depend on the precision live here, in one place; the GPU's shader gets the f32 ones generated.
pub trait Real: Float + Debug + Send + Sync + 'static + Lanes<Real = Self, Mask = bool> {
    /// The distance from 1 to the next larger number.
    const EPSILON: f64;
    /// Taylor terms below this share of the largest are left out of a flight.
    const TRUNCATION: f64;
    /// The largest order of a flight's Taylor polynomial.
    const ORDER: usize;
    /// The order of the polynomial of an impact, what it does to the end of its step: what it leaves out is lost in rounding.
    const KICK_ORDER: usize;
    /// The order of the polynomial of what the end of a step says of the way to it: what it leaves out of place and speed is not
    /// more than what rounding adds on the way.
    const BACK_ORDER: usize;
    /// What may be left of the way to a contact that a polynomial of low order finds, in units of the fastest motion's time scale: a
    /// twenty-fourth of its fourth power is less than a rounding.
    const STRAIGHT: f64;
    /// Whether contacts are missed by more than that so often that it is worth while to ask the course again.
    const ASKS_AGAIN: bool;
    /// A gap below this multiple of the numbers whose difference it is counts as contact.
    const TOUCH: f64;
    /// Contact less than this far ahead, in units of the fastest motion's time scale, is reached in one straight line.
    const IMMINENT: f64;
    /// A pull this many times as large as what is lost in rounding of it, grown from nothing as fast as it can, has done no more to a
    /// speed than is lost, too: about ε^(−⅓)/4.
    const UNHEEDED: f64;
    /// The largest effect on the masses that closing a chatter sequence may neglect, in units of
    /// [`Flight::unit`](super::Flight::unit), as all distances below are.
    const CHATTER: f64;
    /// The largest distance between strobe states that counts as a return of a motion that may yet come closer.
    const RETURNING: f64;
    /// The largest distance between strobe states of a settled motion since the state that they are compared with, before its
    /// trajectory finishes early.
    const SETTLED: f64;
    /// The same for a motion whose strobe states no longer move at all, but for rounding.
    const AT_REST: f64;
    /// The largest distance between strobe states that rounding, and closing complete chatter, may leave on a motion that
    /// repeats.
    const ROUNDING: f64;

    /// The nearest value of this type.
    fn of(value: f64) -> Self;

    /// The value as f64, exact.
    fn widen(self) -> f64;

    /// ln of a positive, finite value.
    fn logarithm(self) -> Self;

    /// Computes something with the instructions of the processor that [`Lanes::times_plus`] asks for, where it has them: the
    /// bits are the same without, each such operation is a call then.
    ///
    /// What is computed has these instructions as far as it is inlined.
    #[inline(always)]
    fn fused<C: NullaryFnOnce>(computation: C) -> C::Output {
        computation.call()
    }
}

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

    /// self · factor + term: rounded once in f64, on every processor; rounded twice in f32, as any adapter can.
    #[must_use]
    fn times_plus(self, factor: Self, term: Self) -> Self;

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

    /// The same unless an equal number is there, 0 being equal to −0: lanes that are not written to one by one are loaded sooner.
    #[inline(always)]
    fn renew_lane(&mut self, lane: usize, value: Self::Real) {
        if self.lane(lane) != value {
            self.set_lane(lane, value);
        }
    }

    /// The larger of two numbers; `other` where they are equal, or either is not a number.
    #[inline(always)]
    #[must_use]
    fn larger(self, other: Self) -> Self {
        Self::select(other.below(self), self, other)
    }

    /// The smaller of two numbers; `other` where they are equal, or either is not a number.
    #[inline(always)]
    #[must_use]
    fn smaller(self, other: Self) -> Self {
        Self::select(self.below(other), self, other)
    }
}

/// A truth value for each lane.
pub trait Mask: Copy + Debug {
    /// How many lanes there are.
    const WIDTH: usize;

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

    /// Whether it holds in one lane from now on.
    fn set_lane(&mut self, lane: usize, holds: bool);
}

impl Real for f64 {
    const EPSILON: f64 = f64::EPSILON;
    const TRUNCATION: f64 = 2e-16;
    const ORDER: usize = 20;
    const KICK_ORDER: usize = 12;
    const BACK_ORDER: usize = 12;
    const STRAIGHT: f64 = 2e-4;
    const ASKS_AGAIN: bool = true;
    const TOUCH: f64 = 4.0 * f64::EPSILON;
    const UNHEEDED: f64 = 32_768.0;
    const IMMINENT: f64 = 1e-8;
    const CHATTER: f64 = 1e-12;
    const RETURNING: f64 = 1e-5;
    const SETTLED: f64 = 1e-6;
    const AT_REST: f64 = 1e-10;
    const ROUNDING: f64 = 1e-9;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn widen(self) -> f64 {
        self
    }

    fn logarithm(self) -> Self {
        libm::log(self)
    }

    #[inline(always)]
    fn fused<C: NullaryFnOnce>(computation: C) -> C::Output {
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            return simd.vectorize(computation);
        }
        computation.call()
    }
}

impl Real for f32 {
    const EPSILON: f64 = f32::EPSILON as f64;
    const TRUNCATION: f64 = 1e-8;
    const ORDER: usize = 12;
    const KICK_ORDER: usize = 6;
    const BACK_ORDER: usize = 7;
    const STRAIGHT: f64 = 2e-2;
    const ASKS_AGAIN: bool = false;
    const TOUCH: f64 = 4.0 * f32::EPSILON as f64;
    const UNHEEDED: f64 = 32.0;
    const IMMINENT: f64 = 1e-4;
    const CHATTER: f64 = 1e-8;
    const RETURNING: f64 = 1e-4;
    const SETTLED: f64 = 2e-5;
    const AT_REST: f64 = 1e-6;
    const ROUNDING: f64 = 4e-6;

    #[inline(always)]
    fn of(value: f64) -> Self {
        value as f32
    }

    #[inline(always)]
    fn widen(self) -> f64 {
        f64::from(self)
    }

    fn logarithm(self) -> Self {
        super::logarithm(self)
    }
}
