//! The stops of a plant, and how they stand to each other.

use arrayvec::ArrayVec;
use nalgebra::{DVector, SMatrix, SVector};

use super::limits;
use super::plant_error::PlantError;

/// A rigid stop: the motion keeps direction · x ≤ gap, and touches the stop where they are equal.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantStop {
    /// d, the direction, n; of a length between 1e-9 and 1e9, about 1 if possible: gaps and velocities are in its unit.
    pub direction: DVector<f64>,
    /// The value of direction · x at contact, of any sign.
    pub gap: f64,
    /// The coefficient of restitution, 0 to 1: v⁺ = v⁻ − (1 + r)(d·v⁻) M⁻¹d / (dᵀM⁻¹d).
    pub restitution: f64,
}

impl PlantStop {
    /// The coordinate c, from 0, whose displacement follows from the others at the stop, d·x being the gap, and whose velocity is the first
    /// component of a point on the section there: the first of those with the largest |d_c|.
    pub fn own_coordinate(&self) -> usize {
        own_coordinate(&self.direction)
    }
}

/// [`PlantStop::own_coordinate`] of a direction.
pub(crate) fn own_coordinate(direction: &DVector<f64>) -> usize {
    let largest = direction.amax() * (1.0 - EQUAL);
    direction.iter().position(|d| d.abs() >= largest).unwrap_or(0)
}

/// Entries of a direction that differ by less than this share count as equal; expressions round by some ulps.
const EQUAL: f64 = 1e-9;

/// What may differ in a stop among plants with the same flow.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StopValues {
    /// The value of direction · x at contact, of any sign.
    pub gap: f64,
    /// The coefficient of restitution, 0 to 1.
    pub restitution: f64,
}

impl StopValues {
    /// Those of a stop.
    pub fn of(stop: &PlantStop) -> Self {
        StopValues { gap: stop.gap, restitution: stop.restitution }
    }

    /// Their bits.
    pub fn bits(&self) -> [u64; 2] {
        [self.gap, self.restitution].map(f64::to_bits)
    }
}

/// Unit directions that differ by less than this are the same; expressions round by some ulps.
const SAME: f64 = 1e-12;

/// A unit direction that lies this close to the span of others depends on them.
const INDEPENDENT: f64 = 1e-8;

/// dᵀM⁻¹d is positive where it is more than this share of the sum of its terms' moduli.
const POSITIVE: f64 = 1e-12;

/// A stop with its direction brought to length 1.
struct Line<const N: usize> {
    unit: SVector<f64, N>,
    gap: f64,
}

/// Holds the stops of one plant, of finite numbers, to what can be computed, given M⁻¹.
///
/// # Errors
/// See [`Plant::check`](super::Plant::check).
pub(super) fn check<const N: usize>(
    stops: &[PlantStop],
    inverse_mass: &SMatrix<f64, N, N>,
) -> Result<(), PlantError> {
    let mut lines: ArrayVec<Line<N>, { limits::MOST_STOPS }> = ArrayVec::new();
    for (stop, PlantStop { direction, gap, .. }) in stops.iter().enumerate() {
        let size = direction.amax();
        if size == 0.0 {
            return Err(PlantError::NoDirection(stop));
        }
        let scaled = SVector::<f64, N>::from_column_slice(direction.as_slice()) / size;
        // dᵀM⁻¹d, and the sum of its terms' moduli.
        let (mut value, mut terms) = (0.0, 0.0);
        for (column, d) in inverse_mass.column_iter().zip(&scaled) {
            for (entry, own) in column.iter().zip(&scaled) {
                let term = own * entry * d;
                (value, terms) = (value + term, terms + term.abs());
            }
        }
        if value <= POSITIVE * terms {
            return Err(PlantError::NoImpulse { stop, value: value * size * size });
        }
        let length = scaled.norm();
        if !(limits::SHORTEST_DIRECTION..=limits::LONGEST_DIRECTION).contains(&(size * length)) {
            return Err(PlantError::DirectionLength { stop, length: size * length });
        }
        let line = Line { unit: scaled / length, gap: gap / size / length };
        if line.gap.abs() > limits::FARTHEST_STOP {
            return Err(PlantError::TooFar { stop, value: *gap });
        }
        lines.push(line);
    }
    check_pairs(&lines)?;
    check_independence(&lines)
}

/// 1 for two lines of the same direction, −1 for opposed ones.
fn sense<const N: usize>(a: &SVector<f64, N>, b: &SVector<f64, N>) -> Option<f64> {
    let sign = a.dot(b).signum();
    a.iter().zip(b).all(|(a, b)| (a - b * sign).abs() <= SAME).then_some(sign)
}

fn check_pairs<const N: usize>(lines: &[Line<N>]) -> Result<(), PlantError> {
    for (second, line) in lines.iter().enumerate() {
        for (first, other) in lines[..second].iter().enumerate() {
            let room = line.gap + other.gap;
            let rounding = 4.0 * f64::EPSILON * (line.gap.abs() + other.gap.abs());
            match sense(&line.unit, &other.unit) {
                Some(1.0) => return Err(PlantError::SameSide { first, second }),
                Some(_) if room < -rounding => {
                    return Err(PlantError::NoRoom { first, second, overlap: -room });
                }
                _ => {}
            }
        }
    }
    Ok(())
}

/// Directions, parallel ones counted once, must be linearly independent.
fn check_independence<const N: usize>(lines: &[Line<N>]) -> Result<(), PlantError> {
    let mut basis: ArrayVec<SVector<f64, N>, { limits::MOST_STOPS }> = ArrayVec::new();
    for (stop, line) in lines.iter().enumerate() {
        if lines[..stop].iter().any(|other| sense(&line.unit, &other.unit).is_some()) {
            continue;
        }
        let mut rest = line.unit;
        for axis in &basis {
            let along = axis.dot(&rest);
            rest -= axis * along;
        }
        if rest.norm() <= INDEPENDENT {
            return Err(PlantError::Dependent(stop));
        }
        basis.push(rest.normalize());
    }
    Ok(())
}
