//! All bifurcation curves of a region map.

use std::collections::HashSet;

use rayon::prelude::*;

use super::branch::{Event, Followed, followed};
use super::condition::Kind;
use super::curve::{Curve, CurveMotion};
use super::left_out::{LeftOut, Why, left_out};
use super::no_impact::no_impact_curves;
use super::regions::{Shown, shown};
use super::seeds::{Seed, fewest, seeds};
use super::spans::{CurvesError, spans};
use super::symmetry::stops_of;
use super::trace::{Traced, trace};
use super::unknowns::Span;
use super::until::Until;
use crate::plane::RegionMap;
use crate::theory::StopSet;

/// A motion that is followed is followed again, across, from one place in each of so many parts of either axis.
const PARTS: f64 = 5.0;
/// An event this near to a curve of its kind and motion lies on it; in sides of the plane.
const SAME: f64 = 2e-3;

/// The bifurcation curves of a plane, and the motions that have none.
#[derive(Clone, Debug, PartialEq)]
pub struct PlaneCurves {
    /// The curves.
    pub curves: Vec<Curve>,
    /// Every periodic motion that the map shows and that no curve bounds, those with most cells first.
    pub left_out: Vec<LeftOut>,
}

/// The bifurcation curves of the motions that a map shows, for periods up to `max_period`.
///
/// Motions are taken from the map's regions, refined by Newton's method, and followed along both axes, where they are
/// unstable too; from each point where they lose or gain their stability or graze, the curve is followed through the plane.
/// A curve that is met from several regions is computed once. Motions that the map does not show are followed where others
/// were born from them. The order of the curves depends on the map alone.
///
/// # Errors
/// [`CurvesError`] where an axis is not a range of a parameter.
pub fn bifurcation_curves(map: &RegionMap, max_period: u32) -> Result<PlaneCurves, CurvesError> {
    bifurcation_curves_until(map, max_period, &|| false)
}

/// The same, given up soon after `cancelled` says so; it is asked often, and from several threads.
///
/// # Errors
/// Those of [`bifurcation_curves`], and [`CurvesError::Cancelled`].
pub fn bifurcation_curves_until(
    map: &RegionMap,
    max_period: u32,
    cancelled: &(dyn Fn() -> bool + Sync),
) -> Result<PlaneCurves, CurvesError> {
    let until = Until(cancelled);
    let spans = spans(&map.plane)?;
    let stops = stops_of(&map.plane, spans);
    let shown = shown(map, &stops);
    let sought: Vec<Result<Followed, Why>> =
        shown.par_iter().map(|shown| sought(map, shown, &stops, max_period, spans, until)).collect();
    let mut curves = Vec::new();
    let met = |of: fn(&Followed) -> &Vec<Event>| sought.iter().flatten().flat_map(of).cloned().collect();
    trace_all(&mut curves, met(|followed| &followed.events), spans, until);
    let mut births: Vec<Event> = met(|followed| &followed.births);
    let mut known = HashSet::new();
    while !births.is_empty() && !until.is_over() {
        births.retain(|event| !lies_on(event, &curves, spans));
        let seeds: Vec<Seed> =
            births.iter().filter(|event| known.insert(event.pattern.clone())).map(Event::seed).collect();
        let followed = Followed::all(follow(&seeds, spans, until));
        births.extend(followed.events);
        trace_all(&mut curves, births, spans, until);
        births = followed.births;
    }
    let without_impact = no_impact_curves(map, spans, &stops, until);
    // A curve that was not followed to its end is left out.
    if until.is_over() {
        return Err(CurvesError::Cancelled);
    }
    curves.retain(|curve| curve.points.iter().any(|point| point.bounding));
    curves = without_twins(curves, spans);
    let left_out = left_out(&shown, &sought, |event| lies_on(event, &curves, spans));
    curves.extend(without_impact);
    Ok(PlaneCurves { curves, left_out })
}

/// Follows curves from events, and those that begin at special points of them in their turn.
fn trace_all(curves: &mut Vec<Curve>, mut open: Vec<Event>, spans: [Span; 2], until: Until<'_>) {
    while !open.is_empty() && !until.is_over() {
        let groups = grouped(std::mem::take(&mut open));
        let traced: Vec<Traced> =
            groups.into_par_iter().flat_map_iter(|group| traced(&group, curves, spans, until)).collect();
        for Traced { curve, offspring } in traced {
            open.extend(offspring);
            curves.push(curve);
        }
    }
}

