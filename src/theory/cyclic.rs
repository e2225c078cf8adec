//! Linear equations around a motion, where every impact is joined to the next one only.

use nalgebra::{DVector, Matrix4, SMatrix, Vector4};

use super::matching::Arc;
use super::pattern::Pattern;

/// What is left of an impact's unknowns x once they are eliminated: R x = c − E x₀ − F x′, with x₀ those of the first
/// impact and x′ those of the next.
struct Eliminated {
    r: Matrix4<f64>,
    e: Matrix4<f64>,
    f: Matrix4<f64>,
    c: Vector4<f64>,
}

/// Solves ∂R·x = R for the matching equations of all arcs, in time and memory proportional to their number.
///
/// The impacts are eliminated in order, each by an orthogonal transformation of the two arcs that it joins, so that
/// the equations are as well conditioned at the end as they were. None where they are singular.
pub(super) fn solve(arcs: &[Arc], pattern: &Pattern) -> Option<DVector<f64>> {
    let [first, others @ ..] = arcs else { return None };
    let (mut from, mut to, mut residual) = (first.from, first.to(), first.residual);
    let mut eliminated = Vec::with_capacity(others.len());
    for arc in others {
        let mut joint = SMatrix::<f64, 8, 4>::zeros();
        joint.fixed_view_mut::<4, 4>(0, 0).copy_from(&to);
        joint.fixed_view_mut::<4, 4>(4, 0).copy_from(&arc.from);
        let mut rest = SMatrix::<f64, 8, 9>::zeros();
        rest.fixed_view_mut::<4, 4>(0, 0).copy_from(&from);
        rest.fixed_view_mut::<4, 4>(4, 4).copy_from(&arc.to());
        rest.fixed_view_mut::<4, 1>(0, 8).copy_from(&residual);
        rest.fixed_view_mut::<4, 1>(4, 8).copy_from(&arc.residual);
        let factors = joint.qr();
        factors.q_tr_mul(&mut rest);
        eliminated.push(Eliminated {
            r: factors.r(),
            e: rest.fixed_view::<4, 4>(0, 0).into_owned(),
            f: rest.fixed_view::<4, 4>(0, 4).into_owned(),
            c: rest.fixed_view::<4, 1>(0, 8).into_owned(),
        });
        from = rest.fixed_view::<4, 4>(4, 0).into_owned();
        to = rest.fixed_view::<4, 4>(4, 4).into_owned();
        residual = rest.fixed_view::<4, 1>(4, 8).into_owned();
    }
    let closing = Matrix4::from_diagonal(&pattern.closing_factors());
    let start = (from + to * closing).lu().solve(&residual)?;
    let mut solution = DVector::zeros(4 * arcs.len());
    solution.fixed_rows_mut::<4>(0).copy_from(&start);
    let mut next = closing * start;
    for (i, Eliminated { r, e, f, c }) in eliminated.iter().enumerate().rev() {
        next = r.solve_upper_triangular(&(c - e * start - f * next))?;
        solution.fixed_rows_mut::<4>(4 * (i + 1)).copy_from(&next);
    }
    solution.iter().all(|value| value.is_finite()).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Stop;
    use crate::model::{Parameters, System};
    use crate::theory::flow::{Flow, Section};
    use crate::theory::newton::{arcs, derivative, residual};

    /// A sequence that is no motion, so that no block of the equations is special.
    fn sequence(count: usize, mirrored: bool) -> (Pattern, Vec<Section>) {
        let stops = (0..count).map(|i| if i % 3 == 0 { Stop::A } else { Stop::B }).collect();
        let pattern = Pattern { stops, half_turns: if mirrored { 3 } else { 4 }, mirrored };
        let turn = f64::from(pattern.half_turns) * std::f64::consts::PI;
        let at = |i: usize| {
            let k = i as f64;
            Section::new(-0.3 + 0.1 * k.sin(), 0.2 * k.cos(), 0.1 * (2.0 * k).sin(), turn * k / count as f64)
        };
        (pattern, (0..count).map(at).collect())
    }

    #[test]
    fn the_solution_is_that_of_the_whole_matrix() {
        let flow = Flow::new(&System::new(Parameters::default()).unwrap());
        for (count, mirrored) in [(1, true), (1, false), (2, false), (7, true), (12, false)] {
            let (pattern, sections) = sequence(count, mirrored);
            let joined = arcs(&flow, &pattern, &sections);
            let matrix = derivative(&joined, &pattern);
            let right = residual(&joined);
            let solution = solve(&joined, &pattern).unwrap();
            assert!((&matrix * &solution - &right).amax() < 1e-10 * (1.0 + solution.amax()), "{count}");
            let other = Pattern { mirrored: !mirrored, ..pattern };
            let wrong = solve(&joined, &other).unwrap();
            assert!((&matrix * &wrong - &right).amax() > 1e-6, "the check can fail");
        }
    }
}
