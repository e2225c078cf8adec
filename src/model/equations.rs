//! The equations of motion and the geometry of the contacts.

use std::ops::Deref;

use arrayvec::ArrayVec;
use nalgebra::{DMatrix, SMatrix, SVector};

use super::free_flight::{FreeFlight, inverse_mass};
use super::vector::MOST;
use crate::system::Plant;

/// Free flight, and where the stops are; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equations<const N: usize> {
    /// The motion between impacts.
    pub free: FreeFlight<N>,
    /// The contact normals, as many as there are.
    pub normals: [Normal<N>; MOST],
    /// How many normals there are.
    pub count: usize,
}

/// A contact normal: a direction d in which masses meet a stop at one end, or at both.
///
/// Stops whose directions are parallel share one. An impact changes v along the response M⁻¹d/(dᵀM⁻¹d), by as much as
/// d·v changes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Normal<const N: usize> {
    /// d, the direction of the first stop on this line.
    pub direction: SVector<f64, N>,
    /// M⁻¹d/(dᵀM⁻¹d).
    pub response: SVector<f64, N>,
    /// 1/(dᵀM⁻¹d), the mass that an impact along d moves: it takes ½ (1 − r²) of this times (d·v−)².
    pub mass: f64,
    /// The stops met where d·x grows, and where it falls.
    pub ends: [Option<End>; 2],
}

impl<const N: usize> Normal<N> {
    /// Lets stops that differ by rounding alone touch each other: they clamp the masses.
    fn close(&mut self) {
        if let [Some(upper), Some(lower)] = &mut self.ends {
            lower.gap = closed([upper.gap, lower.gap]);
        }
    }
}

/// The gap at the lower end of a normal: what closes it exactly where rounding alone leaves it open.
pub(super) fn closed([upper, lower]: [f64; 2]) -> f64 {
    if leave_no_room([upper, lower]) { -upper } else { lower }
}

/// Whether rounding alone is between the stops at the two ends of a line, whose gaps are these.
pub(crate) fn leave_no_room([upper, lower]: [f64; 2]) -> bool {
    (upper + lower).abs() <= 8.0 * f64::EPSILON * (upper.abs() + lower.abs())
}

/// A stop at one end of a contact normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// Which of the plant's stops it is.
    pub stop: usize,
    /// Where d·x (at the lower end −d·x) meets it.
    pub gap: f64,
    /// r, its coefficient of restitution.
    pub restitution: f64,
}

impl<const N: usize> Deref for Equations<N> {
    type Target = FreeFlight<N>;

    fn deref(&self) -> &FreeFlight<N> {
        &self.free
    }
}

impl<const N: usize> Equations<N> {
    /// The equations of a plant with N coordinates.
    ///
    /// # Panics
    /// If the plant has another number of coordinates, or an invertible mass matrix was not made sure of.
    pub fn new(plant: &Plant) -> Self {
        assert_eq!(plant.n, N, "a plant with {} coordinates", plant.n);
        let inverse = inverse_mass(plant);
        let free = FreeFlight::of(plant, &inverse);
        let none =
            Normal { direction: SVector::zeros(), response: SVector::zeros(), mass: 0.0, ends: [None; 2] };
        let mut equations = Equations { free, normals: [none; MOST], count: 0 };
        for (stop, given) in plant.stops.iter().enumerate() {
            let direction = SVector::from_fn(|i, _| given.direction[i]);
            let (normal, scale) = equations.normal_along(&inverse, direction);
            let end = End { stop, gap: given.gap / scale.abs(), restitution: given.restitution };
            let place = &mut equations.normals[normal].ends[usize::from(scale < 0.0)];
            *place = Some(end);
        }
        equations.normals.iter_mut().for_each(Normal::close);
        equations
    }

    /// The normal along a direction, a new one if there is none yet, and the direction in units of it.
    fn normal_along(&mut self, inverse: &SMatrix<f64, N, N>, direction: SVector<f64, N>) -> (usize, f64) {
        for (k, normal) in self.normals[..self.count].iter().enumerate() {
            let [own, other] = [&direction, &normal.direction].map(|d| d.as_slice());
            if are_parallel(own, other) {
                return (k, stretch(own, other));
            }
        }
        let response = inverse * direction;
        let mass = 1.0 / direction.dot(&response);
        let response = response / direction.dot(&response);
        self.normals[self.count] = Normal { direction, response, mass, ends: [None; 2] };
        self.count += 1;
        (self.count - 1, 1.0)
    }

    /// The normals.
    pub fn normals(&self) -> &[Normal<N>] {
        &self.normals[..self.count]
    }

    /// How the pressing on the contacts `held` (bit k for normal k) follows from the accelerations d·a that the masses
    /// would have without them: row s of the matrix gives that on normal s, as an acceleration along it.
    ///
    /// The accelerations with the contacts are a − Σₛ responseₛ pressingₛ. None where the normals depend on each other.
    pub fn pressing(&self, held: u32) -> Option<SMatrix<f64, MOST, MOST>> {
        let members: ArrayVec<usize, MOST> = (0..self.count).filter(|k| held >> k & 1 == 1).collect();
        if members.is_empty() {
            return Some(SMatrix::zeros());
        }
        // coupling[t][s] = d_t · response_s.
        let coupling = DMatrix::from_fn(members.len(), members.len(), |t, s| {
            self.normals[members[t]].direction.dot(&self.normals[members[s]].response)
        });
        let inverse = coupling.try_inverse()?;
        let mut pressing = SMatrix::<f64, MOST, MOST>::zeros();
        for (s, &row) in members.iter().enumerate() {
            for (t, &column) in members.iter().enumerate() {
                pressing[(row, column)] = inverse[(s, t)];
            }
        }
        pressing.iter().all(|value| value.is_finite()).then_some(pressing)
    }

