//! The symmetry of a plant half a forcing period later.

use std::sync::LazyLock;

use arrayvec::ArrayVec;
use nalgebra::{DMatrix, DVector};

use super::near::SAME;
use super::plant::Plant;
use super::stops::PlantStop;

/// A symmetry of a plant: where x(t) is a motion, so is P x(t + π/ω).
#[derive(Clone, Debug, PartialEq)]
pub struct Mirror {
    /// P, n × n: a signed permutation of the coordinates with P² = 1, other than 1 itself.
    pub matrix: DMatrix<f64>,
    /// The stop that each stop is mapped onto, in the plant's order.
    pub stops: Vec<usize>,
}

/// The most coordinates, with a force that is one of them.
const MOST: usize = Plant::MOST_COORDINATES + 1;

/// As many numbers as there are coordinates.
type Components = ArrayVec<f64, MOST>;

/// (P x)[to[i]] = sign[i] x[i].
struct SignedPermutation {
    to: Vec<usize>,
    sign: Vec<f64>,
}

/// Those of each number of coordinates, from 1 on; see [`SignedPermutation::all`].
static ALL: LazyLock<[Vec<SignedPermutation>; MOST]> =
    LazyLock::new(|| std::array::from_fn(|i| SignedPermutation::all(i + 1).collect()));

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

    /// Whether P M P⁻¹ = M.
    fn leaves(&self, matrix: &DMatrix<f64>) -> bool {
        let (n, size) = (self.to.len(), matrix.amax());
        (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).all(|(i, j)| {
            let image = self.sign[i] * self.sign[j] * matrix[(i, j)];
            (image - matrix[(self.to[i], self.to[j])]).abs() <= SAME * size
        })
    }

    /// Whether P v = v, or −v where `sign` is −1.
    fn takes(&self, vector: &DVector<f64>, sign: f64) -> bool {
        same(&self.apply(vector), vector.iter().map(|value| sign * value))
    }

    /// P v.
    fn apply(&self, vector: &DVector<f64>) -> Components {
        let mut image: Components = vector.iter().copied().collect();
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

fn same(a: &[f64], b: impl Iterator<Item = f64> + Clone) -> bool {
    let size = a.iter().copied().chain(b.clone()).fold(0.0, |size: f64, value| size.max(value.abs()));
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * size)
}

/// Whether two stops are one: the same direction, whatever its length, the same gap and restitution.
fn same_stop(direction: &Components, stop: &PlantStop, other: &PlantStop) -> bool {
    let (length, other_length) = (stop.direction.norm(), other.direction.norm());
    let unit: Components = direction.iter().map(|value| value / length).collect();
    same(&unit, other.direction.iter().map(|value| value / other_length))
        && same(&[stop.gap / length], std::iter::once(other.gap / other_length))
        && same(&[stop.restitution], std::iter::once(other.restitution))
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
        ALL.get(self.n.wrapping_sub(1))?.iter().find_map(|p| self.mirrored_by(p))
    }

    fn mirrored_by(&self, p: &SignedPermutation) -> Option<Mirror> {
        let symmetric =
            [&self.mass, &self.damping, &self.stiffness].into_iter().all(|matrix| p.leaves(matrix))
                && p.takes(&self.force_sin, -1.0)
                && p.takes(&self.force_cos, -1.0)
                && p.takes(&self.load, 1.0);
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
