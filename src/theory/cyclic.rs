//! Linear equations around a motion, solved in time and memory proportional to the number of its impacts.
//!
//! Every impact is joined to the next one alone; along a path of motions, its parameters and what defines a bifurcation concern all
//! of them. The impacts are eliminated in order, each by an orthogonal transformation of the two arcs that it joins, so that the
//! equations are as well conditioned at the end as they were. What is left are the first impact and what concerns all: condensation
//! of parameters, as in E. J. Doedel, H. B. Keller, J. P. Kernévez, Int. J. Bifurcation Chaos 1 (1991) 745–772,
//! doi:10.1142/S0218127491000555.

use nalgebra::{DMatrix, DVector, Dyn, LU, QR, RowDVector};

/// Of fewer impacts than this none is eliminated: the whole matrix is small.
const LEAST: usize = 4;

/// The coefficients of equations in m unknowns for each of K impacts, and p that concern all of them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Cyclic {
    /// Of m equations for each impact: those of its own unknowns and of the next impact's, m × m; the first comes after the last.
    pub joints: Vec<[DMatrix<f64>; 2]>,
    /// In the same equations, those of the unknowns that concern all; mK × p.
    pub common: DMatrix<f64>,
    /// Of the other equations, those of all unknowns; their number × (mK + p).
    pub others: DMatrix<f64>,
}

impl Cyclic {
    /// The equations of a motion alone.
    pub fn of_motion(joints: Vec<[DMatrix<f64>; 2]>) -> Self {
        let count = joints.iter().map(|[own, _]| own.nrows()).sum();
        Cyclic { joints, common: DMatrix::zeros(count, 0), others: DMatrix::zeros(0, count) }
    }

    /// Any equations.
    pub fn any(matrix: DMatrix<f64>) -> Self {
        Cyclic { joints: Vec::new(), common: DMatrix::zeros(0, matrix.ncols()), others: matrix }
    }

    /// The coefficients as one matrix.
    pub fn whole(&self) -> DMatrix<f64> {
        let (at, common) = self.common.shape();
        let mut whole = DMatrix::zeros(at + self.others.nrows(), at + common);
        let count = self.joints.len();
        for (i, [own, next]) in self.joints.iter().enumerate() {
            let size = own.nrows();
            for (j, block) in [(i, own), ((i + 1) % count, next)] {
                let mut place = whole.view_mut((size * i, size * j), (size, size));
                place += block;
            }
        }
        whole.view_mut((0, at), (at, common)).copy_from(&self.common);
        whole.rows_mut(at, self.others.nrows()).copy_from(&self.others);
        whole
    }

    /// Factors these equations with one more beside the others, if there is one; as many as unknowns in all. None where an impact
    /// cannot be eliminated.
    pub fn factored(&self, more: Option<&DVector<f64>>) -> Option<Factors> {
        if self.joints.len() < LEAST {
            let left = with_row(self.whole(), more).lu();
            return Some(Factors { size: 0, eliminated: Vec::new(), left });
        }
        let [[first, next], joints @ ..] = &self.joints[..] else { return None };
        let (size, common) = (first.nrows(), self.common.ncols());
        // In the columns of the first impact, of the next one, and of what concerns all.
        let mut above = DMatrix::zeros(size, 2 * size + common);
        above.columns_mut(0, size).copy_from(first);
        above.columns_mut(size, size).copy_from(next);
        above.columns_mut(2 * size, common).copy_from(&self.common.rows(0, size));
        let others = with_row(self.others.clone(), more);
        let mut of_first = others.columns(0, size).into_owned();
        let mut of_next = DMatrix::zeros(others.nrows(), size);
        let mut of_common = others.columns(self.common.nrows(), common).into_owned();
        let mut eliminated = Vec::with_capacity(joints.len());
        for (i, [own, next]) in (1..).zip(joints) {
            let mut joint = DMatrix::zeros(2 * size, size);
            joint.rows_mut(0, size).copy_from(&above.columns(size, size));
            joint.rows_mut(size, size).copy_from(own);
            let mut both = DMatrix::zeros(2 * size, 2 * size + common);
            both.rows_mut(0, size).copy_from(&above);
            both.view_mut((0, size), (size, size)).fill(0.0);
            both.view_mut((size, size), (size, size)).copy_from(next);
            both.view_mut((size, 2 * size), (size, common)).copy_from(&self.common.rows(size * i, size));
            let joint = joint.qr();
            joint.q_tr_mul(&mut both);
            let (r, rest) = (joint.r(), both.rows(0, size).into_owned());
            above.copy_from(&both.rows(size, size));
            let own = of_next + others.columns(size * i, size);
            let taken = r.tr_solve_upper_triangular(&own.transpose())?.transpose();
            of_first -= &taken * rest.columns(0, size);
            of_next = -(&taken * rest.columns(size, size));
            of_common -= &taken * rest.columns(2 * size, common);
            eliminated.push(Eliminated { joint, r, rest, taken });
        }
        // The impact after the last is the first.
        let mut left = DMatrix::zeros(size + others.nrows(), size + common);
        left.view_mut((0, 0), (size, size)).copy_from(&(above.columns(0, size) + above.columns(size, size)));
        left.view_mut((0, size), (size, common)).copy_from(&above.columns(2 * size, common));
        left.view_mut((size, 0), of_first.shape()).copy_from(&(of_first + of_next));
        left.view_mut((size, size), of_common.shape()).copy_from(&of_common);
        Some(Factors { size, eliminated, left: left.lu() })
    }
}

