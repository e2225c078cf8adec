//! Linear equations for one unknown more than there are of them: their solutions are a straight line.

use nalgebra::{DMatrix, DVector, SMatrix, SVector};

/// The solutions u of M u = b for each of some b: a point, and along a direction from it.
#[derive(Clone, Debug)]
pub(super) struct Solutions {
    /// Of each b the solution nearest to 0.
    pub points: [DVector<f64>; 2],
    /// M times this is 0; of unit length, with the orientation of the cross product of M's rows.
    pub direction: DVector<f64>,
}

/// A row counts as depending on those before it where no more of it is left than this share: rounding.
const DEPENDENT: f64 = 16.0 * f64::EPSILON;

/// Solves M u = b by a factorization Mᵀ = QR; none where M's rows depend on each other.
///
/// # Panics
/// If M is not of 2n rows and 2n + 1 columns, for n of 1 to 4.
pub(super) fn solved(matrix: &DMatrix<f64>, right: [&DVector<f64>; 2]) -> Option<Solutions> {
    macro_rules! of_shape {
        ($($rows:literal $columns:literal),*) => {
            match matrix.shape() {
                $(($rows, $columns) => {
                    let transposed = SMatrix::<f64, $columns, $rows>::from_fn(|i, j| matrix[(j, i)]);
                    let factors = transposed.qr();
                    let (q, r) = (factors.q(), factors.r());
                    let depends = |k: usize| r[(k, k)].abs() <= DEPENDENT * r.column(k).norm();
                    if (0..$rows).any(depends) {
                        return None;
                    }
                    let point = |right: &DVector<f64>| {
                        let right = SVector::<f64, $rows>::from_column_slice(right.as_slice());
                        Some(q * r.tr_solve_upper_triangular(&right)?)
                    };
                    let points = [point(right[0])?, point(right[1])?];
                    // What Q leaves of the axis that is farthest from its columns, freed of what rounding leaves of them.
                    let far = (0..$columns).min_by(|&i, &j| q.row(i).norm().total_cmp(&q.row(j).norm()))?;
                    let rest = SVector::<f64, $columns>::ith(far, 1.0) - q * q.row(far).transpose();
                    let rest = rest - q * q.tr_mul(&rest);
                    let square = SMatrix::<f64, $columns, $columns>::from_fn(|i, j| match j {
                        0 => rest[i],
                        _ => transposed[(i, j - 1)],
                    });
                    let direction = rest * (square.determinant().signum() / rest.norm());
                    let solutions = Solutions {
                        points: points.map(|point| DVector::from_column_slice(point.as_slice())),
                        direction: DVector::from_column_slice(direction.as_slice()),
                    };
                    let mut all = points.iter().chain([&direction]).flat_map(|values| values.iter());
                    all.all(|value| value.is_finite()).then_some(solutions)
                })*
                (rows, columns) => panic!("{rows} equations for {columns} unknowns"),
            }
        };
    }
    of_shape!(2 3, 4 5, 6 7, 8 9)
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    #[test]
    fn the_points_solve_the_equations_and_the_direction_none() {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        for n in 1..=4 {
            for _ in 0..100 {
                let matrix = DMatrix::from_fn(2 * n, 2 * n + 1, |_, _| random.random_range(-1.0..1.0));
                let right = [0, 1].map(|_| DVector::from_fn(2 * n, |_, _| random.random_range(-1.0..1.0)));
                let Solutions { points, direction } = solved(&matrix, [&right[0], &right[1]]).unwrap();
                for (point, right) in points.iter().zip(&right) {
                    let size = 1.0 + point.amax();
                    assert!((&matrix * point - right).amax() < 1e-13 * size, "{matrix}{point}{right}");
                    assert!(point.dot(&direction).abs() < 1e-13 * size, "it is nearest to 0");
                    assert!((&matrix * (point + &direction) - right).amax() < 1e-13 * size);
                }
                assert!((&matrix * &points[0] - &right[1]).amax() > 1e-3, "the check can fail");
                // The cross product, component by component.
                let minor = |j: usize| matrix.clone().remove_column(j).determinant();
                let cross = DVector::from_fn(2 * n + 1, |j, _| if j % 2 == 0 { minor(j) } else { -minor(j) });
                assert!((direction - &cross / cross.norm()).amax() < 1e-12, "{cross}");
            }
        }
    }

    #[test]
    fn rows_that_depend_on_each_other_have_no_such_line() {
        let right = DVector::from_row_slice(&[1.0, -1.0]);
        let of = |rows: &[f64]| solved(&DMatrix::from_row_slice(2, 3, rows), [&right, &right]);
        assert!(of(&[1.0, 2.0, 3.0, 0.0, 0.0, 0.0]).is_none());
        assert!(of(&[1.0, 2.0, 3.0, 2.0, 4.0, 6.0]).is_none());
        assert!(of(&[1.0, 2.0, 3.0, 2.0, 4.0, 6.0 + 1e-12]).is_some());
        assert!(of(&[1.0, 2.0, f64::NAN, 0.0, 1.0, 0.0]).is_none());
        assert!(of(&[1.0, 2.0, 3.0, 0.0, 1.0, 0.0]).is_some());
    }
}
