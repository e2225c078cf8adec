//! Seven-dimensional vectors and matrices.

use std::array;

use super::real::Real;

/// Dimension of the augmented state.
pub const DIMENSION: usize = 7;

/// A state, or a linear functional of it.
pub type Vector<R> = [R; DIMENSION];

/// A square matrix, by rows.
pub type Matrix<R> = [Vector<R>; DIMENSION];

/// The zero matrix.
pub fn zero<R: Real>() -> Matrix<R> {
    [[R::of(0.0); DIMENSION]; DIMENSION]
}

/// The identity.
pub fn identity<R: Real>() -> Matrix<R> {
    array::from_fn(|i| array::from_fn(|j| R::of(if i == j { 1.0 } else { 0.0 })))
}

/// The scalar product.
pub fn dot<R: Real>(a: &Vector<R>, b: &Vector<R>) -> R {
    let mut sum = a[0] * b[0];
    for i in 1..DIMENSION {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// Matrix times column.
pub fn apply<R: Real>(m: &Matrix<R>, v: &Vector<R>) -> Vector<R> {
    array::from_fn(|i| dot(&m[i], v))
}

/// Row times matrix.
pub fn apply_left<R: Real>(v: &Vector<R>, m: &Matrix<R>) -> Vector<R> {
    array::from_fn(|j| dot(v, &array::from_fn(|i| m[i][j])))
}

/// Matrix times matrix.
pub fn multiply<R: Real>(a: &Matrix<R>, b: &Matrix<R>) -> Matrix<R> {
    array::from_fn(|i| apply_left(&a[i], b))
}

/// Every entry times a factor.
pub fn scale<R: Real>(m: &Matrix<R>, factor: R) -> Matrix<R> {
    m.map(|row| row.map(|entry| entry * factor))
}

/// The sum of absolute values.
pub fn norm_one<R: Real>(v: &Vector<R>) -> f64 {
    v.iter().map(|x| x.f64().abs()).sum()
}

/// The largest absolute value.
pub fn norm_max<R: Real>(v: &Vector<R>) -> f64 {
    v.iter().map(|x| x.f64().abs()).fold(0.0, f64::max)
}

/// The matrix norm that belongs to [`norm_max`].
pub fn norm<R: Real>(m: &Matrix<R>) -> f64 {
    m.iter().map(norm_one).fold(0.0, f64::max)
}
