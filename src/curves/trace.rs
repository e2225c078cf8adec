//! A bifurcation curve followed through the plane, with the special points on it.

use super::branch::Event;
use super::condition::Kind;
use super::curve::{Curve, CurveMotion, End};
use super::events::{Reason, Seen, look};
use super::locus::Locus;
use super::parting::passed;
use super::path::PathPoint;
use super::unknowns::{Span, Unknowns};
use super::until::Until;
use crate::model::System;

/// The longest step, in sides of the plane.
const LONGEST: f64 = 0.01;
/// The first step.
const FIRST: f64 = 1e-3;
/// The shortest step.
const SHORTEST: f64 = 1e-7;
/// The fewest points of a curve.
const LEAST_POINTS: usize = 3;
/// The most points in one direction.
const MOST_POINTS: usize = 3000;
/// A step over which the path turns by more than this cosine is halved.
const STRAIGHT: f64 = 0.97;
/// Bisections to place an end or a special point.
const BISECTIONS: usize = 50;
/// The share of its values on either side to which a function has fallen at a zero.
const ZERO: f64 = 1e-3;
/// Places are found to this length.
const PLACED: f64 = 1e-8;
/// Nearer to the border than this, in sides of the plane, a path that cannot be followed has left.
const AT_BORDER: f64 = 1e-5;
/// Points nearer to each other than this, in sides of the plane, are dropped where a path stalls.
const CROWDED: f64 = 1e-6;

/// A curve, and the bifurcations that begin at its special points.
#[derive(Clone, Debug)]
pub(super) struct Traced {
    pub curve: Curve,
    pub offspring: Vec<Event>,
}

/// The curve through a bifurcation; none if it cannot be begun.
pub(super) fn trace(event: &Event, spans: [Span; 2], until: Until<'_>) -> Option<Traced> {
    let extra = usize::from(event.kind == Kind::Grazing);
    let locus = Locus {
        unknowns: Unknowns::new(
            event.pattern.clone(),
            &event.sections,
            event.parameters,
            extra,
            spans.to_vec(),
        ),
        kind: event.kind,
        touch: event.touch.map(|touch| (touch.arc, touch.stop)),
    };
    let phase: Vec<f64> = event.touch.iter().map(|touch| touch.phase).collect();
    let guess = locus.unknowns.pack(&event.sections, &phase, &event.parameters);
    let last = guess.len() - 1;
    let start =
        PathPoint::near(&locus, guess.clone(), last).or_else(|| PathPoint::near(&locus, guess, last - 1))?;
    let seen = look(&locus, &start.y, &start.tangent)?;
    let seen = match seen.beyond {
        None => seen,
        Some((End::Resonance11 | End::Resonance12, special)) => seen.named(special),
        Some(_) => return None,
    };
    let ((mut places, first_end), (after, second_end)) = rayon::join(
        || follow(&locus, start.reversed(), seen.clone(), until),
        || follow(&locus, start.clone(), seen.clone(), until),
    );
    let seen = [(&places, first_end), (&after, second_end)]
        .into_iter()
        .filter(|(points, _)| points.is_empty())
        .fold(seen, |seen, (_, (end, special))| seen.ending(end, special));
    places.reverse();
    places.push(seen);
    let (first_end, second_end) = (first_end.0, second_end.0);
    let closed = first_end == End::Closes;
    if !closed {
        places.extend(after);
    }
    if places.len() < LEAST_POINTS {
        return None;
    }
    let offspring = places.iter().filter_map(|place| place.offspring(event.kind)).collect();
    let curve = Curve {
        kind: event.kind,
        motion: CurveMotion::of(&event.pattern),
        touches: event.touch.map(|touch| touch.stop),
        points: places.into_iter().map(|place| place.point).collect(),
        ends: [first_end, if closed { first_end } else { second_end }],
    };
    Some(Traced { curve, offspring })
}

