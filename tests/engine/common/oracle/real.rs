//! The arithmetic that the oracle is generic over.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::dd::Dd;

/// A number type to follow trajectories in.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Terms of a Taylor series with ratio at most 1/4 per term before its tail is below the rounding.
    const TERMS: usize;

    /// The number nearest to an f64.
    fn of(value: f64) -> Self;

    /// The number nearest to a double-double.
    fn rounded(value: Dd) -> Self;

    /// The nearest f64.
    fn f64(self) -> f64;
}

impl Real for f64 {
    const TERMS: usize = 14;

    fn of(value: f64) -> Self {
        value
    }

    fn rounded(value: Dd) -> Self {
        value.rounded()
    }

    fn f64(self) -> f64 {
        self
    }
}

impl Real for Dd {
    const TERMS: usize = 26;

    fn of(value: f64) -> Self {
        Dd::from(value)
    }

    fn rounded(value: Dd) -> Self {
        value
    }

    fn f64(self) -> f64 {
        Dd::rounded(self)
    }
}