/// Whether an event lies on a curve of its kind and motion, or of its motion's mirror image.
fn lies_on<'a>(event: &Event, curves: impl IntoIterator<Item = &'a Curve>, spans: [Span; 2]) -> bool {
    let of = subject(event.kind, CurveMotion::of(&event.pattern));
    let alike = |curve: &&Curve| subject(curve.kind, curve.motion.clone()) == of;
    curves.into_iter().filter(alike).any(|curve| meets(curve, event, spans))
}

/// What those have in common that may be one curve: the kind, and of a motion and its mirror image the leading one.
type Subject = (Kind, CurveMotion);

fn subject(kind: Kind, motion: CurveMotion) -> Subject {
    (kind, motion.leading())
}

/// Follows motions along both axes.
fn follow(seeds: &[Seed], spans: [Span; 2], until: Until<'_>) -> Vec<Followed> {
    seeds.par_iter().flat_map(|seed| spans.par_iter().map(|&span| followed(seed, span, until))).collect()
}

/// Where a motion gains or loses stability or grazes, and what it was born in.
///
/// It is followed from the map's cells along both axes, and from where that leads to along both axes again.
fn sought(
    map: &RegionMap,
    shown: &Shown,
    stops: &StopSet,
    max_period: u32,
    spans: [Span; 2],
    until: Until<'_>,
) -> Result<Followed, Why> {
    if let Some(why) = Why::not_sought(shown, max_period, fewest(map)) {
        return Err(why);
    }
    let first = if until.is_over() { Vec::new() } else { seeds(map, shown, stops) };
    if first.is_empty() {
        return Err(Why::Unsolved);
    }
    let mut known = HashSet::new();
    let mut is_new = |seed: &Seed| {
        let part = |span: Span| (PARTS * span.share(seed.parameters.get(span.parameter))).floor() as i32;
        known.insert((seed.motion.pattern.clone(), spans.map(part)))
    };
    for seed in &first {
        is_new(seed);
    }
    let met = follow(&first, spans, until);
    let further: Vec<Seed> =
        met.iter().flat_map(|met| &met.places).filter(|seed| is_new(seed)).cloned().collect();
    let again = follow(&further, spans, until);
    Ok(Followed::all(met.into_iter().chain(again)))
}

/// Events that may lie on the same curves together, in the order of their first: of one kind, and of motions with the same label,
/// whichever way round and whichever impact comes first.
fn grouped(events: Vec<Event>) -> Vec<Vec<Event>> {
    let mut groups: Vec<(Subject, Vec<Event>)> = Vec::new();
    for event in events {
        let of = subject(event.kind, CurveMotion::of(&event.pattern));
        match groups.iter_mut().find(|(first, _)| *first == of) {
            Some((_, group)) => group.push(event),
            None => groups.push((of, vec![event])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// The curves of one kind and motion that are not known yet, each once.
fn traced(events: &[Event], known: &[Curve], spans: [Span; 2], until: Until<'_>) -> Vec<Traced> {
    let mut found: Vec<Traced> = Vec::new();
    for event in events {
        if !lies_on(event, known.iter().chain(found.iter().map(|traced| &traced.curve)), spans) {
            found.extend(trace(event, spans, until));
        }
    }
    found
}

/// Whether a curve leads through the place of an event.
fn meets(curve: &Curve, event: &Event, spans: [Span; 2]) -> bool {
    distance(curve, spans.map(|span| span.share(event.parameters.get(span.parameter))), spans) < SAME
}

/// Each curve once: one that was begun too far from where an event was met may have been followed again from there.
fn without_twins(curves: Vec<Curve>, spans: [Span; 2]) -> Vec<Curve> {
    let mut kept: Vec<(Subject, Curve)> = Vec::new();
    for curve in curves {
        let place = |i: usize| [spans[0].share(curve.points[i].x), spans[1].share(curve.points[i].y)];
        let samples = (0..=8).map(|k| place(k * (curve.points.len() - 1) / 8));
        let of = subject(curve.kind, curve.motion.clone());
        let twin = kept.iter().any(|(other_of, other)| {
            let near = |place: [f64; 2]| distance(other, place, spans) < SAME;
            *other_of == of && samples.clone().all(near)
        });
        if !twin {
            kept.push((of, curve));
        }
    }
    kept.into_iter().map(|(_, curve)| curve).collect()
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
