//! All bifurcation curves of a region map.

use std::collections::HashMap;

use rayon::prelude::*;
use thiserror::Error;

use super::branch::{Event, events};
use super::condition::Kind;
use super::curve::Curve;
use super::no_impact::no_impact_curve;
use super::seeds::seeds;
use super::trace::trace;
use super::unknowns::Span;
use crate::plane::{Axis, Quantity, RegionMap};
use crate::theory::Pattern;

/// An event this near to a curve of its kind and motion lies on it; in sides of the plane.
const SAME: f64 = 2e-3;

/// Curves are for planes of two parameters only.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum CurvesError {
    /// An axis varies the start.
    #[error(
        "bifurcation curves depend on parameters, not on the start: let both axes be parameters instead of {0}"
    )]
    NotAParameter(&'static str),
    /// An axis has no extent.
    #[error("bifurcation curves need a range of {0}, not a single value")]
    SingleValue(&'static str),
}

/// The bifurcation curves of the motions that a map shows, for periods up to `max_period`.
///
/// Motions are taken from the map's regions, refined by Newton's method, and followed along both axes until they lose
/// their stability or graze; from each such point the curve is followed through the plane. A curve that is met from
/// several regions is computed once. The order of the curves depends on the map alone.
///
/// # Errors
/// [`CurvesError`] where an axis is not a range of a parameter.
pub fn bifurcation_curves(map: &RegionMap, max_period: u32) -> Result<Vec<Curve>, CurvesError> {
    let spans = [span(&map.plane.x)?, span(&map.plane.y)?];
    let seeds = seeds(map, max_period);
    let events: Vec<Event> = seeds
        .par_iter()
        .flat_map(|seed| spans.par_iter().flat_map(|&span| events(&seed.motion, &seed.parameters, span)))
        .collect();
    let mut groups: Vec<Vec<Event>> = Vec::new();
    let mut index: HashMap<(Kind, Pattern), usize> = HashMap::new();
    for event in events {
        let group = *index.entry((event.kind, event.pattern.clone())).or_insert_with(|| {
            groups.push(Vec::new());
            groups.len() - 1
        });
        groups[group].push(event);
    }
    let mut curves: Vec<Curve> =
        groups.into_par_iter().flat_map_iter(|group| traced(&group, spans)).collect();
    curves = without_twins(curves, spans);
    curves.extend(no_impact_curve(map, spans));
    Ok(curves)
}

fn span(axis: &Axis) -> Result<Span, CurvesError> {
    let name = axis.quantity.name();
    match axis.quantity {
        Quantity::Parameter(_) if axis.first == axis.last => Err(CurvesError::SingleValue(name)),
        Quantity::Parameter(parameter) => Ok(Span { parameter, first: axis.first, last: axis.last }),
        Quantity::Start(_) | Quantity::Control(_) => Err(CurvesError::NotAParameter(name)),
    }
}

/// The curves of one kind and motion, each once.
fn traced(events: &[Event], spans: [Span; 2]) -> Vec<Curve> {
    let mut curves: Vec<Curve> = Vec::new();
    for event in events {
        let place = spans.map(|span| span.share(event.parameters.get(span.parameter)));
        if curves.iter().any(|curve| distance(curve, place, spans) < SAME) {
            continue;
        }
        curves.extend(trace(event, spans));
    }
    curves
}

/// Mirrored motions have the same curves; one of each is kept.
fn without_twins(curves: Vec<Curve>, spans: [Span; 2]) -> Vec<Curve> {
    let mut kept: Vec<Curve> = Vec::new();
    for curve in curves {
        let twin = kept.iter().any(|other| {
            let mirrored = (curve.motion.n, curve.motion.q, curve.motion.p);
            let alike = other.kind == curve.kind
                && other.motion.symmetric == curve.motion.symmetric
                && ((other.motion.n, other.motion.p, other.motion.q) == mirrored
                    || other.motion == curve.motion);
            let samples = (0..=8).map(|k| &curve.points[k * (curve.points.len() - 1) / 8]);
            alike
                && samples
                    .map(|point| [spans[0].share(point.x), spans[1].share(point.y)])
                    .all(|place| distance(other, place, spans) < SAME)
        });
        if !twin {
            kept.push(curve);
        }
    }
    kept
}

/// How far a place is from a curve, in sides of the plane.
fn distance(curve: &Curve, place: [f64; 2], spans: [Span; 2]) -> f64 {
    let at = |i: usize| [spans[0].share(curve.points[i].x), spans[1].share(curve.points[i].y)];
    (1..curve.points.len())
        .map(|i| {
            let ([ax, ay], [bx, by]) = (at(i - 1), at(i));
            let (dx, dy) = (bx - ax, by - ay);
            let square = dx * dx + dy * dy;
            let share = if square > 0.0 {
                (((place[0] - ax) * dx + (place[1] - ay) * dy) / square).clamp(0.0, 1.0)
            } else {
                0.0
            };
            (ax + share * dx - place[0]).hypot(ay + share * dy - place[1])
        })
        .fold(f64::INFINITY, f64::min)
}
