//! Linear equations around a motion, where every impact is joined to the next one only.

use nalgebra::{DMatrix, DVector};

use super::flow::Flow;
use super::matching::Arc;
use super::pattern::Pattern;

/// What is left of an impact's unknowns x once they are eliminated: R x = c − E x₀ − F x′, with x₀ those of the first
/// impact and x′ those of the next.
struct Eliminated {
    r: DMatrix<f64>,
    e: DMatrix<f64>,
    f: DMatrix<f64>,
    c: DVector<f64>,
}

/// Solves ∂R·x = R for the matching equations of all arcs, in time and memory proportional to their number.
///
/// The impacts are eliminated in order, each by an orthogonal transformation of the two arcs that it joins, so that
/// the equations are as well conditioned at the end as they were. None where they are singular.
pub(super) fn solve(flow: &Flow, arcs: &[Arc], pattern: &Pattern) -> Option<DVector<f64>> {
    let [first, others @ ..] = arcs else { return None };
    let m = 2 * flow.n;
    let (mut from, mut to, mut residual) = (first.from.clone(), first.to(), first.residual.clone());
    let mut eliminated = Vec::with_capacity(others.len());
    for arc in others {
        let mut joint = DMatrix::zeros(2 * m, m);
        joint.rows_mut(0, m).copy_from(&to);
        joint.rows_mut(m, m).copy_from(&arc.from);
        let mut rest = DMatrix::zeros(2 * m, 2 * m + 1);
        rest.view_mut((0, 0), (m, m)).copy_from(&from);
        rest.view_mut((m, m), (m, m)).copy_from(&arc.to());
        rest.view_mut((0, 2 * m), (m, 1)).copy_from(&residual);
        rest.view_mut((m, 2 * m), (m, 1)).copy_from(&arc.residual);
        let factors = joint.qr();
        factors.q_tr_mul(&mut rest);
        eliminated.push(Eliminated {
            r: factors.r(),
            e: rest.view((0, 0), (m, m)).into_owned(),
            f: rest.view((0, m), (m, m)).into_owned(),
            c: rest.view((0, 2 * m), (m, 1)).column(0).into_owned(),
        });
        from = rest.view((m, 0), (m, m)).into_owned();
        to = rest.view((m, m), (m, m)).into_owned();
        residual = rest.view((m, 2 * m), (m, 1)).column(0).into_owned();
    }
    let closing = pattern.closing_matrix(flow);
    let start = (from + to * &closing).lu().solve(&residual)?;
    let mut solution = DVector::zeros(m * arcs.len());
    solution.rows_mut(0, m).copy_from(&start);
    let mut next = closing * &start;
    for (i, Eliminated { r, e, f, c }) in eliminated.iter().enumerate().rev() {
        next = r.solve_upper_triangular(&(c - e * &start - f * next))?;
        solution.rows_mut(m * (i + 1), m).copy_from(&next);
    }
    solution.iter().all(|value| value.is_finite()).then_some(solution)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Stop;
    use crate::model::{Parameters, System};
    use crate::theory::example::chain;
    use crate::theory::flow::Flow;
    use crate::theory::newton::{arcs, derivative, residual};
    use crate::theory::section_vector::SectionVector;

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
    fn the_solution_is_that_of_the_whole_matrix() {
        for system in [System::new(Parameters::default()).unwrap(), chain()] {
            let flow = Flow::new(&system);
            for (count, mirrored) in [(1, true), (1, false), (2, false), (7, true), (12, false)] {
                let (pattern, sections) = sequence(&system, count, mirrored);
                let joined = arcs(&flow, &pattern, &sections);
                let matrix = derivative(&flow, &joined, &pattern);
                let right = residual(&joined);
                let solution = solve(&flow, &joined, &pattern).unwrap();
                assert!((&matrix * &solution - &right).amax() < 1e-10 * (1.0 + solution.amax()), "{count}");
                let other = Pattern { mirrored: !mirrored, ..pattern };
                let wrong = solve(&flow, &joined, &other).unwrap();
                assert!((&matrix * &wrong - &right).amax() > 1e-6, "the check can fail");
            }
        }
    }
}
