//! Vectors of one value for each coordinate, and matrices column by column; sums run from left to right.
//!
//! Loops and no closures: a closure that is not inlined loses the instructions that its caller was compiled for.

use nalgebra::SMatrix;

use super::real::Lanes;
use super::real::Real;

/// Coordinates or normals of a plant, at most; in flight a force may be one coordinate more.
pub const MOST: usize = 4;

/// a · b.
#[inline(always)]
pub fn dot<T: Lanes, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0] * b[0];
    for i in 1..N {
        sum = a[i].times_plus(b[i], sum);
    }
    sum
}

/// Σ |aᵢ| |bᵢ| for a ≥ 0.
#[inline(always)]
pub fn dot_absolute<T: Real, const N: usize>(a: &[T; N], b: &[T; N]) -> T {
    let mut sum = a[0] * b[0].abs();
    for i in 1..N {
        sum = a[i].times_plus(b[i].abs(), sum);
    }
    sum
}

/// y + a x.
#[inline(always)]
pub fn axpy<T: Lanes, const N: usize>(a: T, x: &[T; N], y: &[T; N]) -> [T; N] {
    let mut sum = *y;
    for i in 0..N {
        sum[i] = a.times_plus(x[i], y[i]);
    }
    sum
}

/// x + y.
#[inline(always)]
pub fn added<T: Lanes, const N: usize>(x: &[T; N], y: &[T; N]) -> [T; N] {
    let mut sum = *x;
    for i in 0..N {
        sum[i] = x[i] + y[i];
    }
    sum
}

/// a x.
#[inline(always)]
pub fn scaled<T: Lanes, const N: usize>(a: T, x: &[T; N]) -> [T; N] {
    let mut product = *x;
    for value in &mut product {
        *value = a * *value;
    }
    product
}

/// A matrix, given column by column, times a vector.
#[inline(always)]
pub fn applied<T: Lanes, const N: usize, const M: usize>(columns: &[[T; N]; M], x: &[T; M]) -> [T; N] {
    let mut sum = scaled(x[0], &columns[0]);
    for j in 1..M {
        sum = axpy(x[j], &columns[j], &sum);
    }
    sum
}

/// y plus a matrix, given column by column, times x.
#[inline(always)]
pub fn applied_onto<L: Lanes, const N: usize, const M: usize>(
    columns: &[[L; N]; M],
    x: &[L; M],
    y: &[L; N],
) -> [L; N] {
    let mut sum = *y;
    for j in 0..M {
        sum = axpy(x[j], &columns[j], &sum);
    }
    sum
}

/// y + Σ aᵢ |xᵢ|.
#[inline(always)]
pub fn absolute_onto<L: Lanes, const N: usize>(a: &[L; N], x: &[L; N], y: L) -> L {
    let mut sum = y;
    for i in 0..N {
        sum = a[i].times_plus(x[i].magnitude(), sum);
    }
    sum
}

/// a times a matrix, column by column.
#[inline(always)]
pub fn scaled_columns<L: Lanes, const N: usize, const M: usize>(a: L, columns: &[[L; N]; M]) -> [[L; N]; M] {
    let mut product = *columns;
    for column in &mut product {
        *column = scaled(a, column);
    }
    product
}

/// `yes` where the mask holds, `no` elsewhere.
#[inline(always)]
pub fn select<L: Lanes, const N: usize>(mask: L::Mask, yes: &[L; N], no: &[L; N]) -> [L; N] {
    let mut chosen = *no;
    for i in 0..N {
        chosen[i] = L::select(mask, yes[i], no[i]);
    }
    chosen
}

/// The entries of a matrix, column by column.
pub(super) fn columns<const N: usize>(matrix: &SMatrix<f64, N, N>) -> [[f64; N]; N] {
    std::array::from_fn(|j| std::array::from_fn(|i| matrix[(i, j)]))
}
