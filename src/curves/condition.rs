//! What defines a bifurcation: a function of a motion that vanishes there.

use nalgebra::{Complex, DMatrix, DVector, Dyn};

use super::path::differences;
use crate::system::named;
use crate::theory::Pattern;

named! {
    /// The kind of a bifurcation; of a symmetric motion in terms of its half map.
    #[derive(Hash)]
    pub enum Kind {
        /// A multiplier +1: the motion ends, in a saddle-node.
        Fold = "fold",
        /// A multiplier −1.
        PeriodDoubling = "period doubling",
        /// A multiplier −1 of the half map: a symmetric motion gives rise to two mirrored ones.
        Pitchfork = "pitchfork",
        /// A complex pair of multipliers of modulus 1.
        NeimarkSacker = "Neimark-Sacker",
        /// The orbit just touches a stop.
        Grazing = "grazing",
    }
}

impl Kind {
    /// The smooth bifurcations of a motion.
    pub fn smooth(pattern: &Pattern) -> [Kind; 3] {
        let flip = if pattern.mirrored { Kind::Pitchfork } else { Kind::PeriodDoubling };
        [Kind::Fold, flip, Kind::NeimarkSacker]
    }
}

/// The function that vanishes at a smooth bifurcation, of the map of one turn with multipliers μ:
/// Π (μᵢ − 1), Π (μᵢ + 1), or Π over pairs (μᵢ μⱼ − 1).
///
/// It is smooth in the motion and the parameters even where multipliers meet.
pub(super) fn test_function(kind: Kind, map: &DMatrix<f64>) -> f64 {
    let identity = |size: usize| DMatrix::identity(size, size);
    match kind {
        Kind::Fold => (map - identity(map.nrows())).determinant(),
        Kind::PeriodDoubling | Kind::Pitchfork => (map + identity(map.nrows())).determinant(),
        Kind::NeimarkSacker => {
            let compound = compound(map);
            let size = compound.nrows();
            (compound - identity(size)).determinant()
        }
        Kind::Grazing => f64::NAN,
    }
}

/// The derivatives of the [`test_function`] by the entries of the map.
pub(super) fn test_by_entries(kind: Kind, map: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let (rows, columns) = map.shape();
    let entries = DVector::from_column_slice(map.as_slice());
    let by_entries = differences(&entries, 0..entries.len(), |entries| {
        let test = test_function(kind, &DMatrix::from_column_slice(rows, columns, entries.as_slice()));
        test.is_finite().then(|| DVector::from_element(1, test))
    })?;
    Some(by_entries.reshape_generic(Dyn(rows), Dyn(columns)))
}

/// The second compound: all 2 × 2 minors, whose eigenvalues are the products of pairs of eigenvalues.
fn compound(map: &DMatrix<f64>) -> DMatrix<f64> {
    let size = map.nrows();
    let pairs: Vec<(usize, usize)> = (0..size).flat_map(|i| (i + 1..size).map(move |j| (i, j))).collect();
    DMatrix::from_fn(pairs.len(), pairs.len(), |row, column| {
        let ((i, j), (k, l)) = (pairs[row], pairs[column]);
        map[(i, k)] * map[(j, l)] - map[(i, l)] * map[(j, k)]
    })
}

/// The multipliers that are critical at a bifurcation, and the others.
pub(super) fn split(kind: Kind, multipliers: &[Complex<f64>]) -> (Vec<Complex<f64>>, Vec<Complex<f64>>) {
    let mut sorted = multipliers.to_vec();
    let (critical, distance): (usize, fn(&Complex<f64>) -> f64) = match kind {
        Kind::Fold => (1, |value| (value - 1.0).norm()),
        Kind::PeriodDoubling | Kind::Pitchfork => (1, |value| (value + 1.0).norm()),
        Kind::NeimarkSacker => return split_pair(multipliers),
        Kind::Grazing => (0, |value| value.norm()),
    };
    sorted.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    let others = sorted.split_off(critical);
    (sorted, others)
}

/// The pair whose product is nearest to 1.
fn split_pair(multipliers: &[Complex<f64>]) -> (Vec<Complex<f64>>, Vec<Complex<f64>>) {
    let count = multipliers.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| (i, j)));
    let off = |&(i, j): &(usize, usize)| (multipliers[i] * multipliers[j] - 1.0).norm();
    let (i, j) = pairs.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or((0, 1));
    let others = (0..count).filter(|&k| k != i && k != j).map(|k| multipliers[k]).collect();
    (vec![multipliers[i], multipliers[j]], others)
}

#[cfg(test)]
mod tests {
    use nalgebra::{Matrix4, Vector4};

    use super::*;

    /// A matrix with multipliers e^(±iθ)·radius, and two real ones, in no special basis.
    fn map(theta: f64, radius: f64, a: f64, b: f64) -> DMatrix<f64> {
        let (s, c) = theta.sin_cos();
        let mut normal = Matrix4::from_diagonal(&Vector4::new(radius * c, radius * c, a, b));
        normal[(0, 1)] = -radius * s;
        normal[(1, 0)] = radius * s;
        let basis = Matrix4::new(2., 1., 0., 1., 0., 3., 1., 0., 1., 0., 2., 0., 0., 1., 1., 4.);
        let map = basis * normal * basis.try_inverse().unwrap();
        DMatrix::from_column_slice(4, 4, map.as_slice())
    }

    #[test]
    fn test_functions_vanish_where_they_should_and_change_sign() {
        let at = |kind: Kind, radius: f64, a: f64| test_function(kind, &map(1.1, radius, a, 0.3));
        for (kind, radius, a) in
            [(Kind::NeimarkSacker, 1.0, 0.5), (Kind::Fold, 0.7, 1.0), (Kind::PeriodDoubling, 0.7, -1.0)]
        {
            assert!(at(kind, radius, a).abs() < 1e-12);
            let (before, after) = (at(kind, radius * 0.99, a * 0.99), at(kind, radius * 1.01, a * 1.01));
            assert!(before * after < 0.0, "{kind:?}: {before} {after}");
        }
    }

    #[test]
    fn the_critical_pair_is_told_from_the_others() {
        let values = [
            Complex::new(1.2, 0.0),
            Complex::from_polar(1.0, 0.5),
            Complex::from_polar(1.0, -0.5),
            Complex::new(0.1, 0.0),
        ];
        let (critical, others) = split(Kind::NeimarkSacker, &values);
        assert_eq!((critical, others), (vec![values[1], values[2]], vec![values[0], values[3]]));
    }
}
