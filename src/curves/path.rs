//! Pseudo-arclength continuation: the solutions of n equations in n + 1 unknowns, point after point.
//!
//! See Yu. A. Kuznetsov, Elements of Applied Bifurcation Theory, Springer (2004), chapter 10,
//! doi:10.1007/978-1-4757-3978-7.

use nalgebra::{DMatrix, DVector};

use crate::theory::Cyclic;

/// The most Newton steps of one correction.
const MOST_STEPS: usize = 14;
/// If so many further steps do not do, new derivatives come cheaper.
const FURTHER: i32 = 3;
/// A correction below this is the last one, and so is a residual.
const CONVERGED: f64 = 1e-9;
/// And so is one after which less than this is left, to judge by how fast corrections grow shorter.
const NEGLIGIBLE: f64 = 1e-11;
/// The least share of the last correction that may be left.
const LEFT: f64 = 1e-3;
/// The farthest that a solution may be from a guess that nothing is known of.
const FARTHEST: f64 = 1.0;
/// The share of a step by which a solution may be from its guess, and a guess from the tangent.
const ASIDE: f64 = 0.3;
/// Paths with at least this cosine between them go the same way.
const PARALLEL: f64 = 0.97;
/// The share of an unknown's size by which it is moved for a central difference.
const DIFFERENCE: f64 = 1e-6;

/// n equations in n + 1 unknowns, all of order one.
pub(super) trait Equations {
    /// The residuals; none outside the domain.
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>>;

    /// Their derivatives, n × (n + 1); central differences unless something better is known.
    fn jacobian(&self, y: &DVector<f64>) -> Option<Cyclic> {
        differences(y, 0..y.len(), |y| self.residual(y)).map(Cyclic::any)
    }
}

/// Differences of some functions with respect to some of the unknowns, a column each; central ones where both sides are in the
/// domain.
pub(super) fn differences(
    y: &DVector<f64>,
    unknowns: std::ops::Range<usize>,
    function: impl Fn(&DVector<f64>) -> Option<DVector<f64>>,
) -> Option<DMatrix<f64>> {
    let mut moved = y.clone();
    let mut columns = Vec::with_capacity(unknowns.len());
    for j in unknowns {
        let h = DIFFERENCE * (1.0 + y[j].abs());
        let mut at = |value: f64| {
            moved[j] = value;
            function(&moved)
        };
        let (above, below) = (at(y[j] + h), at(y[j] - h));
        // At the end of a parameter's physical range there is but one side.
        columns.push(match (above, below) {
            (Some(above), Some(below)) => (above - below) / (2.0 * h),
            (Some(above), None) => (above - at(y[j])?) / h,
            (None, Some(below)) => (at(y[j])? - below) / h,
            (None, None) => return None,
        });
        moved[j] = y[j];
    }
    Some(DMatrix::from_columns(&columns))
}

/// A solution, and the direction in which the path goes on.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PathPoint {
    pub y: DVector<f64>,
    /// A unit vector.
    pub tangent: DVector<f64>,
    /// How the path leaves its tangent, by the point before: a length s ahead by q s² + c s³, of which these are q and c.
    bend: Option<[DVector<f64>; 2]>,
    /// The derivatives of the equations here; they serve for the next correction as well.
    jacobian: Cyclic,
}

impl PathPoint {
    /// The solution next to a guess with its `fixed`-th unknown held, and the path through it on which that unknown
    /// grows.
    pub fn near(equations: &impl Equations, guess: DVector<f64>, fixed: usize) -> Option<Self> {
        let mut border = DVector::zeros(guess.len());
        border[fixed] = 1.0;
        let jacobian = equations.jacobian(&guess)?;
        let y = corrected(equations, guess, &border, &jacobian, FARTHEST)?;
        PathPoint::at(equations, y, &border)
    }

    /// A solution with the path through it on the side of `border`.
    fn at(equations: &impl Equations, y: DVector<f64>, border: &DVector<f64>) -> Option<Self> {
        let jacobian = equations.jacobian(&y)?;
        // The null vector of the derivatives.
        let mut along_border = DVector::zeros(border.len());
        along_border[border.len() - 1] = 1.0;
        let tangent = jacobian.factored(Some(border))?.solve(&along_border)?;
        let length = tangent.norm();
        (length.is_finite() && length > 0.0).then(|| PathPoint {
            y,
            tangent: tangent / length,
            bend: None,
            jacobian,
        })
    }

    /// The same point with its tangent reversed: the curve is followed in the other direction from here.
    pub fn reversed(&self) -> Self {
        PathPoint { tangent: -&self.tangent, bend: None, ..self.clone() }
    }

    /// The point on the plane a length `ds` ahead; around turning points as elsewhere.
    pub fn advanced(&self, equations: &impl Equations, ds: f64) -> Option<Self> {
        let next = PathPoint::at(equations, self.ahead(equations, ds)?, &self.tangent)?;
        Some(PathPoint { bend: self.bend_at(&next), ..next })
    }

    /// How the path bends at the point after this one: as the cubic through both that has their tangents.
    fn bend_at(&self, next: &Self) -> Option<[DVector<f64>; 2]> {
        let back = &self.y - &next.y;
        let h = back.norm();
        let aside = (back + &next.tangent * h) / (h * h);
        let turned = (&next.tangent - &self.tangent) / h;
        let coefficients = [&aside * 3.0 - &turned, (aside * 2.0 - turned) / h];
        // What they have along the tangent is dropped: a guess is to lie on the plane a length ahead.
        let across = coefficients.map(|c| &c - &next.tangent * c.dot(&next.tangent));
        across.iter().flatten().all(|value| value.is_finite()).then_some(across)
    }

