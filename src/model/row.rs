//! A number of a motion as a sum over its state and what forces it.

use super::flow::Functional;
use super::real::Real;
use super::state::State;

/// What multiplies the state, the forcing phasor and 1 in such a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<T, const N: usize> {
    /// Displacements and velocities.
    pub state: State<T, N>,
    /// sin φ.
    pub sin: T,
    /// cos φ.
    pub cos: T,
    /// 1.
    pub one: T,
}

impl<T: Copy, const N: usize> Row<T, N> {
    /// Every number alike.
    pub(super) fn all(value: T) -> Self {
        Row { state: State { x: [value; N], v: [value; N] }, sin: value, cos: value, one: value }
    }
}

impl<const N: usize> Row<f64, N> {
    /// The same of a functional.
    pub(super) fn of(functional: Functional<N>) -> Self {
        let Functional { x, v, sin, cos, one } = functional;
        Row { state: State { x: x.into(), v: v.into() }, sin, cos, one }
    }

    /// Rounded to another precision.
    pub(super) fn round<T: Real>(&self) -> Row<T, N> {
        let Row { state, sin, cos, one } = *self;
        Row { state: state.map(T::of), sin: T::of(sin), cos: T::of(cos), one: T::of(one) }
    }
}

/// What the polynomials of a flight have as coefficients.
pub(super) trait Term: Copy {
    /// 0.
    fn zero() -> Self;
    /// self + a other.
    fn plus(&self, a: f64, other: &Self) -> Self;
}

impl<const N: usize> Term for State<f64, N> {
    fn zero() -> Self {
        State::zero()
    }

    #[inline(always)]
    fn plus(&self, a: f64, other: &Self) -> Self {
        State::plus(self, a, other)
    }
}

impl<const N: usize> Term for Row<f64, N> {
    fn zero() -> Self {
        Row::all(0.0)
    }

    #[inline(always)]
    fn plus(&self, a: f64, other: &Self) -> Self {
        Row {
            state: self.state.plus(a, &other.state),
            sin: self.sin + a * other.sin,
            cos: self.cos + a * other.cos,
            one: self.one + a * other.one,
        }
    }
}
