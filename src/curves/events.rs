//! What is evaluated at every point of a bifurcation curve.

use nalgebra::{Complex, DVector};

use super::branch::Event;
use super::condition::{Kind, split};
use super::curve::{Criticality, CurvePoint, End, Special};
use super::locus::Locus;
use super::special::{Monitor, monitors};
use super::touch::{arrival_speeds, touches};
use crate::model::{Setting, System};
use crate::theory::newton::arcs;
use crate::theory::{Arc, Flow, NormalForm, PeriodicMotion, eigenvalues, fly, in_units, turn_along};

/// The length by which a stop may be crossed before it counts, in units of what is of order one.
const CROSSED: f64 = 1e-9;

/// Why a curve ends, and what its last point is called.
pub(super) type Reason = (End, Option<Special>);

/// What is known of a point of a path.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub point: CurvePoint,
    pub motion: PeriodicMotion,
    pub parameters: Setting,
    pub monitors: Vec<Monitor>,
    /// Why the path cannot go beyond it, if it is already beyond the end.
    pub beyond: Option<Reason>,
}

impl Seen {
    /// The same place with the name of a special point, if there is one.
    pub fn named(mut self, special: Option<Special>) -> Self {
        self.point.special = special.or(self.point.special);
        self
    }

    /// The same place as the last one of a curve.
    ///
    /// Where the curve's motion or its multipliers degenerate, the normal form does as well.
    pub fn ending(mut self, end: End, special: Option<Special>) -> Self {
        if matches!(end, End::Simplifies | End::Resonance11 | End::Resonance12) {
            self.point.criticality = None;
        }
        self.named(special)
    }

    /// The other bifurcation of the same motion that begins at a special point, if there is one.
    ///
    /// At a strong resonance the two critical multipliers of a fold, or of a period doubling, are the limit of a
    /// Neimark–Sacker pair.
    pub fn offspring(&self, kind: Kind) -> Option<Event> {
        let begins = match self.point.special? {
            Special::Resonance11 => kind == Kind::Fold,
            Special::Resonance12 => matches!(kind, Kind::PeriodDoubling | Kind::Pitchfork),
            _ => false,
        };
        begins.then(|| Event {
            kind: Kind::NeimarkSacker,
            pattern: self.motion.pattern.clone(),
            sections: self.motion.sections.clone(),
            parameters: self.parameters,
            touch: None,
        })
    }
}

/// Everything about a point of a path, with about the direction in which that goes on; none where it cannot be told.
pub(super) fn look(locus: &Locus, y: &DVector<f64>, tangent: &DVector<f64>) -> Option<Seen> {
    let unknowns = &locus.unknowns;
    let system = unknowns.system(y)?;
    let (flow, sections) = (Flow::new(&system), unknowns.sections(y));
    let arcs = arcs(&flow, &unknowns.pattern, &sections);
    let unit = unknowns.unit;
    let map = in_units(turn_along(&flow, &unknowns.pattern, &arcs)?, unit);
    let multipliers = eigenvalues(&map)?;
    let motion = PeriodicMotion { pattern: unknowns.pattern.clone(), sections, residual: 0.0 };
    let (critical, others) = split(locus.kind, &multipliers);
    let form = NormalForm { flow: &flow, motion: &motion, unit, map: &map };
    let coefficient = match locus.kind {
        Kind::Fold | Kind::Grazing => None,
        Kind::PeriodDoubling | Kind::Pitchfork => form.flip(),
        Kind::NeimarkSacker => form.neimark_sacker(critical[0].arg().abs()).map(|re_d| -re_d),
    };
    let parameters = unknowns.parameters(y);
    let point = CurvePoint {
        x: parameters.get(unknowns.spans[0].parameter),
        y: parameters.get(unknowns.spans[1].parameter),
        criticality: coefficient
            .map(|c| if c > 0.0 { Criticality::Supercritical } else { Criticality::Subcritical }),
        bounding: others.iter().all(|value| value.norm() < 1.0),
        special: None,
    };
    let monitors = monitors(locus, tangent, &form, coefficient, &critical, &others);
    let beyond = beyond(locus, y, (&system, &flow), (&motion, &arcs), &critical);
    Some(Seen { point, parameters, monitors, beyond, motion })
}

/// Why a curve ends before this point, if it does.
fn beyond(
    locus: &Locus,
    y: &DVector<f64>,
    (system, flow): (&System, &Flow),
    (motion, arcs): (&PeriodicMotion, &[Arc]),
    critical: &[Complex<f64>],
) -> Option<Reason> {
    let from = locus.unknowns.parameters_at();
    if y.rows(from, 2).iter().any(|share| !(0.0..=1.0).contains(share)) {
        return Some((End::LeavesPlane, None));
    }
    if locus.kind == Kind::NeimarkSacker && critical[0].im.abs() < 1e-9 {
        return Some(if critical[0].re > 0.0 {
            (End::Resonance11, Some(Special::Resonance11))
        } else {
            (End::Resonance12, Some(Special::Resonance12))
        });
    }
    let pattern = &motion.pattern;
    if arrival_speeds(flow, arcs).iter().any(|&speed| speed < 0.0) {
        return Some((End::ImpactVanishes, Some(Special::Grazing)));
    }
    let own = |arc: usize, phase: f64| {
        locus.touch.is_some_and(|(its_arc, _)| its_arc == arc && (phase - locus.touch_phase(y)).abs() < 1e-3)
    };
    let crossed = touches(system, flow, pattern, &motion.sections)
        .iter()
        .any(|touch| touch.gap < -CROSSED * locus.unknowns.unit && !own(touch.arc, touch.phase));
    let certified = locus.kind == Kind::Grazing || fly(system, &motion.pattern, &motion.sections).is_ok();
    (crossed || !certified).then_some((End::Grazes, Some(Special::Grazing)))
}
