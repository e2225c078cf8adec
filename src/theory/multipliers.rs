//! Jacobians of whole motions, and their Floquet multipliers.

use std::mem::swap;

use nalgebra::{Complex, ComplexField, DMatrix, Schur};

use super::flow::Flow;
use super::matching::Arc;
use super::newton::arcs;
use super::pattern::Pattern;
use super::section_vector::SectionVector;
use crate::system::Mooring;

/// The most sweeps of the eigenvalue iteration.
const MOST_SWEEPS: usize = 10_000;

/// A multiplier counts as within the unit circle below this modulus: a neutral one, as of the conservative system
/// (r = 1, ζ = 0), is not called stable by the chance of rounding.
pub(super) const STABLE: f64 = 1.0 - 1e-9;

/// The Jacobian of one turn around a motion on the section of its first impact: of one period, or of half of it
/// followed by the mirror where the pattern is mirrored.
///
/// It is the product of the Jacobians of its impacts. None where an impact grazes, since the map has no derivative there.
pub(crate) fn turn(flow: &Flow, pattern: &Pattern, sections: &[SectionVector]) -> Option<DMatrix<f64>> {
    turn_along(flow, pattern, &arcs(flow, pattern, sections))
}

/// The same of a motion whose arcs are known.
pub(crate) fn turn_along(flow: &Flow, pattern: &Pattern, arcs: &[Arc]) -> Option<DMatrix<f64>> {
    let mut closed = pattern.reopening_matrix(flow);
    for arc in arcs.iter().rev() {
        closed *= arc.jacobian()?;
    }
    closed.iter().all(|value| value.is_finite()).then_some(closed)
}

/// The eigenvalues, largest modulus first; of a complex pair the one with the positive imaginary part first.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let schur = Schur::try_new(matrix.clone(), f64::EPSILON, MOST_SWEEPS)?;
    Some(ordered(schur.complex_eigenvalues().as_slice().to_vec()))
}

/// The eigenvalues of a map over some forcing periods, without those of what holds the system where it may drift: for each of these
/// the nearest in modulus.
pub(super) fn multipliers(
    map: &DMatrix<f64>,
    periods: f64,
    mooring: Option<&Mooring>,
) -> Option<Vec<Complex<f64>>> {
    let mut values = eigenvalues(map)?;
    for exponent in mooring.into_iter().flat_map(|mooring| &mooring.exponents) {
        let modulus = libm::exp(exponent * periods);
        let off = |value: &Complex<f64>| (value.modulus() - modulus).abs();
        let nearest = (0..values.len()).min_by(|&i, &j| off(&values[i]).total_cmp(&off(&values[j])));
        values.remove(nearest?);
    }
    Some(values)
}

/// How many powers of a map are looked at, the 1st, 2nd, 4th and so on, to see that it contracts.
const MOST_POWERS: usize = 12;

/// Whether some power of a map surely shortens every vector, so that all its eigenvalues lie within the unit circle. Cheaper
/// than the eigenvalues; a map with one so close to the circle that its 2048th power is no shorter is not said to.
pub(super) fn contracts(map: DMatrix<f64>) -> bool {
    let (mut power, mut square) = (map.clone(), map);
    for _ in 0..MOST_POWERS {
        let size = power.norm();
        if size < STABLE {
            return true;
        }
        if !size.is_finite() {
            return false;
        }
        power.mul_to(&power, &mut square);
        swap(&mut power, &mut square);
    }
    false
}

/// The same numbers, largest modulus first; of a complex pair the one with the positive imaginary part first.
pub(super) fn ordered(mut values: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    values.sort_by(|a, b| b.modulus().total_cmp(&a.modulus()).then(b.im.total_cmp(&a.im)));
    values
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Stop;
    use crate::theory::example::Ball;

    #[test]
    fn the_jacobian_of_a_turn_of_the_bouncing_ball_is_that_of_its_closed_form() {
        for restitution in [0.5, 0.8, 1.0] {
            let ball = Ball { restitution, force: 0.5, ..Ball::STABLE };
            let system = ball.system();
            let pattern = Pattern::new(&system, vec![Stop::A], 2, false);
            for other in [false, true] {
                let section = ball.section(other).unwrap();
                let sections = [SectionVector::from_row_slice(&section)];
                let jacobian = turn(&Flow::new(&system), &pattern, &sections).unwrap();
                let expected = ball.jacobian(section);
                let away = (0..4).map(|k| (jacobian[(k / 2, k % 2)] - expected[(k / 2, k % 2)]).abs());
                let size = expected.amax();
                assert!(away.fold(0.0, f64::max) < 1e-12 * size, "{restitution}: {jacobian} for {expected}");
                // Volumes shrink by r² in an impact; without damping, flight leaves them.
                assert!((jacobian.determinant() - restitution * restitution).abs() < 1e-12 * size * size);
                let twin = ball.jacobian(ball.section(!other).unwrap());
                assert!((jacobian.trace() - twin.trace()).abs() > 0.1, "the check can fail");
            }
        }
    }

    #[test]
    fn a_map_contracts_where_its_eigenvalues_lie_within_the_unit_circle() {
        // A rotation and a shear that lengthen vectors at first.
        let map = |radius: f64| DMatrix::from_row_slice(2, 2, &[0.0, -9.0 * radius, radius / 9.0, 0.0]);
        for radius in [0.0, 0.5, 0.99, 0.9995] {
            assert!(contracts(map(radius)), "{radius}");
        }
        for radius in [1.0, 1.0001, 2.0, 1e200, f64::NAN] {
            assert!(!contracts(map(radius)), "{radius}");
        }
    }

    #[test]
    fn eigenvalues_come_by_modulus_and_of_a_pair_the_upper_one_first() {
        // Blocks with the eigenvalues ½ ± 2i, −3, 0.1 and 0, in another basis.
        let mut blocks = DMatrix::zeros(5, 5);
        blocks.view_mut((0, 0), (2, 2)).copy_from_slice(&[0.5, 2.0, -2.0, 0.5]);
        (blocks[(2, 2)], blocks[(3, 3)]) = (-3.0, 0.1);
        let basis = DMatrix::from_fn(5, 5, |i, j| if i == j { 2.0 } else { ((3 * i + j) as f64).sin() });
        let matrix = &basis * blocks * basis.clone().try_inverse().unwrap();
        let found = eigenvalues(&matrix).unwrap();
        let expected = [(-3.0, 0.0), (0.5, 2.0), (0.5, -2.0), (0.1, 0.0), (0.0, 0.0)];
        for (value, (re, im)) in found.iter().zip(expected) {
            assert!((value - Complex::new(re, im)).norm() < 1e-12, "{found:?}");
        }
    }
}
