//! The numbers of one cell: M x″ + C x′ + K x = s sin ωt + c cos ωt + l between rigid stops.

use nalgebra::{DMatrix, DVector, SMatrix};

use super::limits;
use super::near::near;
use super::plant_error::{Part, PlantError};
use super::sized::sized;
use super::stops::{self, PlantStop};

/// A linear oscillator with rigid stops, in numbers; non-dimensional unless the family says otherwise.
///
/// A plant is plain data. [`Plant::check`] holds it to what can be computed; every plant that a
/// [`Family`](super::Family) makes has passed.
#[derive(Clone, Debug, PartialEq)]
pub struct Plant {
    /// The coordinates, 1 to [`Plant::MOST_COORDINATES`].
    pub n: usize,
    /// M, n × n, invertible.
    pub mass: DMatrix<f64>,
    /// C, n × n; may be singular or not symmetric.
    pub damping: DMatrix<f64>,
    /// K, n × n; may be singular or not symmetric.
    pub stiffness: DMatrix<f64>,
    /// s, the amplitudes of sin ωt, n.
    pub force_sin: DVector<f64>,
    /// c, the amplitudes of cos ωt, n.
    pub force_cos: DVector<f64>,
    /// l, the constant load, n.
    pub load: DVector<f64>,
    /// ω, the forcing frequency, radians per unit of time.
    pub omega: f64,
    /// The stops, 1 to [`Plant::MOST_STOPS`], in the family's order.
    pub stops: Vec<PlantStop>,
}

impl Plant {
    /// The most coordinates.
    pub const MOST_COORDINATES: usize = limits::MOST_COORDINATES;
    /// The most stops.
    pub const MOST_STOPS: usize = limits::MOST_STOPS;
    /// The mass matrix, its rows and columns brought to the same size, has at least this reciprocal condition.
    pub const LEAST_CONDITION: f64 = limits::LEAST_CONDITION;

    /// Holds the plant to what can be computed.
    ///
    /// # Errors
    /// The first of: too many coordinates or stops, a wrong shape, a number that is not finite, ω ≤ 0, a mass matrix
    /// that is singular or nearly so (whatever the units of its rows), restitution outside [0, 1], a direction that
    /// is zero or that an impact cannot turn back (dᵀM⁻¹d ≤ 0), two stops on the same side of the same line, two
    /// opposed stops that no state satisfies (touching ones, whose gaps sum to 0, clamp and are allowed),
    /// directions that are linearly dependent without being parallel, and a symmetric mass matrix by which some motion has a
    /// kinetic energy below zero.
    pub fn check(&self) -> Result<(), PlantError> {
        self.check_counts()?;
        self.check_shapes()?;
        self.check_finite()?;
        if self.omega <= 0.0 {
            return Err(PlantError::Frequency(self.omega));
        }
        sized!(self.n, N of 1 2 3 4: self.check_geometry::<N>(), else unreachable!("counted before"))
    }

    /// Its mass matrix and its stops.
    fn check_geometry<const N: usize>(&self) -> Result<(), PlantError> {
        let mass = SMatrix::<f64, N, N>::from_column_slice(self.mass.as_slice());
        let inverse = inverse_mass(&mass)?;
        for (stop, PlantStop { restitution, .. }) in self.stops.iter().enumerate() {
            if !(0.0..=1.0).contains(restitution) {
                return Err(PlantError::Restitution { stop, value: *restitution });
            }
        }
        stops::check(&self.stops, &inverse)?;
        // Of a mass matrix that is not symmetric ½ vᵀMv is no energy.
        if is_symmetric(&mass) && mass.cholesky().is_none() {
            return Err(PlantError::IndefiniteMass(self.mass.symmetric_eigenvalues().min()));
        }
        Ok(())
    }

    /// The forcing period T = 2π/ω.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }

    fn check_counts(&self) -> Result<(), PlantError> {
        if !(1..=Self::MOST_COORDINATES).contains(&self.n) {
            return Err(PlantError::Coordinates(self.n));
        }
        if !(1..=Self::MOST_STOPS).contains(&self.stops.len()) {
            return Err(PlantError::Stops(self.stops.len()));
        }
        Ok(())
    }

