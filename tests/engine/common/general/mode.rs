//! The motion with a set of contacts, as one linear system.

use impact_atlas::system::Plant;
use nalgebra::{DMatrix, SMatrix, SVector};

/// Entries of the augmented state: four displacements, four velocities, sin φ, cos φ, 1; unused ones stay 0.
pub const SIZE: usize = 11;
const SIN: usize = 8;
const COS: usize = 9;
const ONE: usize = 10;

/// The augmented state, or a linear functional of it.
pub type Augmented = SVector<f64, SIZE>;
type Generator = SMatrix<f64, SIZE, SIZE>;

/// The augmented state at forcing phase 0.
pub fn at_phase_zero(start: &[f64]) -> Augmented {
    let n = start.len() / 2;
    let mut z = Augmented::zeros();
    for i in 0..n {
        z[i] = start[i];
        z[4 + i] = start[n + i];
    }
    (z[COS], z[ONE]) = (1.0, 1.0);
    z
}

/// Sets the phase to 0, where rounding has moved it.
pub fn restore_phase(z: &mut Augmented) {
    (z[SIN], z[COS]) = (0.0, 1.0);
}

/// d·x as a functional.
pub fn place(direction: &[f64]) -> Augmented {
    let mut row = Augmented::zeros();
    direction.iter().enumerate().for_each(|(i, d)| row[i] = *d);
    row
}

/// d·v as a functional.
pub fn speed(direction: &[f64]) -> Augmented {
    let mut row = Augmented::zeros();
    direction.iter().enumerate().for_each(|(i, d)| row[4 + i] = *d);
    row
}

/// The motion while the stops `held` are in contact.
#[derive(Debug)]
pub struct Mode {
    /// The stops in contact.
    pub held: Vec<usize>,
    /// z' = generator z.
    pub generator: Generator,
    /// exp(generator · step).
    pub stepper: Generator,
    /// For each stop in contact, the force with which it is pressed, as a functional.
    pub forces: Vec<Augmented>,
    /// For each stop in contact, M⁻¹ Dᵀ (D M⁻¹ Dᵀ)⁻¹: what moves the masses by 1 along it and by 0 along the others.
    pub lifts: Vec<Vec<f64>>,
}

impl Mode {
    pub fn new(plant: &Plant, held: &[usize], step: f64) -> Self {
        let n = plant.n;
        let inverse = plant.mass.clone().try_inverse().unwrap();
        let mut pull = DMatrix::<f64>::zeros(n, SIZE);
        for i in 0..n {
            for j in 0..n {
                pull[(i, j)] = -plant.stiffness[(i, j)];
                pull[(i, 4 + j)] = -plant.damping[(i, j)];
            }
            (pull[(i, SIN)], pull[(i, COS)], pull[(i, ONE)]) =
                (plant.force_sin[i], plant.force_cos[i], plant.load[i]);
        }
        let directions = DMatrix::from_fn(held.len(), n, |s, i| plant.stops[held[s]].direction[i]);
        let (force, lift) = if held.is_empty() {
            (DMatrix::zeros(0, SIZE), DMatrix::zeros(n, 0))
        } else {
            let mobility = &directions * &inverse * directions.transpose();
            let compliance = mobility.try_inverse().unwrap();
            let lift = &inverse * directions.transpose() * &compliance;
            (compliance * &directions * &inverse * &pull, lift)
        };
        let acceleration = &inverse * (pull - directions.transpose() * &force);
        let mut generator = Generator::zeros();
        for i in 0..n {
            generator[(i, 4 + i)] = 1.0;
            for j in 0..SIZE {
                generator[(4 + i, j)] = acceleration[(i, j)];
            }
        }
        generator[(SIN, COS)] = plant.omega;
        generator[(COS, SIN)] = -plant.omega;
        Mode {
            held: held.to_vec(),
            generator,
            stepper: exponential(&(generator * step)),
            forces: force.row_iter().map(|row| Augmented::from_fn(|i, _| row[i])).collect(),
            lifts: lift.column_iter().map(|column| column.iter().copied().collect()).collect(),
        }
    }

    /// The Taylor coefficients of z(t), from the term of order 0 on.
    pub fn series<const TERMS: usize>(&self, z: &Augmented) -> [Augmented; TERMS] {
        let mut terms = [*z; TERMS];
        for k in 1..TERMS {
            terms[k] = self.generator * terms[k - 1] / k as f64;
        }
        terms
    }
}

/// exp(m) by scaling, its Taylor series, and squaring.
fn exponential(m: &Generator) -> Generator {
    let halvings = (m.norm().max(1e-3) * 8.0).log2().ceil().max(0.0) as i32;
    let scaled = m / 2.0_f64.powi(halvings);
    let mut term = Generator::identity();
    let mut sum = term;
    for k in 1..24 {
        term = term * scaled / f64::from(k);
        sum += term;
    }
    (0..halvings).fold(sum, |power, _| power * power)
}
