//! Where the motion without impact grazes: its amplitude is the half clearance.

use nalgebra::DVector;

use super::condition::Kind;
use super::curve::{Curve, CurveMotion, CurvePoint, End};
use super::path::{Equations, PathPoint};
use super::unknowns::Span;
use crate::model::{Flight, Setting, System};
use crate::plane::RegionMap;

/// The longest step, in sides of the plane.
const STEP: f64 = 5e-3;
/// The most points in one direction.
const MOST_POINTS: usize = 2000;
/// Places along each side at which the curve is looked for.
const SCAN: u32 = 64;

/// The amplitude of the forced response of x1 equals δ.
struct Reach {
    fixed: Setting,
    spans: [Span; 2],
}

impl Reach {
    fn parameters(&self, shares: [f64; 2]) -> Setting {
        self.spans
            .iter()
            .zip(shares)
            .fold(self.fixed, |parameters, (span, share)| parameters.with(span.parameter, span.value(share)))
    }

    /// ln of amplitude over half clearance: as smooth at a resonance as elsewhere.
    fn excess(&self, shares: [f64; 2]) -> Option<f64> {
        let system = System::new(self.parameters(shares)).ok()?;
        let excess = {
            let normal = Flight::<f64, 2>::new(&system).normals[0];
            (normal.reach[0] / normal.gap[0]).ln()
        };
        excess.is_finite().then_some(excess)
    }
}

impl Equations for Reach {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        self.excess([y[0], y[1]]).map(|value| DVector::from_element(1, value))
    }
}

/// The curves on which the motion without impact begins to touch the stops.
pub(super) fn no_impact_curve(map: &RegionMap, spans: [Span; 2]) -> Vec<Curve> {
    let reach = Reach { fixed: map.plane.parameters, spans };
    let mut curves: Vec<(Vec<[f64; 2]>, Curve)> = Vec::new();
    for line in 0..=SCAN {
        let across = f64::from(line) / f64::from(SCAN);
        for along in 0..SCAN {
            let ends = [f64::from(along), f64::from(along + 1)].map(|i| i / f64::from(SCAN));
            for place in [|a: f64, b: f64| [a, b], |a: f64, b: f64| [b, a]] {
                let values = ends.map(|end| reach.excess(place(end, across)));
                let [Some(a), Some(b)] = values else { continue };
                if a * b > 0.0 {
                    continue;
                }
                let start = place(ends[0] + (ends[1] - ends[0]) * a / (a - b), across);
                let near = |[x, y]: &[f64; 2]| (x - start[0]).hypot(y - start[1]) < 3.0 * STEP;
                if curves.iter().any(|(shares, _)| shares.iter().any(near)) {
                    continue;
                }
                curves.extend(traced(&reach, start));
            }
        }
    }
    curves.into_iter().map(|(_, curve)| curve).collect()
}

fn traced(reach: &Reach, start: [f64; 2]) -> Option<(Vec<[f64; 2]>, Curve)> {
    let guess = DVector::from_row_slice(&start);
    let first = PathPoint::near(reach, guess.clone(), 0).or_else(|| PathPoint::near(reach, guess, 1))?;
    let (mut shares, first_end) = follow(reach, first.reversed());
    shares.reverse();
    shares.push([first.y[0], first.y[1]]);
    let (after, second_end) = match first_end {
        End::Closes => (Vec::new(), End::Closes),
        _ => follow(reach, first),
    };
    shares.extend(after);
    shares.retain(|share| share.iter().all(|s| (0.0..=1.0).contains(s)));
    let points = shares
        .iter()
        .map(|&share| {
            let parameters = reach.parameters(share);
            let [x, y] = reach.spans.map(|span| parameters.get(span.parameter));
            let bounding =
                System::new(parameters).is_ok_and(|system| Flight::<f64, 2>::new(&system).quiet.decays);
            CurvePoint { x, y, criticality: None, bounding, special: None }
        })
        .collect();
    let motion = CurveMotion { n: 1, p: 0, q: 0, symmetric: true };
    (shares.len() > 1).then_some({
        (shares, Curve { kind: Kind::Grazing, motion, touches: None, points, ends: [first_end, second_end] })
    })
}

fn follow(reach: &Reach, start: PathPoint) -> (Vec<[f64; 2]>, End) {
    let mut found = Vec::new();
    let mut here = start.clone();
    let mut ds = STEP;
    while found.len() < MOST_POINTS {
        let Some(next) = here.advanced(reach, ds).filter(|next| here.straightness(next) > 0.95) else {
            ds *= 0.5;
            if ds < 1e-7 {
                // A parameter's physical range can end at the border.
                let at_border = here.y.iter().any(|share| !(1e-5..=1.0 - 1e-5).contains(share));
                return (found, if at_border { End::LeavesPlane } else { End::Stalled });
            }
            continue;
        };
        let share = [next.y[0], next.y[1]];
        if share.iter().any(|s| !(0.0..=1.0).contains(s)) {
            // The last point lies on the border, to a fraction of a step.
            if ds < 1e-6 {
                return (found, End::LeavesPlane);
            }
            ds *= 0.5;
            continue;
        }
        if found.len() > 10 && start.lies_between(&here, &next) {
            found.push([start.y[0], start.y[1]]);
            return (found, End::Closes);
        }
        found.push(share);
        here = next;
        ds = (ds * 1.3).min(STEP);
    }
    (found, End::TooLong)
}
