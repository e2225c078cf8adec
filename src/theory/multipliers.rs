//! Jacobians of whole motions, and their Floquet multipliers.

use nalgebra::{Complex, DMatrix, Schur};

use super::flow::Flow;
use super::newton::arcs;
use super::pattern::Pattern;
use super::section::Section;

/// The most sweeps of the eigenvalue iteration.
const MOST_SWEEPS: usize = 10_000;

/// A multiplier counts as within the unit circle below this modulus: a neutral one, as of the conservative system
/// (r = 1, ζ = 0), is not called stable by the chance of rounding.
pub(super) const STABLE: f64 = 1.0 - 1e-9;

/// The Jacobian of one turn around a motion on the section of its first impact: of one period, or of half of it
/// followed by the mirror where the pattern is mirrored.
///
/// It is the product of the Jacobians of its impacts. None where an impact grazes, since the map has no derivative there.
pub(crate) fn turn(flow: &Flow, pattern: &Pattern, sections: &[Section]) -> Option<DMatrix<f64>> {
    let mut product = DMatrix::identity(2 * flow.n, 2 * flow.n);
    for arc in arcs(flow, pattern, sections) {
        product = arc.jacobian()? * product;
    }
    let closed = pattern.reopening_matrix(flow) * product;
    closed.iter().all(|value| value.is_finite()).then_some(closed)
}

/// The eigenvalues, largest modulus first; of a complex pair the one with the positive imaginary part first.
pub(crate) fn eigenvalues(matrix: &DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let schur = Schur::try_new(matrix.clone(), f64::EPSILON, MOST_SWEEPS)?;
    Some(ordered(schur.complex_eigenvalues().as_slice().to_vec()))
}

/// The same numbers, largest modulus first; of a complex pair the one with the positive imaginary part first.
pub(super) fn ordered(mut values: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
    values.sort_by(|a, b| b.norm().total_cmp(&a.norm()).then(b.im.total_cmp(&a.im)));
    values
}
