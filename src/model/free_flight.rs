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
    /// What sin φ, cos φ and 1 weigh beside displacements and velocities where a series is cut: 1, or less where loads accelerate far
    /// less than that.
    pub weight: f64,
}

/// What is as large as this is of order one.
pub(super) const LEAST: f64 = 0.25;

/// See [`FreeFlight::weight`]: a power of two.
fn weight<const N: usize>(loads: [&SVector<f64, N>; 3]) -> f64 {
    let largest = loads.iter().map(|load| load.amax()).fold(0.0, f64::max);
    if largest > 0.0 && largest < LEAST { libm::ldexp(1.0, libm::ilogb(largest)) } else { 1.0 }
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
        let loads = [&plant.force_sin, &plant.force_cos, &plant.load].map(vector);
        FreeFlight::under(-square(&plant.stiffness), -square(&plant.damping), loads, plant.omega)
    }

    /// That whose generator is G, (2N + 3) × (2N + 3): z' = G z with z = (x, v, sin φ, cos φ, 1).
    pub fn of_generator(generator: &DMatrix<f64>) -> Self {
        let block = |at: usize| SMatrix::from_fn(|i, j| generator[(N + i, at + j)]);
        let column = |j: usize| SVector::from_fn(|i, _| generator[(N + i, 2 * N + j)]);
        FreeFlight::under(block(0), block(N), [0, 1, 2].map(column), generator[(2 * N, 2 * N + 1)])
    }

    fn under(
        stiffness: SMatrix<f64, N, N>,
        damping: SMatrix<f64, N, N>,
        [sin, cos, load]: [SVector<f64, N>; 3],
        omega: f64,
    ) -> Self {
        let weight = weight([&sin, &cos, &load]);
        FreeFlight { stiffness, damping, sin, cos, load, omega, weight }
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
