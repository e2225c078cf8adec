//! Motion without impact: the forced response, what bounds a deviation from it, and how fast that decays.

use nalgebra::{Complex, ComplexField, DMatrix, DVector, SMatrix, SVector};

use super::equations::Equations;
use super::free_flight::FreeFlight;
use crate::system::{Plant, sized};

/// The periodic response to the loads, without impact; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForcedResponse<const N: usize> {
    /// The constant part.
    pub mean: SVector<f64, N>,
    /// x = mean + Re(amplitude·e^{iφ}).
    pub amplitude: SVector<Complex<f64>, N>,
    /// v at phase 0.
    pub velocity: SVector<f64, N>,
}

impl<const N: usize> ForcedResponse<N> {
    /// The response of a system; none at an undamped resonance, or where the constant load meets no stiffness.
    pub fn of(free: &FreeFlight<N>) -> Option<Self> {
        let omega = free.omega;
        let dynamic = SMatrix::<Complex<f64>, N, N>::from_fn(|i, j| {
            let inertia = if i == j { omega * omega } else { 0.0 };
            -Complex::new(inertia + free.stiffness[(i, j)], omega * free.damping[(i, j)])
        });
        let load = free.cos.zip_map(&free.sin, |c, s| Complex::new(c, -s));
        let still = load.iter().all(|value| value.modulus() == 0.0);
        let amplitude = if still { load } else { inverse(&dynamic)? * load };
        let mean =
            if free.load.amax() == 0.0 { SVector::zeros() } else { -(inverse(&free.stiffness)? * free.load) };
        let velocity = amplitude.map(|value| -omega * value.im);
        let finite = amplitude.iter().all(|value| value.modulus().is_finite())
            && mean.iter().all(|value| value.is_finite());
        finite.then_some(ForcedResponse { mean, amplitude, velocity })
    }

    /// x at phase 0.
    pub fn displacement(&self) -> SVector<f64, N> {
        self.mean + self.amplitude.map(|value| value.re)
    }

    /// The largest row · x over the period.
    pub fn largest(&self, row: &SVector<f64, N>) -> f64 {
        let swing: Complex<f64> = row.iter().zip(self.amplitude.iter()).map(|(d, x)| x * *d).sum();
        row.dot(&self.mean) + swing.modulus()
    }
}

/// The inverse of a matrix, compiled once for all sizes.
fn inverse<T: ComplexField + Copy, const N: usize>(matrix: &SMatrix<T, N, N>) -> Option<SMatrix<T, N, N>> {
    let inverse = DMatrix::from_column_slice(N, N, matrix.as_slice()).try_inverse()?;
    Some(SMatrix::from_column_slice(inverse.as_slice()))
}

/// A quadratic form yᵀPy, P = RᵀR, that no free deviation y = (x, v) from the forced response lets grow: twice the energy
/// where the matrices are symmetric, a Lyapunov function of the decaying motion elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trap<const N: usize> {
    /// R's upper left block: of x in the first N rows.
    pub xx: SMatrix<f64, N, N>,
    /// R's upper right block: of v in the first N rows.
    pub xv: SMatrix<f64, N, N>,
    /// R's lower right block: of v in the last N rows; that of x is 0.
    pub vv: SMatrix<f64, N, N>,
    /// The block of P⁻¹ that belongs to x.
    pub compliance: SMatrix<f64, N, N>,
}

impl<const N: usize> Trap<N> {
    /// The form of a plant; none where free motion may grow without bound.
    pub fn of(plant: &Plant, equations: &Equations<N>) -> Option<Self> {
        Trap::factored(&energy(plant).or_else(|| lyapunov(&equations.unforced()))?)
    }

    fn factored(form: &DMatrix<f64>) -> Option<Self> {
        let cholesky = form.clone().cholesky()?;
        let r = cholesky.l().transpose();
        let inverse = cholesky.inverse();
        let block = |m: &DMatrix<f64>, i: usize, j: usize| {
            SMatrix::<f64, N, N>::from_fn(|a, b| m[(i * N + a, j * N + b)])
        };
        let trap = Trap {
            xx: block(&r, 0, 0),
            xv: block(&r, 0, 1),
            vv: block(&r, 1, 1),
            compliance: block(&inverse, 0, 0),
        };
        trap.compliance.iter().all(|value| value.is_finite()).then_some(trap)
    }

    /// The largest row · x per square root of the form.
    pub fn stretch(&self, row: &SVector<f64, N>) -> f64 {
        row.dot(&(self.compliance * row)).sqrt()
    }
}

/// Twice the energy, where it is one: K and M symmetric and positive definite, C at least not driving.
fn energy(plant: &Plant) -> Option<DMatrix<f64>> {
    let n = plant.n;
    let symmetric = |m: &DMatrix<f64>| *m == m.transpose();
    if ![&plant.mass, &plant.stiffness, &plant.damping].into_iter().all(symmetric) {
        return None;
    }
    let slack = 1e-14 * plant.damping.amax();
    let softest = plant.damping.clone().symmetric_eigenvalues().min();
    if softest < -slack {
        return None;
    }
    let mut form = DMatrix::zeros(2 * n, 2 * n);
    form.view_mut((0, 0), (n, n)).copy_from(&plant.stiffness);
    form.view_mut((n, n), (n, n)).copy_from(&plant.mass);
    form.clone().cholesky().map(|_| form)
}

/// The solution of GᵀP + PG = −1, where every free motion decays.
fn lyapunov(g: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if slowest(g) >= 0.0 {
        return None;
    }
    let size = g.nrows();
    let one = DMatrix::<f64>::identity(size, size);
    let transposed = g.transpose();
    let matrix = transposed.kronecker(&one) + one.kronecker(&transposed);
    let right = DVector::from_iterator(size * size, one.iter().map(|value| -value));
    let form = DMatrix::from_column_slice(size, size, matrix.lu().solve(&right)?.as_slice());
    Some((&form + form.transpose()) * 0.5)
}

/// The largest real part of the eigenvalues: the slowest decay.
pub fn slowest(g: &DMatrix<f64>) -> f64 {
    let real =
        |values: &[Complex<f64>]| values.iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
    sized!(g.nrows(), N of 2 4 6 8:
        real(SMatrix::<f64, N, N>::from_column_slice(g.as_slice()).complex_eigenvalues().as_slice()),
        else real(g.complex_eigenvalues().as_slice()))
}
