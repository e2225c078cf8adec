//! How near a motion comes to the stops between its impacts, and how slowly it strikes them.
//!
//! Grazing: A. B. Nordmark, J. Sound Vib. 145 (1991) 279–297, doi:10.1016/0022-460X(91)90592-8; M. di Bernardo, C. J. Budd,
//! A. R. Champneys, P. Kowalczyk, Piecewise-smooth Dynamical Systems, Springer (2008), doi:10.1007/978-1-84628-708-4.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use crate::dynamics::Stop;
use crate::model::System;
use crate::theory::newton::next;
use crate::theory::{Arc, Face, Flow, Pattern, SectionVector, phase};

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

/// A motion at a phase on one of its arcs, where it may touch a stop.
pub(super) struct Grazing<'a> {
    flow: &'a Flow,
    /// The stop that the arc comes from.
    from: &'a Face,
    /// The stop that may be touched.
    touched: &'a Face,
    /// Just after the impact at which the arc begins.
    start: DVector<f64>,
    over: Cow<'a, DMatrix<f64>>,
}

impl<'a> Grazing<'a> {
    /// On an arc, at the phase.
    pub fn new(
        flow: &'a Flow,
        pattern: &Pattern,
        sections: &[SectionVector],
        (arc, touched): (usize, Stop),
        at: f64,
    ) -> Self {
        let (section, from) = (&sections[arc], pattern.stops[arc]);
        Grazing {
            flow,
            from: flow.face(from),
            touched: flow.face(touched),
            start: flow.lifted(from, section),
            over: flow.over((at - phase(section)) / flow.omega),
        }
    }

    /// How far beyond the stop the motion is, and how fast it moves into it: both vanish where it grazes. None where one is no
    /// finite number.
    pub fn values(&self) -> Option<DVector<f64>> {
        let mut values = self.along(&self.start);
        values[0] -= self.touched.gap;
        values.iter().all(|value| value.is_finite()).then_some(values)
    }

    /// The derivatives of both by the section at which the arc begins; 2 × 2n.
    pub fn by_section(&self) -> DMatrix<f64> {
        let mut columns: Vec<_> =
            self.from.lift.column_iter().map(|column| self.along(&column.into_owned())).collect();
        // A later start: the forcing is farther on, and there is less time.
        let last = columns.len() - 1;
        columns[last] = self.along(&self.flow.turned(&self.start)) - self.by_phase();
        DMatrix::from_columns(&columns)
    }

    /// Their derivatives by the phase.
    pub fn by_phase(&self) -> DVector<f64> {
        self.along(&(self.flow.generator() * &self.start / self.flow.omega))
    }

    /// d·x and d·v, towards the stop, of what flight makes of z.
    fn along(&self, z: &DVector<f64>) -> DVector<f64> {
        DVector::from_row_slice(&self.touched.along(&(&*self.over * z)))
    }
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
        let grazing = |sections: &[SectionVector], at| Grazing::new(&flow, &pattern, sections, touch, at);
        let values = |sections: &[SectionVector], at| grazing(sections, at).values().unwrap();
        let (by_section, by_phase) = (grazing(&sections, at).by_section(), grazing(&sections, at).by_phase());
        let differences = |change: &dyn Fn(f64) -> DVector<f64>| (change(1e-6) - change(-1e-6)) / 2e-6;
        for j in 0..4 {
            let moved = |by: f64| {
                let mut sections = sections.clone();
                sections[1][j] += by;
                values(&sections, at)
            };
            let off = (by_section.column(j) - differences(&moved)).amax();
            assert!(off < 1e-8, "{j}: {by_section}");
        }
        let off = (&by_phase - differences(&|by| values(&sections, at + by))).amax();
        assert!(off < 1e-8, "{by_phase}");
        assert!((by_section.column(3) + by_phase).amax() > 1e-2, "the check can fail");
    }
}
