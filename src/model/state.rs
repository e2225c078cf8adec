//! Displacements and velocities.

use super::real::Real;
use super::vector::{added, axpy, scaled};

/// Displacements and velocities of N coordinates, or a deviation of them; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<T, const N: usize> {
    /// Displacements.
    pub x: [T; N],
    /// Velocities.
    pub v: [T; N],
}

impl<T: Real, const N: usize> State<T, N> {
    /// All zeros.
    #[inline(always)]
    pub fn zero() -> Self {
        State { x: [T::zero(); N], v: [T::zero(); N] }
    }

    /// From (x1 … xN, v1 … vN).
    ///
    /// # Panics
    /// If there are not 2N values.
    pub fn from_slice(values: &[T]) -> Self {
        assert_eq!(values.len(), 2 * N, "a state of {N} coordinates");
        State { x: std::array::from_fn(|i| values[i]), v: std::array::from_fn(|i| values[N + i]) }
    }

    /// x1 … xN, v1 … vN.
    #[inline(always)]
    pub fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.x.iter().chain(&self.v).copied()
    }

    /// Component `i` of (x1 … xN, v1 … vN).
    #[inline(always)]
    pub fn get(&self, i: usize) -> T {
        if i < N { self.x[i] } else { self.v[i - N] }
    }

    /// Whether every component is a finite number.
    #[inline(always)]
    pub fn is_finite(&self) -> bool {
        self.values().all(|value| value.is_finite())
    }

    /// self + a other.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, a: T, other: &Self) -> Self {
        State { x: axpy(a, &other.x, &self.x), v: axpy(a, &other.v, &self.v) }
    }

    /// self + other.
    #[inline(always)]
    #[must_use]
    pub fn added(&self, other: &Self) -> Self {
        State { x: added(&self.x, &other.x), v: added(&self.v, &other.v) }
    }

    /// a self.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, a: T) -> Self {
        State { x: scaled(a, &self.x), v: scaled(a, &self.v) }
    }

    /// Each component by itself.
    #[inline(always)]
    pub fn map<U>(&self, f: impl Fn(T) -> U + Copy) -> State<U, N> {
        State { x: self.x.map(f), v: self.v.map(f) }
    }

    /// The Euclidean length.
    #[inline(always)]
    pub fn length(&self) -> T {
        let mut squares = T::zero();
        for i in 0..N {
            squares = squares + (self.x[i] * self.x[i] + self.v[i] * self.v[i]);
        }
        squares.sqrt()
    }
}
