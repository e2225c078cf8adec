//! z' = A z solved by the matrix exponential, tabulated on a fine grid of times since the last event.

use super::dd::Dd;
use super::linear::{
    DIMENSION, Matrix, Vector, apply, apply_left, dot, identity, multiply, norm, norm_max, norm_one, scale,
};
use super::real::Real;

/// ‖A‖ times the step: at least 2π/RESOLUTION ≈ 25 steps in the shortest period that A can hold.
const RESOLUTION: f64 = 0.25;

/// The exponential e^(At) for times up to a horizon.
///
/// The grid's matrices are computed in double-double and rounded once; a grid point costs two products (a
/// coarse and a fine one), whatever its distance, and a time between two of them one Taylor series of ratio ≤ 1/4.
#[derive(Debug)]
pub struct Flow<R> {
    generator: Matrix<R>,
    step: R,
    /// e^(‖A‖ step) − 1: how much a state can change, relative to its norm, within a step.
    growth: f64,
    coarse: Vec<Matrix<R>>,
    fine: Vec<Matrix<R>>,
}

/// The derivatives of a state at a grid point over k!, k = 0, 1, …: the state near that point.
#[derive(Debug)]
pub struct Local<R> {
    terms: Vec<Vector<R>>,
}

/// A linear functional c·z with its time derivatives along a flow.
#[derive(Clone, Debug)]
pub struct Functional<R> {
    /// c A^k for k = 0 … 4.
    derivatives: [Vector<R>; 5],
}

impl<R: Real> Flow<R> {
    /// Tabulates e^(At) for 0 ≤ t ≤ `horizon`.
    pub fn new(generator: &Matrix<Dd>, horizon: Dd) -> Self {
        let steps = (horizon.rounded() * norm(generator) / RESOLUTION).ceil().max(1.0);
        let step = horizon / Dd::from(steps);
        let block = steps.sqrt().ceil();
        let fine_one = exponential(&scale(generator, step));
        let fine = powers(&fine_one, block as usize + 1);
        let coarse = powers(&fine[block as usize], (steps / block) as usize + 2);
        Flow {
            generator: round(generator),
            step: R::rounded(step),
            growth: (norm(generator) * step.rounded()).exp_m1(),
            coarse: coarse.iter().map(round).collect(),
            fine: fine[..block as usize].iter().map(round).collect(),
        }
    }

    /// The distance of two grid points.
    pub fn step(&self) -> R {
        self.step
    }

    /// The state at a grid point.
    pub fn sample(&self, start: &Vector<R>, index: usize) -> Vector<R> {
        let (block, rest) = (index / self.fine.len(), index % self.fine.len());
        let start = if block == 0 { *start } else { apply(&self.coarse[block], start) };
        if rest == 0 { start } else { apply(&self.fine[rest], &start) }
    }

    /// The state at any time within the horizon.
    pub fn at(&self, start: &Vector<R>, time: R) -> Vector<R> {
        let index = (time.f64() / self.step.f64()).floor();
        let rest = time - R::of(index) * self.step;
        self.local(&self.sample(start, index as usize)).state(rest)
    }

    /// The Taylor series about a state.
    pub fn local(&self, state: &Vector<R>) -> Local<R> {
        let mut terms = Vec::with_capacity(R::TERMS + 1);
        let mut term = *state;
        terms.push(term);
        for k in 1..=R::TERMS {
            let over_k = R::of(1.0) / R::of(k as f64);
            term = apply(&self.generator, &term).map(|x| x * over_k);
            terms.push(term);
        }
        Local { terms }
    }

    /// A functional with its derivatives along this flow.
    pub fn functional(&self, row: Vector<R>) -> Functional<R> {
        let mut derivatives = [row; 5];
        for k in 1..5 {
            derivatives[k] = apply_left(&derivatives[k - 1], &self.generator);
        }
        Functional { derivatives }
    }

    /// A bound on |c A^k z| during the step that starts at `state`.
    pub fn bound(&self, functional: &Functional<R>, order: usize, state: &Vector<R>) -> f64 {
        let row = &functional.derivatives[order];
        dot(row, state).f64().abs() + self.growth * norm_one(row) * norm_max(state)
    }
}

impl<R: Real> Functional<R> {
    /// The value or a derivative at a state.
    pub fn derivative(&self, order: usize, state: &Vector<R>) -> R {
        dot(&self.derivatives[order], state)
    }
}

impl<R: Real> Local<R> {
    /// The state `time` after the grid point.
    pub fn state(&self, time: R) -> Vector<R> {
        let mut sum = [R::of(0.0); DIMENSION];
        for term in self.terms.iter().rev() {
            for (total, entry) in sum.iter_mut().zip(term) {
                *total = *total * time + *entry;
            }
        }
        sum
    }

    /// The coefficients of a functional as a polynomial in the time after the grid point.
    pub fn polynomial(&self, functional: &Functional<R>) -> Vec<R> {
        self.terms.iter().map(|term| functional.derivative(0, term)).collect()
    }
}

fn round<R: Real>(m: &Matrix<Dd>) -> Matrix<R> {
    m.map(|row| row.map(R::rounded))
}

/// e^M by its Taylor series, for ‖M‖ ≤ 1/4.
fn exponential(m: &Matrix<Dd>) -> Matrix<Dd> {
    let mut sum = identity();
    for k in (1..=<Dd as Real>::TERMS).rev() {
        sum = scale(&multiply(m, &sum), Dd::from(1.0) / Dd::from(k as f64));
        for (i, row) in sum.iter_mut().enumerate() {
            row[i] = row[i] + Dd::from(1.0);
        }
    }
    sum
}

/// M⁰, M¹, … M^(count−1), each from at most log2 products.
fn powers(m: &Matrix<Dd>, count: usize) -> Vec<Matrix<Dd>> {
    let mut powers = vec![identity(), *m];
    for k in 2..count.max(2) {
        powers.push(multiply(&powers[k / 2], &powers[k - k / 2]));
    }
    powers
}
