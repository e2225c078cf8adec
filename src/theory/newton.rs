//! Newton's method on an impact sequence: every impact's time and state at once.

use nalgebra::{DMatrix, DVector};

use super::cyclic::Cyclic;
use super::flow::Flow;
use super::matching::{self, Arc};
use super::pattern::Pattern;
use super::section_vector::{Node, SectionVector, extent, mechanical, phase};

/// The most Newton steps.
const MOST_STEPS: usize = 60;
/// A step is halved at most so often.
const MOST_HALVINGS: usize = 12;
/// The largest residual of a solution, in units of [`System::unit`](crate::model::System::unit), relative to states that are larger.
pub const SOLVED: f64 = 1e-11;
/// The longest step to a solution that need not be improved; see [`extent`].
const SHORT: f64 = 1e-9;

/// The arcs of a motion, one after each impact.
pub(crate) fn arcs(flow: &Flow, pattern: &Pattern, sections: &[SectionVector]) -> Vec<Arc> {
    (0..sections.len()).map(|i| arc(flow, pattern, sections, i)).collect()
}

/// The same with the phases of another motion whose arcs are known, where the flow is the same but for the gaps.
pub(crate) fn arcs_with_gaps(
    flow: &Flow,
    pattern: &Pattern,
    sections: &[SectionVector],
    known: &[Arc],
) -> Vec<Arc> {
    let with_gaps = |(i, known): (usize, &Arc)| {
        let [from, to] = ends(flow, pattern, sections, i);
        known.with_gaps_of(flow, &from, &to)
    };
    known.iter().enumerate().map(with_gaps).collect()
}

/// The arc after the `i`-th impact.
fn arc(flow: &Flow, pattern: &Pattern, sections: &[SectionVector], i: usize) -> Arc {
    let [from, to] = ends(flow, pattern, sections, i);
    Arc::between(flow, &from, &to)
}

/// The impacts at the ends of that arc.
pub(crate) fn ends(flow: &Flow, pattern: &Pattern, sections: &[SectionVector], i: usize) -> [Node; 2] {
    let from = Node { stop: pattern.stops[i], section: sections[i].clone() };
    [from, next(flow, pattern, sections, i)]
}

/// The impact that follows the `i`-th.
pub(crate) fn next(flow: &Flow, pattern: &Pattern, sections: &[SectionVector], i: usize) -> Node {
    match sections.get(i + 1) {
        Some(section) => Node { stop: pattern.stops[i + 1], section: section.clone() },
        None => pattern.closing(flow, &sections[0]),
    }
}

/// The phase of the impact that follows the `i`-th.
pub(crate) fn next_phase(pattern: &Pattern, sections: &[SectionVector], i: usize) -> f64 {
    sections.get(i + 1).map_or_else(|| pattern.closing_phase(&sections[0]), phase)
}

/// The residuals of all arcs of a motion, without anything else of them.
pub(crate) fn residual_alone(flow: &Flow, pattern: &Pattern, sections: &[SectionVector]) -> DVector<f64> {
    let of_arc = |i: usize| -> Vec<f64> {
        let [from, to] = ends(flow, pattern, sections, i);
        matching::residual(flow, &from, &to).data.into()
    };
    DVector::from_vec((0..sections.len()).flat_map(of_arc).collect())
}

/// The residuals of all arcs.
pub(crate) fn residual(arcs: &[Arc]) -> DVector<f64> {
    let count = arcs.iter().map(|arc| arc.residual.len()).sum();
    DVector::from_iterator(count, arcs.iter().flat_map(|arc| arc.residual.iter().copied()))
}

/// The derivatives of the residuals of each arc by the section at its beginning, and by the next one.
pub(crate) fn joints(flow: &Flow, arcs: &[Arc], pattern: &Pattern) -> Vec<[DMatrix<f64>; 2]> {
    let last = arcs.len() - 1;
    let to = |i: usize, arc: &Arc| match i == last {
        true => arc.to() * pattern.closing_matrix(flow),
        false => arc.to(),
    };
    arcs.iter().enumerate().map(|(i, arc)| [arc.from.clone(), to(i, arc)]).collect()
}

