//! The symmetry of a plant half a forcing period later.

use nalgebra::{DMatrix, DVector};

use super::plant::Plant;
use super::stops::PlantStop;

/// Two numbers are the same within this, relative to the largest that they are compared with.
const SAME: f64 = 8.0 * f64::EPSILON;

/// A symmetry of a plant: where x(t) is a motion, so is P x(t + π/ω).
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// P, n × n: a signed permutation of the coordinates with P² = 1, other than 1 itself.
    pub matrix: DMatrix<f64>,
    /// The stop that each stop is mapped onto, in the plant's order.
    pub stops: Vec<usize>,
}

/// (P x)[to[i]] = sign[i] x[i].
struct SignedPermutation {
    to: Vec<usize>,
    sign: Vec<f64>,
}

impl SignedPermutation {
    /// Those with P² = 1 but 1 itself: −1 first; permutations in lexicographic order, for each of them the signs
    /// from all − to all +, the last coordinate's changing fastest.
    fn all(n: usize) -> impl Iterator<Item = SignedPermutation> {
        involutions(n).into_iter().flat_map(move |to| {
            (0..1_u32 << n).filter_map(move |signs| {
                let sign: Vec<f64> =
                    (0..n).map(|i| if signs >> (n - 1 - i) & 1 == 1 { 1.0 } else { -1.0 }).collect();
                let squared = (0..n).all(|i| sign[to[i]] == sign[i]);
                let identity = (0..n).all(|i| to[i] == i && sign[i] == 1.0);
                (squared && !identity).then(|| SignedPermutation { to: to.clone(), sign })
            })
        })
    }

    /// P M P⁻¹.
    fn conjugate(&self, matrix: &DMatrix<f64>) -> DMatrix<f64> {
        let mut image = matrix.clone();
        for (i, j) in (0..matrix.nrows()).flat_map(|i| (0..matrix.ncols()).map(move |j| (i, j))) {
            image[(self.to[i], self.to[j])] = self.sign[i] * self.sign[j] * matrix[(i, j)];
        }
        image
    }

    /// P v.
    fn apply(&self, vector: &DVector<f64>) -> DVector<f64> {
        let mut image = vector.clone();
        for (i, value) in vector.iter().enumerate() {
            image[self.to[i]] = self.sign[i] * value;
        }
        image
    }

    fn matrix(&self) -> DMatrix<f64> {
        let mut matrix = DMatrix::zeros(self.to.len(), self.to.len());
        for (i, (&to, &sign)) in self.to.iter().zip(&self.sign).enumerate() {
            matrix[(to, i)] = sign;
        }
        matrix
    }
}

/// The permutations of 0…n−1 that are their own inverses, in lexicographic order.
fn involutions(n: usize) -> Vec<Vec<usize>> {
    fn extend(partial: &mut Vec<usize>, n: usize, found: &mut Vec<Vec<usize>>) {
        let i = partial.len();
        if i == n {
            found.push(partial.clone());
            return;
        }
        let before = (0..i).find(|&j| partial[j] == i);
        for to in 0..n {
            let fits = match before {
                Some(j) => to == j,
                None => to >= i && !partial.contains(&to),
            };
            if fits {
                partial.push(to);
                extend(partial, n, found);
                partial.pop();
            }
        }
    }
    let mut found = Vec::new();
    extend(&mut Vec::with_capacity(n), n, &mut found);
    found
}

fn same(a: &[f64], b: &[f64]) -> bool {
    let size = a.iter().chain(b).fold(0.0, |size: f64, value| size.max(value.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * size)
}

/// Whether two stops are one: the same direction, whatever its length, the same gap and restitution.
fn same_stop(direction: &DVector<f64>, stop: &PlantStop, other: &PlantStop) -> bool {
    let (length, other_length) = (direction.norm(), other.direction.norm());
    same((direction / length).as_slice(), (&other.direction / other_length).as_slice())
        && same(&[stop.gap / length], &[other.gap / other_length])
        && same(&[stop.restitution], &[other.restitution])
}

impl Plant {
    /// The mirror of the plant: P with P M P⁻¹ = M, likewise C and K, P s = −s, P c = −c, P l = l, and the stops
    /// mapped onto each other with equal gaps and restitutions, all within a few ulps.
    ///
    /// The first that fits: −1, then the other signed permutations with P² = 1, coordinates exchanged as little as
    /// possible first (permutations in lexicographic order; for each the signs from all − to all +, the last
    /// coordinate's changing fastest). `None` where the plant has no mirror; the identity, which an unforced plant
    /// would admit, is none.
    pub fn mirror(&self) -> Option<Mirror> {
        SignedPermutation::all(self.n).find_map(|p| self.mirrored_by(&p))
    }

    fn mirrored_by(&self, p: &SignedPermutation) -> Option<Mirror> {
        let unchanged = |m: &DMatrix<f64>| same(p.conjugate(m).as_slice(), m.as_slice());
        let turned = |v: &DVector<f64>| same(p.apply(v).as_slice(), (-v).as_slice());
        let symmetric = [&self.mass, &self.damping, &self.stiffness].into_iter().all(unchanged)
            && turned(&self.force_sin)
            && turned(&self.force_cos)
            && same(p.apply(&self.load).as_slice(), self.load.as_slice());
        if !symmetric {
            return None;
        }
        let image = |stop: &PlantStop| {
            let direction = p.apply(&stop.direction);
            self.stops.iter().position(|other| same_stop(&direction, stop, other))
        };
        let stops = self.stops.iter().map(image).collect::<Option<Vec<usize>>>()?;
        Some(Mirror { matrix: p.matrix(), stops })
    }
}
