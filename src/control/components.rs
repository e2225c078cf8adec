//! The 2N components of a point on a section.

use std::ops::{Index, IndexMut};

use crate::model::Real;

/// 2N values, one for each component of a point on a section: v+ of the coordinate that the stop's gap determines, the
/// other displacements, the other velocities, τ; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Components<T, const N: usize>([[T; N]; 2]);

impl<T: Real, const N: usize> Components<T, N> {
    /// How many there are.
    pub const COUNT: usize = 2 * N;
    /// Where τ stands.
    pub const TAU: usize = 2 * N - 1;

    /// Each component by its place.
    #[inline(always)]
    pub fn from_fn(mut f: impl FnMut(usize) -> T) -> Self {
        Components(std::array::from_fn(|half| std::array::from_fn(|i| f(half * N + i))))
    }

    /// All zeros.
    pub fn zero() -> Self {
        Components([[T::zero(); N]; 2])
    }

    /// From their values in order.
    ///
    /// # Panics
    /// If there are not 2N of them.
    pub fn from_slice(values: &[T]) -> Self {
        assert_eq!(values.len(), Self::COUNT, "a section point of {N} coordinates");
        Components::from_fn(|i| values[i])
    }

    /// The components in their order.
    #[inline(always)]
    pub fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.0.iter().flatten().copied()
    }

    /// Every component changed by a function.
    #[inline(always)]
    #[must_use]
    pub fn map(&self, f: impl Fn(T) -> T) -> Self {
        Components::from_fn(|i| f(self[i]))
    }

    /// The sum of two.
    #[inline(always)]
    #[must_use]
    pub fn added(&self, other: &Self) -> Self {
        Components::from_fn(|i| self[i] + other[i])
    }

    /// The square of the Euclidean length.
    #[inline(always)]
    pub fn square(&self) -> T {
        let [first, second] = self.0.map(|half| {
            let mut sum = half[0] * half[0];
            for value in &half[1..] {
                sum = sum + *value * *value;
            }
            sum
        });
        first + second
    }

    /// The Euclidean length.
    #[inline(always)]
    pub fn length(&self) -> T {
        self.square().sqrt()
    }

    /// Whether every component is 0.
    #[inline(always)]
    pub fn is_zero(&self) -> bool {
        self.values().all(|value| value == T::zero())
    }
}

impl<T, const N: usize> Index<usize> for Components<T, N> {
    type Output = T;

    #[inline(always)]
    fn index(&self, i: usize) -> &T {
        &self.0[i / N][i % N]
    }
}

impl<T, const N: usize> IndexMut<usize> for Components<T, N> {
    #[inline(always)]
    fn index_mut(&mut self, i: usize) -> &mut T {
        &mut self.0[i / N][i % N]
    }
}
