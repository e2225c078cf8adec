//! What the paper calls the curves and regions of its Fig. 5.

use crate::analysis::{Regime, Verdict};
use crate::curves::{Criticality, Curve, CurveMotion, Kind};
use crate::model::{Parameter, Parameters, Setting};
use crate::plane::{Plane, Quantity};

/// Whether the paper's names have a meaning on a plane: ω and δ vary, and everything else is as in the paper.
pub fn is_plane_of_paper(plane: &Plane) -> bool {
    let names = [plane.x.quantity, plane.y.quantity].map(Quantity::name);
    let paper = Setting::from(Parameters::default());
    let as_printed = |(parameter, value): (Parameter, f64)| {
        names.contains(&parameter.name()) || plane.parameters.get(parameter) == value
    };
    plane.parameters.family().is_paper()
        && ["omega", "delta"].iter().all(|name| names.contains(name))
        && paper.entries().all(as_printed)
}

/// The paper's name of a curve where it has some criticality, L1 to L7, by motion and kind; none for most curves.
pub(super) fn curve_name(curve: &Curve, criticality: Option<Criticality>) -> Option<&'static str> {
    let CurveMotion { n, impacts, symmetric, .. } = &curve.motion;
    let [p, q] = impacts[..] else { return None };
    match (curve.kind, [*n, p, q], *symmetric) {
        (Kind::NeimarkSacker, [1, 1, 1], true) => criticality.map(|criticality| match criticality {
            Criticality::Supercritical => "L1",
            Criticality::Subcritical => "L2",
        }),
        (Kind::Pitchfork, [1, 1, 1], true) => Some("L3"),
        (Kind::NeimarkSacker, [1, 1, 1], false) => Some("L4"),
        (Kind::Fold, [1, 2, 2], true) => Some("L5"),
        (Kind::Pitchfork, [1, 2, 2], true) => Some("L6"),
        (Kind::PeriodDoubling, [1, 2, 2], false) => Some("L7"),
        _ => None,
    }
}

/// The paper's name of the region of a motion that repeats, R1, R2, R4, R5 or R6; none for most motions.
///
/// R3 and R7, where nothing repeats soon, are told apart by what is beside them and not by a cell alone.
pub fn region_name(verdict: &Verdict) -> Option<&'static str> {
    if verdict.regime != Regime::Periodic {
        return None;
    }
    match ([verdict.n, verdict.p(), verdict.q()], verdict.symmetric) {
        ([1, 1, 1], true) => Some("R1"),
        ([1, 1, 1], false) => Some("R2"),
        ([1, 2, 2], true) => Some("R4"),
        ([1, 2, 2], false) => Some("R5"),
        ([n, p, q], _) if n > 1 && n.is_power_of_two() && p == 2 * n && q == p => Some("R6"),
        _ => None,
    }
}
