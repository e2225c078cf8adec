//! The linear equations of a path, solved in time proportional to the number of impacts.
//!
//! Every impact is joined to the next one alone; the path's parameters, and what defines a bifurcation, concern all of them. So
//! the impacts are eliminated in order, and what is left are the first one and the parameters: condensation of parameters, as in
//! E. J. Doedel, H. B. Keller, J. P. Kernévez, Int. J. Bifurcation Chaos 1 (1991) 745–772, doi:10.1142/S0218127491000555.

use nalgebra::{DMatrix, DVector, Dyn, LU, QR, RowDVector};

/// Of fewer impacts than this nothing is eliminated: the whole matrix is small.
const LEAST: usize = 4;

/// Some impacts one after the other, with as many unknowns each, and first as many equations each: those of one hold between it
/// and the next, those of the last between it and the first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chained {
    pub impacts: usize,
    /// Unknowns of an impact.
    pub size: usize,
}

impl Chained {
    /// Any equations.
    pub const UNKNOWN: Chained = Chained { impacts: 0, size: 0 };
}

/// What is left of an impact's unknowns x once they are eliminated: R x = c − rest·(x₀, x′, p), with x₀ those of the first impact,
/// x′ those of the next, and p what concerns all.
struct Eliminated {
    joint: QR<f64, Dyn, Dyn>,
    r: DMatrix<f64>,
    rest: DMatrix<f64>,
    /// How often each of these equations is taken from those that concern all impacts.
    taken: DMatrix<f64>,
}

/// n equations in n + 1 unknowns and one more, factored.
pub(super) struct Condensed {
    chained: Chained,
    eliminated: Vec<Eliminated>,
    left: LU<f64, Dyn, Dyn>,
}

impl Condensed {
    /// Of the derivatives of n equations, and the coefficients of one more; none where an impact cannot be eliminated.
    pub fn of(jacobian: &DMatrix<f64>, border: &DVector<f64>, chained: Chained) -> Option<Self> {
        let Chained { impacts, size } = chained;
        if impacts < LEAST {
            let left = with_row(jacobian.clone(), border.transpose()).lu();
            return Some(Condensed {
                chained: Chained { impacts: 0, size: 0 },
                eliminated: Vec::new(),
                left,
            });
        }
        let at = impacts * size;
        let common = border.len() - at;
        // Of the first impact, the next one, and what concerns all.
        let row = |i: usize, own: &mut DMatrix<f64>, columns: usize| {
            let block = |j: usize, width: usize| jacobian.view((i * size, j), (size, width));
            own.view_mut((own.nrows() - size, columns), (size, size))
                .copy_from(&block((i + 1) % impacts * size, size));
            own.view_mut((own.nrows() - size, 2 * size), (size, common)).copy_from(&block(at, common));
        };
        let mut above = DMatrix::zeros(size, 2 * size + common);
        above.columns_mut(0, size).copy_from(&jacobian.view((0, 0), (size, size)));
        row(0, &mut above, size);
        let all = with_row(jacobian.rows(at, common - 1).into_owned(), border.transpose());
        let mut below = all.columns(at, common).into_owned();
        let mut of_first = all.columns(0, size).into_owned();
        let mut of_next = DMatrix::zeros(common, size);
        let mut eliminated = Vec::with_capacity(impacts - 1);
        for i in 1..impacts {
            let mut joint = DMatrix::zeros(2 * size, size);
            joint.rows_mut(0, size).copy_from(&above.columns(size, size));
            joint.rows_mut(size, size).copy_from(&jacobian.view((i * size, i * size), (size, size)));
            let mut both = DMatrix::zeros(2 * size, 2 * size + common);
            both.view_mut((0, 0), (size, size)).copy_from(&above.columns(0, size));
            both.view_mut((0, 2 * size), (size, common)).copy_from(&above.columns(2 * size, common));
            row(i, &mut both, size);
            let joint = joint.qr();
            joint.q_tr_mul(&mut both);
            let (r, rest) = (joint.r(), both.rows(0, size).into_owned());
            above.copy_from(&both.rows(size, size));
            let own = of_next + all.columns(i * size, size);
            let taken = r.tr_solve_upper_triangular(&own.transpose())?.transpose();
            of_first -= &taken * rest.columns(0, size);
            of_next = -(&taken * rest.columns(size, size));
            below -= &taken * rest.columns(2 * size, common);
            eliminated.push(Eliminated { joint, r, rest, taken });
        }
        // The impact after the last is the first.
        let mut left = DMatrix::zeros(size + common, size + common);
        left.view_mut((0, 0), (size, size)).copy_from(&(above.columns(0, size) + above.columns(size, size)));
        left.view_mut((0, size), (size, common)).copy_from(&above.columns(2 * size, common));
        left.view_mut((size, 0), (common, size)).copy_from(&(of_first + of_next));
        left.view_mut((size, size), (common, common)).copy_from(&below);
        Some(Condensed { chained, eliminated, left: left.lu() })
    }