/// Solves the matching equations from a guess; none if that leads nowhere.
///
/// Returns the sections and the largest residual left. The phases of the solution are in order; whether it is
/// admissible (crosses no stop in flight) is another question.
pub(crate) fn solve(
    flow: &Flow,
    pattern: &Pattern,
    guess: &[SectionVector],
) -> Option<(Vec<SectionVector>, f64)> {
    let (mut sections, unit) = (guess.to_vec(), flow.unit());
    let mut joined = arcs(flow, pattern, &sections);
    let mut residuals = residual(&joined);
    let mut size = residuals.norm();
    for _ in 0..MOST_STEPS {
        if !size.is_finite() {
            return None;
        }
        let step = Cyclic::of_motion(joints(flow, &joined, pattern)).factored(None)?.solve(&residuals)?;
        let mut share = 1.0;
        let mut accepted = false;
        for _ in 0..MOST_HALVINGS {
            let trial = moved(&sections, &step, -share);
            let trial_arcs = arcs(flow, pattern, &trial);
            let trial_residuals = residual(&trial_arcs);
            let trial_size = trial_residuals.norm();
            if trial_size < size && is_ordered(pattern, &trial) {
                (sections, joined, residuals, size) = (trial, trial_arcs, trial_residuals, trial_size);
                accepted = true;
                break;
            }
            share *= 0.5;
        }
        let scale = unit + sections.iter().map(|section| mechanical(section).amax()).fold(0.0, f64::max);
        let solved = residuals.amax() <= SOLVED * scale;
        if !accepted || (solved && longest(&step, sections[0].len(), unit) * share <= SHORT * (scale / unit))
        {
            return solved.then_some((sections, residuals.amax()));
        }
    }
    None
}

/// How far a step moves the section that it moves farthest, each having so many components.
fn longest(step: &DVector<f64>, components: usize, unit: f64) -> f64 {
    let of = |i: usize| extent(&step.rows(components * i, components).into_owned(), unit);
    (0..step.len() / components).map(of).fold(0.0, f64::max)
}

fn moved(sections: &[SectionVector], step: &DVector<f64>, share: f64) -> Vec<SectionVector> {
    let size = sections[0].len();
    sections.iter().enumerate().map(|(i, section)| section + share * step.rows(size * i, size)).collect()
}

