//! Vectors of one value for each coordinate, and matrices column by column; sums run from left to right.

use super::real::Real;

/// Coordinates or normals of a plant, at most.
pub const MOST: usize = 4;

/// a · b.
#[inline(always)]
pub fn dot<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// Σ |aᵢ| |bᵢ| for a ≥ 0.
#[inline(always)]
pub fn dot_absolute<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0] * b[0].abs();
    for i in 1..N {
        sum = sum + a[i] * b[i].abs();
    }
    sum
}

/// y + a x.
#[inline(always)]
pub fn axpy<T: Real, const N: usize>(a: T, x: &[T; N], y: &[T; N]) -> [T; N] {
    std::array::from_fn(|i| y[i] + a * x[i])
}

/// x + y.
#[inline(always)]
pub fn added<T: Real, const N: usize>(x: &[T; N], y: &[T; N]) -> [T; N] {
    std::array::from_fn(|i| x[i] + y[i])
}

/// a x.
#[inline(always)]
pub fn scaled<T: Real, const N: usize>(a: T, x: &[T; N]) -> [T; N] {
    x.map(|value| a * value)
}

/// A matrix, given column by column, times a vector.
#[inline(always)]
pub fn applied<T: Real, const N: usize, const M: usize>(columns: &[[T; N]; M], x: &[T; M]) -> [T; N] {
    let mut sum = scaled(x[0], &columns[0]);
    for j in 1..M {
        sum = axpy(x[j], &columns[j], &sum);
    }
    sum
}
