//! A number of a motion as a sum over its state and what forces it.

use nalgebra::{SMatrix, SVector};

use super::equations::Equations;
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
    /// A displacement along a direction.
    pub(super) fn along(direction: &SVector<f64, N>) -> Self {
        let zero = Row::all(0.0);
        Row { state: State { x: (*direction).into(), ..zero.state }, ..zero }
    }

    /// An acceleration along a direction in free flight.
    pub(super) fn of_acceleration(equations: &Equations<N>, direction: &SVector<f64, N>) -> Self {
        let direction = (*direction).into();
        Row {
            state: State {
                x: transposed(&equations.stiffness, &direction),
                v: transposed(&equations.damping, &direction),
            },
            sin: product(&equations.sin, &direction),
            cos: product(&equations.cos, &direction),
            one: product(&equations.load, &direction),
        }
    }

    /// That of the derivative, on a motion whose accelerations are `projector` times those of free flight and whose
    /// velocities lie in its range.
    #[inline(always)]
    fn derived(&self, equations: &Equations<N>, projector: &SMatrix<f64, N, N>) -> Self {
        let pull = transposed(projector, &self.state.v);
        let [mut v, damped] = [transposed(projector, &self.state.x), transposed(&equations.damping, &pull)];
        for i in 0..N {
            v[i] += damped[i];
        }
        Row {
            state: State { x: transposed(&equations.stiffness, &pull), v },
            sin: product(&equations.sin, &pull) - equations.omega * self.cos,
            cos: product(&equations.cos, &pull) + equations.omega * self.sin,
            one: product(&equations.load, &pull),
        }
    }

    /// Each number by itself.
    #[inline(always)]
    fn map(&self, f: impl Fn(f64) -> f64 + Copy) -> Self {
        Row { state: self.state.map(f), sin: f(self.sin), cos: f(self.cos), one: f(self.one) }
    }

    /// The numbers of two, one by one.
    #[inline(always)]
    fn with(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut both = *self;
        for i in 0..N {
            both.state.x[i] = f(self.state.x[i], other.state.x[i]);
            both.state.v[i] = f(self.state.v[i], other.state.v[i]);
        }
        (both.sin, both.cos, both.one) =
            (f(self.sin, other.sin), f(self.cos, other.cos), f(self.one, other.one));
        both
    }

    /// a self.
    #[inline(always)]
    pub(super) fn scaled(&self, a: f64) -> Self {
        self.map(|value| a * value)
    }

    /// The larger of two, number by number.
    pub(super) fn sup(&self, other: &Self) -> Self {
        self.with(other, f64::max)
    }

    /// The largest modulus, with so much of x and v of order one.
    #[inline(always)]
    fn amax(&self, weight: f64) -> f64 {
        let mut most = self.sin.abs().max(self.cos.abs()).max(self.one.abs()) / weight;
        for i in 0..N {
            most = most.max(self.state.x[i].abs()).max(self.state.v[i].abs());
        }
        most
    }

    /// The terms f Gᵏ (−t)ᵏ/k! of f exp(−G t) in free flight, until they vanish against their sum: what this, f, was a time t ago.
    pub(super) fn series_back(self, equations: &Equations<N>, t: f64) -> impl Iterator<Item = Self> {
        let (mut size, one) = (self.amax(equations.weight), SMatrix::identity());
        std::iter::successors(Some((1.0, self)), move |(k, term)| {
            let next = term.derived(equations, &one).scaled(-t / k);
            let length = next.amax(equations.weight);
            size = size.max(length);
            (length > 1e-19 * size).then_some((k + 1.0, next))
        })
        .map(|(_, term)| term)
    }

    /// A bound on its second derivative for every time |s| ≤ t from a state of a motion, number by number:
    /// Σ tᵏ/k! |self · Gᵏ⁺²|; see `derived`.
    pub(super) fn second_derivative_bound(
        &self,
        equations: &Equations<N>,
        projector: &SMatrix<f64, N, N>,
        t: f64,
    ) -> Self {
        let mut term = self.derived(equations, projector).derived(equations, projector);
        let mut sum = term.map(f64::abs);
        for k in 1..64 {
            term = term.derived(equations, projector).scaled(t / f64::from(k));
            sum = sum.with(&term, |sum, value| sum + value.abs());
            if term.amax(equations.weight) <= 1e-12 * sum.amax(equations.weight) {
                break;
            }
        }
        sum
    }

    /// Rounded to another precision.
    pub(super) fn round<T: Real>(&self) -> Row<T, N> {
        let Row { state, sin, cos, one } = *self;
        Row { state: state.map(T::of), sin: T::of(sin), cos: T::of(cos), one: T::of(one) }
    }
}

/// Mᵀ a; each product and each sum is rounded.
#[inline(always)]
fn transposed<const N: usize>(matrix: &SMatrix<f64, N, N>, a: &[f64; N]) -> [f64; N] {
    let mut image = *a;
    for (i, value) in image.iter_mut().enumerate() {
        *value = matrix[(0, i)] * a[0];
        for j in 1..N {
            *value += matrix[(j, i)] * a[j];
        }
    }
    image
}

/// The sum of the products; each of them and each sum is rounded.
#[inline(always)]
fn product<const N: usize>(vector: &SVector<f64, N>, a: &[f64; N]) -> f64 {
    let mut sum = vector[0] * a[0];
    for j in 1..N {
        sum += vector[j] * a[j];
    }
    sum
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