    fn arrays(&self) -> impl Iterator<Item = Array<'_>> {
        let matrices =
            [(Part::Mass, &self.mass), (Part::Damping, &self.damping), (Part::Stiffness, &self.stiffness)];
        let loads =
            [(Part::ForceSin, &self.force_sin), (Part::ForceCos, &self.force_cos), (Part::Load, &self.load)];
        let directions = self.stops.iter().enumerate().map(|(i, stop)| (Part::Direction(i), &stop.direction));
        let n = self.n;
        let matrices = matrices.into_iter().map(move |(part, m)| Array {
            part,
            shape: m.shape(),
            wanted: (n, n),
            entries: m.as_slice(),
        });
        let vectors = loads.into_iter().chain(directions).map(move |(part, v)| Array {
            part,
            shape: v.shape(),
            wanted: (n, 1),
            entries: v.as_slice(),
        });
        matrices.chain(vectors)
    }

    fn check_shapes(&self) -> Result<(), PlantError> {
        match self.arrays().find(|array| array.shape != array.wanted) {
            Some(Array { part, shape: (rows, columns), wanted, .. }) => {
                Err(PlantError::Shape { part, rows, columns, wanted })
            }
            None => Ok(()),
        }
    }

    fn check_finite(&self) -> Result<(), PlantError> {
        let scalars = self
            .stops
            .iter()
            .enumerate()
            .flat_map(|(i, stop)| [(Part::Gap(i), stop.gap), (Part::Restitution(i), stop.restitution)]);
        let entries = self.arrays().flat_map(|array| array.entries.iter().map(move |&x| (array.part, x)));
        let mut all = std::iter::once((Part::Frequency, self.omega)).chain(entries).chain(scalars);
        match all.find(|(_, value)| !value.is_finite()) {
            Some((part, value)) => Err(PlantError::NotFinite { part, value }),
            None => Ok(()),
        }
    }
}

/// A matrix or a vector of a plant.
struct Array<'a> {
    part: Part,
    shape: (usize, usize),
    /// The shape that it must have.
    wanted: (usize, usize),
    entries: &'a [f64],
}

const _: () = assert!(Plant::MOST_COORDINATES == 4, "the sizes of which `Plant::check` knows the inverse");

/// M⁻¹, where M has one that can be computed with.
fn inverse_mass<const N: usize>(mass: &SMatrix<f64, N, N>) -> Result<SMatrix<f64, N, N>, PlantError> {
    let condition = condition(mass);
    if condition.is_nan() || condition < Plant::LEAST_CONDITION {
        return Err(PlantError::SingularMass(condition));
    }
    let inverse = mass.try_inverse().filter(|inverse| inverse.iter().all(|entry| entry.is_finite()));
    inverse.ok_or(PlantError::LightMass)
}

/// Whether a matrix is its own transpose, but for rounding.
fn is_symmetric<const N: usize>(matrix: &SMatrix<f64, N, N>) -> bool {
    matrix.iter().zip(matrix.transpose().iter()).all(|(&a, &b)| near(a, b))
}

/// The reciprocal condition of a square matrix in the norm of the largest row sum, once each row and then each
/// column has the largest entry 1; 0 where it is singular.
fn condition<const N: usize>(matrix: &SMatrix<f64, N, N>) -> f64 {
    let mut scaled = *matrix;
    for mut row in scaled.row_iter_mut() {
        let size = row.amax();
        row /= size;
    }
    for mut column in scaled.column_iter_mut() {
        let size = column.amax();
        column /= size;
    }
    let norm = |m: &SMatrix<f64, N, N>| {
        m.row_iter().map(|row| row.iter().map(|x| x.abs()).sum()).fold(0.0, f64::max)
    };
    let Some(inverse) = scaled.try_inverse() else { return 0.0 };
    let reciprocal = 1.0 / (norm(&scaled) * norm(&inverse));
    if reciprocal.is_finite() { reciprocal } else { 0.0 }
}