    /// The projector on what the contacts `held` leave free: 1 − Σ responseₛ pressingₛₜ d_tᵀ.
    pub fn projector(&self, pressing: &SMatrix<f64, MOST, MOST>) -> SMatrix<f64, N, N> {
        let mut projector = SMatrix::<f64, N, N>::identity();
        for s in 0..self.count {
            for t in 0..self.count {
                let (response, direction) = (&self.normals[s].response, &self.normals[t].direction);
                projector.ger(-pressing[(s, t)], response, direction, 1.0);
            }
        }
        projector
    }

    /// The equations while masses rest on a stop along one normal, and on no other: of motions that have no speed along it.
    pub fn held_along(&self, normal: usize) -> Self {
        let Normal { direction, response, .. } = self.normals[normal];
        let projector = SMatrix::identity() - response * direction.transpose();
        let free = FreeFlight {
            stiffness: projector * self.stiffness,
            damping: projector * self.damping,
            sin: projector * self.sin,
            cos: projector * self.cos,
            load: projector * self.load,
            omega: self.omega,
            weight: self.weight,
        };
        Equations { free, ..*self }
    }

    /// The steepest rate of the flow: ω, or ‖G⁸‖^(1/8) of the unforced generator G; not a number where G holds what is
    /// none.
    pub fn rate(&self) -> f64 {
        let FreeFlight { stiffness, damping, omega, .. } = self.free;
        if !stiffness.iter().chain(damping.iter()).all(|entry| entry.is_finite()) {
            return f64::NAN;
        }
        // Scaled by a power of two, about as fast as the flow: then powers neither overflow nor vanish.
        let fast = stiffness.amax().sqrt().max(damping.amax()).max(1.0);
        let scale = 2.0_f64.powi(libm::ilogb(fast));
        let one = SMatrix::<f64, N, N>::identity();
        let mut power = [[SMatrix::zeros(), one / scale], [stiffness / scale, damping / scale]];
        for _ in 0..3 {
            power = squared(&power);
        }
        let fastest = scale * norm(&power).sqrt().sqrt().sqrt();
        // Not `max`, which ignores NaN.
        if fastest < omega { omega } else { fastest }
    }
}

/// A matrix of 2N × 2N by its blocks, row by row.
type Blocks<const N: usize> = [[SMatrix<f64, N, N>; 2]; 2];

/// The square of a matrix.
fn squared<const N: usize>(g: &Blocks<N>) -> Blocks<N> {
    let mut square = [[SMatrix::zeros(); 2]; 2];
    for (rows, left) in square.iter_mut().zip(g) {
        for (j, block) in rows.iter_mut().enumerate() {
            for (left, right) in left.iter().zip([&g[0][j], &g[1][j]]) {
                for column in 0..N {
                    for row in 0..N {
                        for k in 0..N {
                            block[(row, column)] += left[(row, k)] * right[(k, column)];
                        }
                    }
                }
            }
        }
    }
    square
}

/// The square root of the sum of the squares of all entries.
fn norm<const N: usize>([upper, lower]: &Blocks<N>) -> f64 {
    let of_column = |k: usize, j: usize| -> f64 {
        upper[k].column(j).iter().chain(lower[k].column(j).iter()).map(|x| x * x).sum()
    };
    (0..2 * N).map(|i| of_column(i / N, i % N)).sum::<f64>().sqrt()
}

/// The length of a direction along another in units of that one, with its sign.
pub fn stretch(direction: &[f64], other: &[f64]) -> f64 {
    // From left to right, in whatever the directions lie: cells with the same flow have the same bits.
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    dot(direction, other) / dot(other, other)
}

/// Whether two directions lie along the same line.
pub fn are_parallel(direction: &[f64], other: &[f64]) -> bool {
    let scale = stretch(direction, other);
    let most = PARALLEL * direction.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    direction.iter().zip(other).all(|(own, other)| (own - other * scale).abs() <= most)
}

/// Directions whose difference is below this share of their length are parallel.
const PARALLEL: f64 = 1e-12;

#[cfg(test)]
mod tests {
    use crate::model::example::{coupled, for_every_size};

    fn is_the_root_of_a_norm<const N: usize>() {
        let mut equations = coupled::<N>();
        equations.free.omega = 0.1;
        let power = (0..3).fold(equations.unforced(), |power, _| &power * &power);
        let rate = power.norm().powf(0.125);
        assert!((equations.rate() / rate - 1.0).abs() < 1e-14, "{N} coordinates");
        let mut transposed = equations;
        transposed.free.stiffness.transpose_mut();
        assert!(N == 1 || (transposed.rate() / rate - 1.0).abs() > 1e-6, "the check can fail");
        equations.free.omega = 2.0 * rate;
        assert_eq!(equations.rate(), 2.0 * rate, "the forcing is faster");
        equations.free.damping[(N - 1, 0)] = f64::INFINITY;
        assert!(equations.rate().is_nan());
        // Of any size.
        equations.free.damping.fill(0.0);
        for stiffness in [1e10_f64, 1e22, 1e40, 1e80, 2e300] {
            equations.free.stiffness.fill_with_identity();
            equations.free.stiffness *= stiffness;
            let share = equations.rate() / stiffness.sqrt();
            assert!((0.5..2.0 * N as f64).contains(&share), "{share} at {stiffness}");
        }
    }

    #[test]
    fn the_rate_is_the_eighth_root_of_the_norm_of_an_eighth_power() {
        for_every_size!(is_the_root_of_a_norm);
    }
}