/// What is left of an impact's unknowns x once they are eliminated: R x = c − rest·(x₀, x′, p), with x₀ those of the first impact,
/// x′ those of the next, and p what concerns all.
struct Eliminated {
    joint: QR<f64, Dyn, Dyn>,
    r: DMatrix<f64>,
    rest: DMatrix<f64>,
    /// How often each of these equations is taken from the others.
    taken: DMatrix<f64>,
}

/// Equations that are ready to be solved for any right-hand side.
pub(crate) struct Factors {
    /// Unknowns of an impact, if any is eliminated.
    size: usize,
    eliminated: Vec<Eliminated>,
    left: LU<f64, Dyn, Dyn>,
}

impl Factors {
    /// The solution for a right-hand side, in the order of the unknowns; none where there is none, or more than one.
    pub fn solve(&self, right: &DVector<f64>) -> Option<DVector<f64>> {
        let solution = match self.eliminated.is_empty() {
            true => self.left.solve(right)?,
            false => self.solve_eliminated(right)?,
        };
        solution.iter().all(|value| value.is_finite()).then_some(solution)
    }

    fn solve_eliminated(&self, right: &DVector<f64>) -> Option<DVector<f64>> {
        let (size, at) = (self.size, self.size * (self.eliminated.len() + 1));
        let common = right.len() - at;
        let mut left = DVector::zeros(size + common);
        left.rows_mut(0, size).copy_from(&right.rows(0, size));
        left.rows_mut(size, common).copy_from(&right.rows(at, common));
        let mut parts = Vec::with_capacity(self.eliminated.len());
        for (i, Eliminated { joint, taken, .. }) in (1..).zip(&self.eliminated) {
            let mut both = DVector::zeros(2 * size);
            both.rows_mut(0, size).copy_from(&left.rows(0, size));
            both.rows_mut(size, size).copy_from(&right.rows(size * i, size));
            joint.q_tr_mul(&mut both);
            left.rows_mut(0, size).copy_from(&both.rows(size, size));
            let part = both.rows(0, size).into_owned();
            let mut others = left.rows_mut(size, common);
            others -= taken * &part;
            parts.push(part);
        }
        if !self.left.solve_mut(&mut left) {
            return None;
        }
        let mut solution = DVector::zeros(right.len());
        solution.rows_mut(0, size).copy_from(&left.rows(0, size));
        solution.rows_mut(at, common).copy_from(&left.rows(size, common));
        // Of the first impact, of the next one, and what concerns all.
        let mut known = DVector::zeros(2 * size + common);
        known.rows_mut(0, size).copy_from(&left.rows(0, size));
        known.rows_mut(size, size).copy_from(&left.rows(0, size));
        known.rows_mut(2 * size, common).copy_from(&left.rows(size, common));
        for (i, (Eliminated { r, rest, .. }, part)) in self.eliminated.iter().zip(parts).enumerate().rev() {
            let own = r.solve_upper_triangular(&(part - rest * &known))?;
            solution.rows_mut(size * (i + 1), size).copy_from(&own);
            known.rows_mut(size, size).copy_from(&own);
        }
        Some(solution)
    }
}