    /// The solution for a right-hand side; none where there is none, or more than one.
    pub fn solve(&self, right: &DVector<f64>) -> Option<DVector<f64>> {
        let Chained { impacts, size } = self.chained;
        let (at, length) = (impacts * size, right.len());
        let common = length - at;
        let mut left = DVector::zeros(size + common);
        left.rows_mut(0, size).copy_from(&right.rows(0, size));
        left.rows_mut(size, common).copy_from(&right.rows(at, common));
        let mut parts = Vec::with_capacity(self.eliminated.len());
        for (i, Eliminated { joint, taken, .. }) in (1..).zip(&self.eliminated) {
            let mut both = DVector::zeros(2 * size);
            both.rows_mut(0, size).copy_from(&left.rows(0, size));
            both.rows_mut(size, size).copy_from(&right.rows(i * size, size));
            joint.q_tr_mul(&mut both);
            left.rows_mut(0, size).copy_from(&both.rows(size, size));
            let part = both.rows(0, size).into_owned();
            let mut all = left.rows_mut(size, common);
            all -= taken * &part;
            parts.push(part);
        }
        if !self.left.solve_mut(&mut left) {
            return None;
        }
        let mut solution = DVector::zeros(length);
        solution.rows_mut(0, size).copy_from(&left.rows(0, size));
        solution.rows_mut(at, common).copy_from(&left.rows(size, common));
        // Those of the first impact, the next one, and what concerns all.
        let mut known = DVector::zeros(2 * size + common);
        known.rows_mut(0, size).copy_from(&left.rows(0, size));
        known.rows_mut(size, size).copy_from(&left.rows(0, size));
        known.rows_mut(2 * size, common).copy_from(&left.rows(size, common));
        for (i, (Eliminated { r, rest, .. }, part)) in self.eliminated.iter().zip(parts).enumerate().rev() {
            let own = r.solve_upper_triangular(&(part - rest * &known))?;
            solution.rows_mut((i + 1) * size, size).copy_from(&own);
            known.rows_mut(size, size).copy_from(&own);
        }
        Some(solution)
    }
}

/// A matrix with one more row.
fn with_row(matrix: DMatrix<f64>, row: RowDVector<f64>) -> DMatrix<f64> {
    let last = matrix.nrows();
    let mut matrix = matrix.insert_row(last, 0.0);
    matrix.set_row(last, &row);
    matrix
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Equations of such a shape, in which nothing is special.
    fn equations(random: &mut ChaCha8Rng, Chained { impacts, size }: Chained, common: usize) -> DMatrix<f64> {
        let at = impacts * size;
        let mut matrix = DMatrix::from_fn(at + common, at + common, |_, _| random.random_range(-1.0..1.0));
        for i in 0..at {
            for j in 0..at {
                let (own, other) = (i / size, j / size);
                if other != own && other != (own + 1) % impacts {
                    matrix[(i, j)] = 0.0;
                }
            }
        }
        matrix
    }

    #[test]
    fn solutions_are_those_of_the_whole_matrix() {
        let mut random = ChaCha8Rng::seed_from_u64(5);
        for (impacts, size, common) in [(1, 4, 1), (3, 4, 2), (4, 2, 1), (4, 4, 3), (9, 6, 2), (40, 4, 3)] {
            let chained = Chained { impacts, size };
            let matrix = equations(&mut random, chained, common);
            let last = matrix.nrows() - 1;
            let (jacobian, border) = (matrix.rows(0, last).into_owned(), matrix.row(last).transpose());
            let right = DVector::from_fn(matrix.nrows(), |i, _| (0.3 + i as f64).sin());
            let condensed = Condensed::of(&jacobian, &border, chained).unwrap();
            assert_eq!(condensed.eliminated.len(), if impacts < LEAST { 0 } else { impacts - 1 });
            let solution = condensed.solve(&right).unwrap();
            let off = |solution: &DVector<f64>| (&matrix * solution - &right).amax();
            assert!(off(&solution) < 1e-10 * (1.0 + solution.amax()), "{impacts}: {}", off(&solution));
            let other = Condensed::of(&jacobian, &(border * 2.0), chained).unwrap();
            assert!(off(&other.solve(&right).unwrap()) > 1e-6, "the check can fail");
        }
    }

    /// At a fold the equations of the motion alone are singular, those with the path's are not.
    #[test]
    fn turning_points_are_solved_as_well_as_others() {
        let mut random = ChaCha8Rng::seed_from_u64(6);
        let chained = Chained { impacts: 12, size: 4 };
        let mut matrix = equations(&mut random, chained, 1);
        let at = 48;
        // One coefficient of each of the motion's equations makes this a null vector of them.
        let null = DVector::from_fn(at, |i, _| (1.0 + i as f64).cos());
        for i in 0..at {
            let own = i / 4 * 4;
            let rest: f64 = (0..at).filter(|&j| j != own).map(|j| matrix[(i, j)] * null[j]).sum();
            matrix[(i, own)] = -rest / null[own];
        }
        let motion = matrix.view((0, 0), (at, at)).into_owned();
        assert!((&motion * &null).amax() < 1e-12, "it is singular");
        let (jacobian, border) = (matrix.rows(0, at).into_owned(), matrix.row(at).transpose());
        let right = DVector::from_fn(at + 1, |i, _| (0.7 + i as f64).sin());
        let solution = Condensed::of(&jacobian, &border, chained).unwrap().solve(&right).unwrap();
        let off = (&matrix * &solution - &right).amax();
        assert!(off < 1e-10 * (1.0 + solution.amax()), "{off}");
    }
}