/// The points of a path beyond its start, and why it ends.
fn follow(locus: &Locus, start: PathPoint, first: Seen, until: Until<'_>) -> (Vec<Seen>, Reason) {
    let mut points = Vec::new();
    let (mut here, mut seen) = (start.clone(), first.clone());
    let mut ds = FIRST;
    while points.len() < MOST_POINTS && !until.is_over() {
        let ahead = here.advanced(locus, ds).filter(|next| here.straightness(next) > STRAIGHT);
        let Some((next, looked)) =
            ahead.and_then(|next| look(locus, &next.y, &next.tangent).map(|looked| (next, looked)))
        else {
            ds *= 0.5;
            if ds < SHORTEST {
                return stalled(locus, &here, points);
            }
            continue;
        };
        let beyond = |there: &Seen| {
            let system = System::new(there.parameters);
            let passed = system.is_ok_and(|system| passed(&system, &seen.motion, &there.motion));
            there.beyond.or(passed.then_some((End::Simplifies, None)))
        };
        if let Some(reason) = beyond(&looked) {
            let (last, (end, special)) = end_point(locus, &here, ds, reason, beyond);
            if let Some((ds, last)) = last {
                points.extend(specials(locus, &here, &seen, ds, &last));
                points.push(last);
            }
            if let Some(last) = points.pop() {
                points.push(last.ending(end, special));
            }
            return (points, (end, special));
        }
        points.extend(specials(locus, &here, &seen, ds, &looked));
        if points.len() > 10 && start.lies_between(&here, &next) {
            points.push(first);
            return (points, (End::Closes, None));
        }
        points.push(looked.clone());
        (here, seen) = (next, looked);
        ds = (ds * 1.3).min(LONGEST);
    }
    (points, (End::TooLong, None))
}

/// What is left of a path that cannot be followed further: it may have reached the border, where the parameters'
/// physical range can end, and it may have crept.
fn stalled(locus: &Locus, here: &PathPoint, mut points: Vec<Seen>) -> (Vec<Seen>, Reason) {
    let shares = here.y.rows(locus.unknowns.parameters_at(), 2);
    if shares.iter().any(|share| !(AT_BORDER..=1.0 - AT_BORDER).contains(share)) {
        return (points, (End::LeavesPlane, None));
    }
    let place = |seen: &Seen| locus.unknowns.shares(&seen.parameters);
    while let [.., before, last] = &points[..]
        && (place(last) - place(before)).norm() < CROWDED
    {
        points.pop();
    }
    (points, (End::Stalled, None))
}

/// What is known of the point a length `ds` ahead: so near that the path has not turned round.
fn look_ahead(locus: &Locus, here: &PathPoint, ds: f64) -> Option<Seen> {
    look(locus, &here.ahead(locus, ds)?, &here.tangent)
}

/// The last point of a curve on the way to a point that is beyond its end, with its distance, and why it ends.
fn end_point(
    locus: &Locus,
    here: &PathPoint,
    ds: f64,
    reason: Reason,
    beyond: impl Fn(&Seen) -> Option<Reason>,
) -> (Option<(f64, Seen)>, Reason) {
    let (mut inside, mut outside) = (0.0, ds);
    let (mut last, mut reason) = (None, reason);
    for _ in 0..BISECTIONS {
        if outside - inside < PLACED {
            break;
        }
        let middle = 0.5 * (inside + outside);
        let Some(seen) = look_ahead(locus, here, middle) else { break };
        match beyond(&seen) {
            None => {
                inside = middle;
                last = Some((middle, seen));
            }
            Some(beyond) => {
                outside = middle;
                reason = beyond;
            }
        }
    }
    (last, reason)
}

/// The special points between two points of a path.
fn specials(locus: &Locus, here: &PathPoint, seen: &Seen, ds: f64, next: &Seen) -> Vec<Seen> {
    let mut found: Vec<(f64, Seen)> = Vec::new();
    for (before, after) in seen.monitors.iter().zip(&next.monitors) {
        let (Some(a), Some(b)) = (before.value, after.value) else { continue };
        if a * b >= 0.0 {
            continue;
        }
        let value_at = |s: f64| -> Option<(Seen, f64)> {
            let seen = look_ahead(locus, here, s)?;
            let value = seen.monitors.iter().find(|monitor| monitor.special == before.special)?.value?;
            Some((seen, value))
        };
        let (mut low, mut high) = (0.0, ds);
        let mut place = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let Some((point, value)) = value_at(middle) else { break };
            // A sign that changes through infinity, or because a null vector changes its sign, is no zero.
            place = (value.abs() < ZERO * a.abs().max(b.abs())).then_some((middle, point));
            if value * a > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
            if high - low < PLACED {
                break;
            }
        }
        found.extend(place.map(|(s, point)| (s, point.named(Some(before.special)))));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    found.into_iter().map(|(_, point)| point).collect()
}
