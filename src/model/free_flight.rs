//! The equations of motion between impacts, solved for the accelerations.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

use crate::system::Plant;

/// x″ = A x + B v + s sin φ + c cos φ + l, φ = ωt; everything is non-dimensional.
///
/// A = −M⁻¹K and B = −M⁻¹C may be any matrices: no modes are formed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeFlight<const N: usize> {
    /// A = −M⁻¹K.
    pub stiffness: SMatrix<f64, N, N>,
    /// B = −M⁻¹C.
    pub damping: SMatrix<f64, N, N>,
    /// M⁻¹ times the load of sin φ.
    pub sin: SVector<f64, N>,
    /// M⁻¹ times the load of cos φ.
    pub cos: SVector<f64, N>,
    /// M⁻¹ times the constant load.
    pub load: SVector<f64, N>,
    /// ω.
    pub omega: f64,
}

/// M⁻¹ of a plant with N coordinates.
///
/// # Panics
/// If an invertible mass matrix was not made sure of.
pub(super) fn inverse_mass<const N: usize>(plant: &Plant) -> SMatrix<f64, N, N> {
    let inverse = SMatrix::<f64, N, N>::from_fn(|i, j| plant.mass[(i, j)]).try_inverse();
    inverse.expect("a plant's mass matrix was checked to be invertible")
}

impl<const N: usize> FreeFlight<N> {
    /// That of a plant with N coordinates, given M⁻¹.
    pub fn of(plant: &Plant, inverse_mass: &SMatrix<f64, N, N>) -> Self {
        let square = |m: &DMatrix<f64>| inverse_mass * SMatrix::<f64, N, N>::from_fn(|i, j| m[(i, j)]);
        let vector = |v: &DVector<f64>| inverse_mass * SVector::<f64, N>::from_fn(|i, _| v[i]);
        FreeFlight {
            stiffness: -square(&plant.stiffness),
            damping: -square(&plant.damping),
            sin: vector(&plant.force_sin),
            cos: vector(&plant.force_cos),
            load: vector(&plant.load),
            omega: plant.omega,
        }
    }

    /// That whose generator is G, (2N + 3) × (2N + 3): z' = G z with z = (x, v, sin φ, cos φ, 1).
    pub fn of_generator(generator: &DMatrix<f64>) -> Self {
        let block = |at: usize| SMatrix::from_fn(|i, j| generator[(N + i, at + j)]);
        let column = |j: usize| SVector::from_fn(|i, _| generator[(N + i, 2 * N + j)]);
        FreeFlight {
            stiffness: block(0),
            damping: block(N),
            sin: column(0),
            cos: column(1),
            load: column(2),
            omega: generator[(2 * N, 2 * N + 1)],
        }
    }

    /// The block of G that belongs to (x, v), 2N × 2N: the generator of flight without forcing and load.
    pub fn unforced(&self) -> DMatrix<f64> {
        let mut g = DMatrix::zeros(2 * N, 2 * N);
        g.view_mut((0, N), (N, N)).fill_with_identity();
        g.view_mut((N, 0), (N, N)).copy_from(&self.stiffness);
        g.view_mut((N, N), (N, N)).copy_from(&self.damping);
        g
    }

    /// G.
    pub fn generator(&self) -> DMatrix<f64> {
        let mut g = self.unforced().resize(2 * N + 3, 2 * N + 3, 0.0);
        for (k, load) in [&self.sin, &self.cos, &self.load].into_iter().enumerate() {
            g.view_mut((N, 2 * N + k), (N, 1)).copy_from(load);
        }
        g[(2 * N, 2 * N + 1)] = self.omega;
        g[(2 * N + 1, 2 * N)] = -self.omega;
        g
    }
}
