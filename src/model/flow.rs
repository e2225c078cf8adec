//! The flow of free flight and of sticking as one linear system in (x, v, sin φ, cos φ, 1).

use nalgebra::{SMatrix, SVector};

use super::equations::Equations;
use super::state::State;

/// x, v, and what the forcing and the constant load multiply.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Augmented<const N: usize> {
    /// Displacements.
    pub x: SVector<f64, N>,
    /// Velocities.
    pub v: SVector<f64, N>,
    /// sin φ.
    pub sin: f64,
    /// cos φ.
    pub cos: f64,
    /// 1, the factor of the constant load.
    pub one: f64,
}

impl<const N: usize> Augmented<N> {
    /// All zeros.
    pub fn zeros() -> Self {
        Augmented { x: SVector::zeros(), v: SVector::zeros(), sin: 0.0, cos: 0.0, one: 0.0 }
    }

    /// The largest component.
    pub fn amax(&self) -> f64 {
        self.x.amax().max(self.v.amax()).max(self.sin.abs()).max(self.cos.abs()).max(self.one.abs())
    }

    fn scaled(&self, factor: f64) -> Self {
        Augmented {
            x: self.x * factor,
            v: self.v * factor,
            sin: self.sin * factor,
            cos: self.cos * factor,
            one: self.one * factor,
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Augmented {
            x: self.x + other.x,
            v: self.v + other.v,
            sin: self.sin + other.sin,
            cos: self.cos + other.cos,
            one: self.one + other.one,
        }
    }
}

/// The derivative of a state in free flight.
pub fn derivative<const N: usize>(equations: &Equations<N>, z: &Augmented<N>) -> Augmented<N> {
    Augmented {
        x: z.v,
        v: equations.stiffness * z.x
            + equations.damping * z.v
            + equations.sin * z.sin
            + equations.cos * z.cos
            + equations.load * z.one,
        sin: equations.omega * z.cos,
        cos: -equations.omega * z.sin,
        one: 0.0,
    }
}

/// The terms Gᵏ z tᵏ/k! of exp(G t) z in free flight, until they vanish against their sum.
pub fn series<const N: usize>(
    equations: &Equations<N>,
    t: f64,
    z: Augmented<N>,
) -> impl Iterator<Item = Augmented<N>> {
    let mut size = z.amax();
    std::iter::successors(Some((1.0, z)), move |(k, term)| {
        let next = derivative(equations, term).scaled(t / k);
        let length = next.amax();
        size = size.max(length);
        (length > 1e-19 * size).then_some((k + 1.0, next))
    })
    .map(|(_, term)| term)
}

/// The terms f Gᵏ (−t)ᵏ/k! of f exp(−G t) in free flight, until they vanish against their sum: what the functional f was a time t
/// ago.
pub fn series_back<const N: usize>(
    equations: &Equations<N>,
    t: f64,
    f: Functional<N>,
) -> impl Iterator<Item = Functional<N>> {
    let mut size = f.amax();
    std::iter::successors(Some((1.0, f)), move |(k, term)| {
        let next = term.derived(equations, &SMatrix::identity()).scaled(-t / k);
        let length = next.amax();
        size = size.max(length);
        (length > 1e-19 * size).then_some((k + 1.0, next))
    })
    .map(|(_, term)| term)
}

/// exp(G t) z in free flight.
pub fn over<const N: usize>(equations: &Equations<N>, t: f64, z: Augmented<N>) -> Augmented<N> {
    series(equations, t, z).fold(Augmented::zeros(), |sum, term| sum.plus(&term))
}

/// A linear functional of a state: what multiplies x, v, sin φ, cos φ and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Functional<const N: usize> {
    /// Of the displacements.
    pub x: SVector<f64, N>,
    /// Of the velocities.
    pub v: SVector<f64, N>,
    /// Of sin φ.
    pub sin: f64,
    /// Of cos φ.
    pub cos: f64,
    /// The coefficient of the constant 1.
    pub one: f64,
}

impl<const N: usize> Functional<N> {
    /// `row` · a, with a the accelerations of free flight.
    pub fn of_acceleration(equations: &Equations<N>, row: &SVector<f64, N>) -> Self {
        Functional {
            x: equations.stiffness.tr_mul(row),
            v: equations.damping.tr_mul(row),
            sin: row.dot(&equations.sin),
            cos: row.dot(&equations.cos),
            one: row.dot(&equations.load),
        }
    }

    /// The functional of the derivative, on a motion whose accelerations are `projector` times those of free flight
    /// and whose velocities lie in its range: functional · G.
    fn derived(&self, equations: &Equations<N>, projector: &SMatrix<f64, N, N>) -> Self {
        let row = projector.tr_mul(&self.v);
        Functional {
            x: equations.stiffness.tr_mul(&row),
            v: projector.tr_mul(&self.x) + equations.damping.tr_mul(&row),
            sin: row.dot(&equations.sin) - equations.omega * self.cos,
            cos: row.dot(&equations.cos) + equations.omega * self.sin,
            one: row.dot(&equations.load),
        }
    }

    fn scaled(&self, factor: f64) -> Self {
        Functional {
            x: self.x * factor,
            v: self.v * factor,
            sin: self.sin * factor,
            cos: self.cos * factor,
            one: self.one * factor,
        }
    }

    fn abs(&self) -> Self {
        Functional {
            x: self.x.abs(),
            v: self.v.abs(),
            sin: self.sin.abs(),
            cos: self.cos.abs(),
            one: self.one.abs(),
        }
    }

    fn plus(&self, other: &Self) -> Self {
        Functional {
            x: self.x + other.x,
            v: self.v + other.v,
            sin: self.sin + other.sin,
            cos: self.cos + other.cos,
            one: self.one + other.one,
        }
    }

    fn amax(&self) -> f64 {
        self.x.amax().max(self.v.amax()).max(self.sin.abs()).max(self.cos.abs()).max(self.one.abs())
    }

    /// The larger of two, component by component.
    pub fn sup(&self, other: &Self) -> Self {
        Functional {
            x: self.x.sup(&other.x),
            v: self.v.sup(&other.v),
            sin: self.sin.max(other.sin),
            cos: self.cos.max(other.cos),
            one: self.one.max(other.one),
        }
    }
}

/// A bound on the second derivative of a functional for every time |s| ≤ t from a state of a motion, component by component:
/// Σ tᵏ/k! |functional · Gᵏ⁺²|.
pub fn second_derivative_bound<const N: usize>(
    equations: &Equations<N>,
    projector: &SMatrix<f64, N, N>,
    functional: &Functional<N>,
    t: f64,
) -> Functional<N> {
    let mut term = functional.derived(equations, projector).derived(equations, projector);
    let mut sum = term.abs();
    for k in 1..64 {
        term = term.derived(equations, projector).scaled(t / f64::from(k));
        sum = sum.plus(&term.abs());
        if term.amax() <= 1e-12 * sum.amax() {
            break;
        }
    }
    sum
}

/// The displacements and velocities of an augmented state.
pub(super) fn mechanical<const N: usize>(z: &Augmented<N>) -> State<f64, N> {
    State { x: z.x.into(), v: z.v.into() }
}