    /// About where the path is on the plane a length `ds` ahead.
    fn guess(&self, ds: f64) -> DVector<f64> {
        let straight = &self.y + &self.tangent * ds;
        let bent = self.bend.as_ref().map(|[q, c]| q * (ds * ds) + c * (ds * ds * ds));
        match bent.filter(|aside| aside.norm() <= ASIDE * ds) {
            Some(aside) => straight + aside,
            None => straight,
        }
    }

    /// The solution there alone, without the direction in which the path goes on.
    pub fn ahead(&self, equations: &impl Equations, ds: f64) -> Option<DVector<f64>> {
        let reach = ASIDE * ds + 10.0 * CONVERGED;
        corrected(equations, self.guess(ds), &self.tangent, &self.jacobian, reach)
    }

    /// Whether a path that goes from `here` to `next` passes this point in this point's own direction.
    pub fn lies_between(&self, here: &Self, next: &Self) -> bool {
        let step = (&next.y - &here.y).norm();
        let away = &self.y - &here.y;
        let along = away.dot(&here.tangent);
        let aside = (away - &here.tangent * along).norm();
        self.straightness(next) > PARALLEL && (0.0..=1.1 * step).contains(&along) && aside < 0.2 * step
    }

    /// How straight the path is from here to there: the cosine of the turn.
    pub fn straightness(&self, other: &Self) -> f64 {
        self.tangent.dot(&other.tangent)
    }
}

/// Newton's method on the hyperplane through the guess with normal `border`.
///
/// A solution farther than `reach` from the guess is refused. Derivatives are dear and change little from point to point: those at
/// hand are used until they no longer bring the correction down fast.
fn corrected(
    equations: &impl Equations,
    guess: DVector<f64>,
    border: &DVector<f64>,
    near: &Cyclic,
    reach: f64,
) -> Option<DVector<f64>> {
    let mut y = guess.clone();
    let mut factors = near.factored(Some(border))?;
    let mut before: Option<f64> = None;
    for _ in 0..MOST_STEPS {
        let residual = equations.residual(&y)?;
        let size = residual.amax();
        let correction = factors.solve(&residual.insert_row(y.len() - 1, 0.0))?;
        let step = correction.amax();
        if step > FARTHEST {
            return None;
        }
        y -= correction;
        // By which steps grow shorter while the derivatives stay the same.
        let rate = before.map_or(1.0, |before| (step / before).clamp(LEFT, 1.0));
        let last = step.max(size);
        if last < CONVERGED || last * rate < NEGLIGIBLE {
            // A solution farther off belongs to another branch.
            if (&y - &guess).norm() > reach {
                return None;
            }
            return Some(y);
        }
        let is_slow = before.is_some() && last * rate.powi(FURTHER) > CONVERGED;
        before = (!is_slow).then_some(step);
        if is_slow {
            factors = equations.jacobian(&y)?.factored(Some(border))?;
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² + y² = 1 with its own derivative left to differences.
    struct Circle;

    impl Equations for Circle {
        fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
            Some(DVector::from_element(1, y[0] * y[0] + y[1] * y[1] - 1.0))
        }
    }

    #[test]
    fn a_circle_is_followed_around_its_turning_points() {
        let mut point = PathPoint::near(&Circle, DVector::from_vec(vec![0.99, 0.1]), 1).unwrap();
        let start = point.y.clone();
        let mut turned = 0.0;
        while turned < std::f64::consts::TAU {
            let next = point.advanced(&Circle, 0.05).unwrap();
            turned += point.straightness(&next).acos();
            point = next;
            assert!((point.y.norm() - 1.0).abs() < 1e-9);
        }
        assert!((&point.y - start).norm() < 0.1, "it comes round: {}", point.y);
        assert!(PathPoint::near(&Circle, DVector::from_vec(vec![5.0, 8.0]), 1).is_none(), "no circle there");
    }

    /// y = 0.3 x² + 0.5 x³.
    struct Graph;

    impl Equations for Graph {
        fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
            Some(DVector::from_element(1, y[1] - y[0] * y[0] * (0.3 + 0.5 * y[0])))
        }
    }

    #[test]
    fn a_path_is_guessed_along_its_bend_and_how_that_changes() {
        let start = PathPoint::near(&Graph, DVector::from_vec(vec![0.5, 0.1]), 0).unwrap();
        let off = |ds: f64| {
            let here = start.advanced(&Graph, ds).unwrap();
            let ahead = here.ahead(&Graph, ds).unwrap();
            for place in [&ahead, &here.guess(ds)] {
                let along = (place - &here.y).dot(&here.tangent);
                assert!((along - ds).abs() < 1e-10, "{along} along the tangent");
            }
            ((here.guess(ds) - &ahead).norm(), (&here.y + &here.tangent * ds - ahead).norm())
        };
        let [(bent, straight), (bent_half, straight_half)] = [off(0.02), off(0.01)];
        assert!(bent < 1e-2 * straight, "{bent} of {straight}");
        let orders = [(bent / bent_half).log2(), (straight / straight_half).log2()];
        assert!((3.7..4.3).contains(&orders[0]), "of the fourth order: {orders:?}");
        assert!((1.7..2.3).contains(&orders[1]), "of the second order: {orders:?}");
    }
}