/// Whether every impact comes after the one before it.
pub(crate) fn is_ordered(pattern: &Pattern, sections: &[SectionVector]) -> bool {
    (0..sections.len()).all(|i| next_phase(pattern, sections, i) > phase(&sections[i]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Stop;
    use crate::model::{Parameters, System};
    use crate::theory::example::{Ball, chain};

    fn found(ball: Ball, guess: [f64; 2]) -> Option<(Vec<SectionVector>, f64)> {
        let system = ball.system();
        let pattern = Pattern::new(&system, vec![Stop::A], 2, false);
        solve(&Flow::new(&system), &pattern, &[SectionVector::from_row_slice(&guess)])
    }

    #[test]
    fn the_bouncing_ball_has_the_motions_of_its_closed_form() {
        let ball = Ball::STABLE;
        for other in [false, true] {
            let [speed, phase] = ball.section(other).unwrap();
            for guess in [[speed, phase], [speed + 0.05, phase - 0.1], [speed - 0.1, phase + 0.05]] {
                let (sections, residual) = found(ball, guess).unwrap();
                let away = (sections[0][0] - speed).abs().max((sections[0][1] - phase).abs());
                assert!(away < 1e-10 && residual < SOLVED, "{guess:?}: {sections:?} for {speed} {phase}");
                assert!(
                    (sections[0][1] - ball.section(!other).unwrap()[1]).abs() > 0.5,
                    "the check can fail"
                );
            }
        }
    }

    #[test]
    fn a_force_too_small_to_throw_the_ball_back_leads_nowhere() {
        let weak = Ball { force: 0.1, ..Ball::STABLE };
        assert_eq!(weak.section(false), None);
        assert!(found(weak, [-0.8, 4.0]).is_none() && found(weak, [-0.8, 3.1]).is_none());
        assert!(found(Ball::STABLE, [f64::NAN, 4.0]).is_none());
    }

    #[test]
    fn the_derivative_is_that_of_finite_differences() {
        let system = chain();
        let flow = Flow::new(&system);
        let pattern = Pattern::new(&system, vec![Stop::A, Stop::B, Stop::B], 3, true);
        let component =
            |i: usize, j: usize| if j == 5 { 2.0 * i as f64 } else { 0.3 * ((7 * i + j) as f64).sin() };
        let sections: Vec<SectionVector> =
            (0..3).map(|i| SectionVector::from_fn(6, |j, _| component(i, j))).collect();
        let joined = arcs(&flow, &pattern, &sections);
        let matrix = Cyclic::of_motion(joints(&flow, &joined, &pattern)).whole();
        let step = 1e-5;
        for column in 0..18 {
            let of = |sign: f64| {
                let mut moved = sections.clone();
                moved[column / 6][column % 6] += sign * step;
                residual(&arcs(&flow, &pattern, &moved))
            };
            let difference = (of(1.0) - of(-1.0)) / (2.0 * step);
            let away = (matrix.column(column) - &difference).amax();
            assert!(away < 1e-8 * (1.0 + difference.amax()), "{column}: {away}");
        }
        assert!(matrix.amax() > 0.1, "the check can fail");
    }

    #[test]
    fn where_gaps_alone_differ_arcs_follow_from_those_that_are_known() {
        let at = |omega: f64, delta: f64, r: f64| {
            Flow::new(&System::new(Parameters { omega, delta, r, ..Parameters::default() }).unwrap())
        };
        let system = System::new(Parameters::default()).unwrap();
        let pattern = Pattern::new(&system, vec![Stop::A, Stop::B, Stop::B], 4, false);
        let component =
            |i: usize, j: usize| if j == 3 { 2.5 * i as f64 } else { (0.7 * (4 * i + j) as f64).cos() };
        let sections: Vec<SectionVector> =
            (0..3).map(|i| SectionVector::from_fn(4, |j, _| component(i, j))).collect();
        let (here, wider) = (at(3.7, 0.1, 0.8), at(3.7, 0.3, 0.8));
        assert!(wider.is_but_for_gaps(&here));
        assert!(!at(3.6, 0.3, 0.8).is_but_for_gaps(&here) && !at(3.7, 0.3, 0.7).is_but_for_gaps(&here));
        let (known, anew) = (arcs(&here, &pattern, &sections), arcs(&wider, &pattern, &sections));
        let found = arcs_with_gaps(&wider, &pattern, &sections, &known);
        let off = |arcs: &[Arc]| {
            let each = arcs.iter().zip(&anew).map(|(own, anew)| {
                let [matrices, vectors] =
                    [(&own.from - &anew.from).amax(), (&own.arriving - &anew.arriving).amax()];
                matrices.max(vectors).max((&own.residual - &anew.residual).amax())
            });
            each.fold(0.0, f64::max)
        };
        assert_eq!(off(&found), 0.0);
        assert!(off(&known) > 1e-2, "the check can fail");
    }

    #[test]
    fn impacts_are_in_order_where_each_comes_later() {
        let system = chain();
        let pattern = Pattern::new(&system, vec![Stop::A, Stop::B], 2, false);
        let at = |phases: [f64; 2]| {
            let sections =
                phases.map(|phase| SectionVector::from_row_slice(&[-0.3, 0.0, 0.0, 0.0, 0.0, phase]));
            is_ordered(&pattern, &sections)
        };
        let turn = pattern.turn();
        assert!(at([0.0, 1.0]) && at([1.0, 0.999 * turn]) && at([-1.0, 0.0]));
        assert!(!at([1.0, 1.0]) && !at([1.0, 0.5]) && !at([0.0, turn]) && !at([0.0, 1.1 * turn]));
    }
}