/// A matrix with one more row, if there is one.
fn with_row(matrix: DMatrix<f64>, row: Option<&DVector<f64>>) -> DMatrix<f64> {
    let Some(row) = row else { return matrix };
    let last = matrix.nrows();
    let mut matrix = matrix.insert_row(last, 0.0);
    matrix.set_row(last, &RowDVector::from_row_slice(row.as_slice()));
    matrix
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::dynamics::Stop;
    use crate::model::{Parameters, System};
    use crate::theory::example::chain;
    use crate::theory::flow::Flow;
    use crate::theory::newton::{arcs, joints, residual};
    use crate::theory::pattern::Pattern;
    use crate::theory::section_vector::SectionVector;

    /// Equations in which nothing is special, with one that is to be given beside the others if there is any unknown for it.
    fn equations(random: &mut ChaCha8Rng, impacts: usize, size: usize, common: usize) -> Cyclic {
        let mut block = |rows: usize, columns: usize| {
            DMatrix::from_fn(rows, columns, |_, _| random.random_range(-1.0..1.0))
        };
        let at = impacts * size;
        Cyclic {
            joints: (0..impacts).map(|_| [block(size, size), block(size, size)]).collect(),
            common: block(at, common),
            others: block(common.saturating_sub(1), at + common),
        }
    }

    fn right_side(length: usize) -> DVector<f64> {
        DVector::from_fn(length, |i, _| (0.3 + i as f64).sin())
    }

    #[test]
    fn solutions_are_those_of_the_whole_matrix() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut shapes = vec![(1, 4, 1), (3, 4, 2), (4, 2, 1), (4, 4, 3), (9, 6, 2), (40, 4, 3)];
        shapes.extend([(1, 4, 0), (2, 4, 0), (7, 6, 0), (30, 2, 0), (0, 0, 3)]);
        for (impacts, size, common) in shapes {
            let cyclic = equations(&mut random, impacts, size, common);
            let length = impacts * size + common;
            let border = (common > 0).then(|| right_side(length).map(|value| value * value));
            let whole = with_row(cyclic.whole(), border.as_ref());
            let right = right_side(length);
            let factors = cyclic.factored(border.as_ref()).unwrap();
            assert_eq!(factors.eliminated.len(), if impacts < LEAST { 0 } else { impacts - 1 });
            let solution = factors.solve(&right).unwrap();
            let off = |solution: &DVector<f64>| (&whole * solution - &right).amax();
            assert!(off(&solution) < 1e-9 * (1.0 + solution.amax()), "{impacts}: {}", off(&solution));
            let other = equations(&mut random, impacts, size, common).factored(border.as_ref()).unwrap();
            assert!(off(&other.solve(&right).unwrap()) > 1e-6, "the check can fail");
        }
    }

    /// At a fold the equations of the motion alone are singular, those with the path's are not.
    #[test]
    fn turning_points_are_solved_as_well_as_others() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let (impacts, size) = (12, 4);
        let mut cyclic = equations(&mut random, impacts, size, 1);
        let null = DVector::from_fn(impacts * size, |i, _| (1.0 + i as f64).cos());
        // One coefficient of each of the motion's equations makes this a null vector of them.
        for i in 0..impacts {
            let [own, next] = &mut cyclic.joints[i];
            let rows = |of: usize| null.rows(of % impacts * size, size);
            let sums = &*own * rows(i) + &*next * rows(i + 1);
            for (k, sum) in sums.iter().enumerate() {
                own[(k, 0)] -= sum / null[size * i];
            }
        }
        let motion = Cyclic::of_motion(cyclic.joints.clone());
        assert!((motion.whole() * &null).amax() < 1e-12, "it is singular");
        let (right, border) = (right_side(null.len() + 1), right_side(null.len() + 1));
        let solution = cyclic.factored(Some(&border)).unwrap().solve(&right).unwrap();
        let off = (with_row(cyclic.whole(), Some(&border)) * &solution - &right).amax();
        assert!(off < 1e-10 * (1.0 + solution.amax()), "{off}");
    }

    /// A sequence that is no motion, so that no block of the equations is special.
    fn sequence(system: &System, count: usize, mirrored: bool) -> (Pattern, Vec<SectionVector>) {
        let stops = (0..count).map(|i| if i % 3 == 0 { Stop::A } else { Stop::B }).collect();
        let pattern = Pattern::new(system, stops, if mirrored { 3 } else { 4 }, mirrored);
        let last = 2 * system.plant().n - 1;
        let at = |i: usize| {
            let k = i as f64;
            let value = |j: usize| 0.1 / (1.0 + j as f64) * ((j + 1) as f64 * k + j as f64).sin();
            let phase = pattern.turn() * k / count as f64;
            SectionVector::from_fn(last + 1, |j, _| match j {
                0 => -0.3 + value(0),
                j if j == last => phase,
                j => value(j),
            })
        };
        let sections = (0..count).map(at).collect();
        (pattern, sections)
    }

    #[test]
    fn the_solution_for_a_motion_is_that_of_its_whole_matrix() {
        for system in [System::new(Parameters::default()).unwrap(), chain()] {
            let flow = Flow::new(&system);
            for (count, mirrored) in [(1, true), (1, false), (2, false), (7, true), (12, false)] {
                let (pattern, sections) = sequence(&system, count, mirrored);
                let joined = arcs(&flow, &pattern, &sections);
                let cyclic = |pattern: &Pattern| Cyclic::of_motion(joints(&flow, &joined, pattern));
                let (matrix, right) = (cyclic(&pattern).whole(), residual(&joined));
                let solve =
                    |pattern: &Pattern| cyclic(pattern).factored(None).unwrap().solve(&right).unwrap();
                let solution = solve(&pattern);
                assert!((&matrix * &solution - &right).amax() < 1e-10 * (1.0 + solution.amax()), "{count}");
                let other = Pattern { mirrored: !mirrored, ..pattern };
                assert!((&matrix * solve(&other) - &right).amax() > 1e-6, "the check can fail");
            }
        }
    }
}
