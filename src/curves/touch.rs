//! How near a motion comes to the stops between its impacts, and how slowly it strikes them.
//!
//! Grazing: A. B. Nordmark, J. Sound Vib. 145 (1991) 279–297, doi:10.1016/0022-460X(91)90592-8; M. di Bernardo, C. J. Budd,
//! A. R. Champneys, P. Kowalczyk, Piecewise-smooth Dynamical Systems, Springer (2008), doi:10.1007/978-1-84628-708-4.

use nalgebra::{DMatrix, DVector};

use crate::dynamics::Stop;
use crate::model::System;
use crate::theory::newton::next;
use crate::theory::{Arc, Flow, Pattern, SectionVector, phase};

/// A turning point in flight, along a stop's direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Touch {
    /// The arc it lies on: after the impact of this number.
    pub arc: usize,
    /// The stop that it is turned towards.
    pub stop: Stop,
    /// Its forcing phase, on the scale of the sections.
    pub phase: f64,
    /// How far from the stop; negative beyond it.
    pub gap: f64,
}

/// Every turning point towards a stop, in order.
///
/// They are looked for at steps short against the fastest motion and placed by cubic interpolation: near enough to
/// begin with, not a certificate.
pub(super) fn touches(
    system: &System,
    flow: &Flow,
    pattern: &Pattern,
    sections: &[SectionVector],
) -> Vec<Touch> {
    let mut found = Vec::new();
    for (arc, section) in sections.iter().enumerate() {
        let time = (phase(&next(flow, pattern, sections, arc).section) - phase(section)) / flow.omega;
        let steps = (time * f64::from(system.steps()) / system.period() * 2.0).ceil().max(1.0);
        let h = time / steps;
        let step = flow.over(h);
        let mut here = flow.lifted(pattern.stops[arc], section);
        for k in 0..steps as u32 {
            let there = step.as_ref() * &here;
            for (stop, face) in flow.faces() {
                let ([x, v], [x_end, v_end]) = (face.along(&here), face.along(&there));
                if v > 0.0 && v_end < 0.0 {
                    let share = v / (v - v_end);
                    found.push(Touch {
                        arc,
                        stop,
                        phase: phase(section) + flow.omega * h * (f64::from(k) + share),
                        gap: face.gap - hermite(share, h, x, v, x_end, v_end),
                    });
                }
            }
            here = there;
        }
    }
    found
}

/// The cubic Hermite interpolant.
fn hermite(share: f64, h: f64, x: f64, v: f64, x_end: f64, v_end: f64) -> f64 {
    let rest = 1.0 - share;
    x * rest * rest * (1.0 + 2.0 * share)
        + x_end * share * share * (3.0 - 2.0 * share)
        + h * share * rest * (v * rest - v_end * share)
}

/// The touch that comes nearest to its stop, or goes farthest beyond it.
pub(super) fn nearest(touches: &[Touch]) -> Option<Touch> {
    touches.iter().copied().min_by(|a, b| a.gap.total_cmp(&b.gap))
}

/// The speed of every impact of a motion with these arcs on arrival, negative where the stop would be reached from the wrong side;
/// the first belongs to the second impact.
pub(super) fn arrival_speeds(flow: &Flow, arcs: &[Arc]) -> Vec<f64> {
    arcs.iter().map(|arc| arc.approach() * flow.omega).collect()
}

/// How far beyond the stop a motion is at a phase on one of its arcs, and how fast it moves into it: both vanish where it
/// grazes.
pub(super) fn grazing(
    flow: &Flow,
    pattern: &Pattern,
    sections: &[SectionVector],
    touch: (usize, Stop),
    at: f64,
) -> [f64; 2] {
    let (arc, stop) = touch;
    let section = &sections[arc];
    let z = &*flow.over((at - phase(section)) / flow.omega) * flow.lifted(pattern.stops[arc], section);
    let face = flow.face(stop);
    let [place, speed] = face.along(&z);
    [place - face.gap, speed]
}

/// The derivatives of both by the section at which the arc begins, and by the phase.
pub(super) fn grazing_by_section(
    flow: &Flow,
    pattern: &Pattern,
    sections: &[SectionVector],
    (arc, stop): (usize, Stop),
    at: f64,
) -> (DMatrix<f64>, DVector<f64>) {
    let (section, from) = (&sections[arc], pattern.stops[arc]);
    let over = flow.over((at - phase(section)) / flow.omega);
    let along = |columns: &DMatrix<f64>| {
        let pairs: Vec<f64> =
            columns.column_iter().flat_map(|z| flow.face(stop).along(&z.into_owned())).collect();
        DMatrix::from_vec(2, columns.ncols(), pairs)
    };
    let z = flow.lifted(from, section);
    // Later, and with a forcing that is farther on.
    let [later, turned] = [flow.generator() * &z / flow.omega, flow.turned(&z)]
        .map(|z| along(&DMatrix::from_columns(&[&*over * z])).column(0).into_owned());
    let mut by_section = along(&(&*over * &flow.face(from).lift));
    by_section.set_column(section.len() - 1, &(turned - &later));
    (by_section, later)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    #[test]
    fn a_touch_moves_with_the_section_before_it_and_with_its_phase() {
        let system = System::new(Parameters::default()).unwrap();
        let flow = Flow::new(&system);
        let pattern = Pattern::new(&system, vec![Stop(0), Stop(1)], 2, false);
        let sections = [[-0.3, 0.1, 0.2, 0.4], [0.5, -0.2, 0.1, 3.3]]
            .map(|values| SectionVector::from_row_slice(&values));
        let (touch, at) = ((1, Stop(0)), 5.1);
        let (by_section, by_phase) = grazing_by_section(&flow, &pattern, &sections, touch, at);
        let differences = |change: &dyn Fn(f64) -> [f64; 2]| {
            let (above, below) = (change(1e-6), change(-1e-6));
            DVector::from_fn(2, |i, _| (above[i] - below[i]) / 2e-6)
        };
        for j in 0..4 {
            let moved = |by: f64| {
                let mut sections = sections.clone();
                sections[1][j] += by;
                grazing(&flow, &pattern, &sections, touch, at)
            };
            let off = (by_section.column(j) - differences(&moved)).amax();
            assert!(off < 1e-8, "{j}: {by_section}");
        }
        let off = (&by_phase - differences(&|by| grazing(&flow, &pattern, &sections, touch, at + by))).amax();
        assert!(off < 1e-8, "{by_phase}");
        assert!((by_section.column(3) + by_phase).amax() > 1e-2, "the check can fail");
    }
}
