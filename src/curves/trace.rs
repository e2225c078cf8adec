//! A bifurcation curve followed through the plane, with the special points on it.

use nalgebra::{Complex, DVector};

use super::branch::{Event, multipliers_at};
use super::condition::{Kind, split};
use super::curve::{Criticality, Curve, CurveMotion, CurvePoint, End, Special};
use super::locus::Locus;
use super::parting::passed;
use super::path::PathPoint;
use super::special::{Monitor, monitors};
use super::touch::{arrival_speeds, touches};
use super::unknowns::{Span, Unknowns};
use crate::model::{Flight, Parameters};
use crate::theory::{PeriodicMotion, flip_coefficient, fly, neimark_sacker_coefficient};

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
/// The part of a motion's own size by which a stop may be crossed before it counts.
const CROSSED: f64 = 1e-9;

/// What is known of a point of a path.
#[derive(Clone, Debug)]
pub(super) struct Seen {
    pub point: CurvePoint,
    pub motion: PeriodicMotion,
    pub parameters: Parameters,
    pub monitors: Vec<Monitor>,
    /// Why the path cannot go beyond it, if it is already beyond the end.
    pub beyond: Option<(End, Option<Special>)>,
}

impl Seen {
    /// The same place with the name of a special point, if there is one.
    fn named(mut self, special: Option<Special>) -> Self {
        self.point.special = special.or(self.point.special);
        self
    }

    /// The other bifurcation of the same motion that begins at a special point, if there is one.
    ///
    /// At a strong resonance the two critical multipliers of a fold, or of a period doubling, are the limit of a
    /// Neimark–Sacker pair.
    fn offspring(&self, kind: Kind) -> Option<Event> {
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

/// A curve, and the bifurcations that begin at its special points.
#[derive(Clone, Debug)]
pub(super) struct Traced {
    pub curve: Curve,
    pub offspring: Vec<Event>,
}

/// The curve through a bifurcation; none if it cannot be begun.
pub(super) fn trace(event: &Event, spans: [Span; 2]) -> Option<Traced> {
    let locus = Locus {
        unknowns: Unknowns {
            pattern: event.pattern.clone(),
            fixed: event.parameters,
            extra: usize::from(event.kind == Kind::Grazing),
            spans: spans.to_vec(),
        },
        kind: event.kind,
        touch: event.touch.map(|touch| (touch.arc, touch.stop)),
    };
    let phase: Vec<f64> = event.touch.iter().map(|touch| touch.phase).collect();
    let guess = locus.unknowns.pack(&event.sections, &phase, &event.parameters);
    let last = guess.len() - 1;
    let start =
        PathPoint::near(&locus, guess.clone(), last).or_else(|| PathPoint::near(&locus, guess, last - 1))?;
    let seen = look(&locus, &start)?;
    let seen = match seen.beyond {
        None => seen,
        Some((End::Resonance11 | End::Resonance12, special)) => seen.named(special),
        Some(_) => return None,
    };
    let ((mut places, first_end), (after, second_end)) = rayon::join(
        || follow(&locus, start.reversed(), seen.clone()),
        || follow(&locus, start.clone(), seen.clone()),
    );
    places.reverse();
    places.push(seen.clone());
    if first_end != End::Closes {
        places.extend(after);
    }
    if places.len() < LEAST_POINTS {
        return None;
    }
    let offspring = places.iter().filter_map(|place| place.offspring(event.kind)).collect();
    let pattern = &event.pattern;
    let curve = Curve {
        kind: event.kind,
        motion: CurveMotion { n: pattern.n(), p: pattern.p(), q: pattern.q(), symmetric: pattern.mirrored },
        touches: event.touch.map(|touch| touch.stop),
        points: places.into_iter().map(|place| place.point).collect(),
        ends: [first_end, second_end],
    };
    Some(Traced { curve, offspring })
}

fn follow(locus: &Locus, start: PathPoint, first: Seen) -> (Vec<Seen>, End) {
    let mut points = Vec::new();
    let (mut here, mut seen) = (start.clone(), first);
    let mut ds = FIRST;
    while points.len() < MOST_POINTS {
        let ahead = here.advanced(locus, ds).filter(|next| here.straightness(next) > STRAIGHT);
        let Some((next, looked)) = ahead.and_then(|next| look(locus, &next).map(|looked| (next, looked)))
        else {
            ds *= 0.5;
            if ds < SHORTEST {
                return (points, End::Stalled);
            }
            continue;
        };
        let beyond = |there: &Seen| {
            let passed = passed(&seen.motion, &there.motion);
            there.beyond.or(passed.then_some((End::Simplifies, None)))
        };
        if let Some(reason) = beyond(&looked) {
            let (point, end) = end_point(locus, &here, ds, reason, beyond);
            points.extend(specials(locus, &here, &seen, ds, &looked).into_iter().filter(|_| point.is_none()));
            points.extend(point);
            return (points, end);
        }
        points.extend(specials(locus, &here, &seen, ds, &looked));
        points.push(looked.clone());
        if points.len() > 10 && came_round(locus, &start, &here, &next) {
            return (points, End::Closes);
        }
        (here, seen) = (next, looked);
        ds = (ds * 1.3).min(LONGEST);
    }
    (points, End::TooLong)
}

/// Whether the start lies between two points that follow each other.
fn came_round(locus: &Locus, start: &PathPoint, here: &PathPoint, next: &PathPoint) -> bool {
    let from = locus.unknowns.parameters_at();
    let parameters = |point: &PathPoint| point.y.rows(from, 2).into_owned();
    let step = (parameters(next) - parameters(here)).norm();
    let whole = (&next.y - &here.y).norm();
    (parameters(next) - parameters(start)).norm() <= step && (&next.y - &start.y).norm() <= 2.0 * whole
}

/// The last point of a curve, on the way to a point that is beyond its end, and why it ends.
fn end_point(
    locus: &Locus,
    here: &PathPoint,
    ds: f64,
    reason: (End, Option<Special>),
    beyond: impl Fn(&Seen) -> Option<(End, Option<Special>)>,
) -> (Option<Seen>, End) {
    let (mut inside, mut outside) = (0.0, ds);
    let (mut last, mut reason) = (None, reason);
    for _ in 0..BISECTIONS {
        if outside - inside < PLACED {
            break;
        }
        let middle = 0.5 * (inside + outside);
        let Some(seen) = here.advanced(locus, middle).and_then(|point| look(locus, &point)) else { break };
        match beyond(&seen) {
            None => {
                inside = middle;
                last = Some(seen);
            }
            Some(beyond) => {
                outside = middle;
                reason = beyond;
            }
        }
    }
    let (end, special) = reason;
    (last.map(|seen| seen.named(special)), end)
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
            let seen = look(locus, &here.advanced(locus, s)?)?;
            let value = seen.monitors.iter().find(|monitor| monitor.special == before.special)?.value?;
            Some((seen, value))
        };
        let (mut low, mut high) = (0.0, ds);
        let mut place = None;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            let Some((point, value)) = value_at(middle) else { break };
            // A sign that changes through infinity, or with the side that a vector is seen from, is no zero.
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

/// Everything about a point of a path; none where it cannot be told.
fn look(locus: &Locus, at: &PathPoint) -> Option<Seen> {
    let unknowns = &locus.unknowns;
    let system = unknowns.system(&at.y)?;
    let sections = unknowns.sections(&at.y);
    let motion = PeriodicMotion { pattern: unknowns.pattern.clone(), sections, residual: 0.0 };
    let multipliers = multipliers_at(unknowns, &at.y)?;
    let (critical, others) = split(locus.kind, &multipliers);
    let coefficient = match locus.kind {
        Kind::Fold | Kind::Grazing => None,
        Kind::PeriodDoubling | Kind::Pitchfork => flip_coefficient(&system, &motion),
        Kind::NeimarkSacker => {
            neimark_sacker_coefficient(&system, &motion, critical[0].arg().abs()).map(|re_d| -re_d)
        }
    };
    let parameters = system.parameters();
    let point = CurvePoint {
        x: parameters.get(unknowns.spans[0].parameter),
        y: parameters.get(unknowns.spans[1].parameter),
        criticality: coefficient
            .map(|c| if c > 0.0 { Criticality::Supercritical } else { Criticality::Subcritical }),
        bounding: others.iter().all(|value| value.norm() < 1.0),
        special: None,
    };
    let monitors = monitors(locus, at, &system, &motion, coefficient, &critical, &others);
    let beyond = beyond(locus, &at.y, &system, &motion, &critical);
    Some(Seen { point, parameters: *parameters, monitors, beyond, motion })
}

/// Why a curve ends before this point, if it does.
fn beyond(
    locus: &Locus,
    y: &DVector<f64>,
    system: &crate::model::System,
    motion: &PeriodicMotion,
    critical: &[Complex<f64>],
) -> Option<(End, Option<Special>)> {
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
    if arrival_speeds(system, pattern, &motion.sections).iter().any(|&speed| speed < 0.0) {
        return Some((End::ImpactVanishes, Some(Special::Grazing)));
    }
    let own = |arc: usize, phase: f64| {
        locus.touch.is_some_and(|(its_arc, _)| its_arc == arc && (phase - locus.touch_phase(y)).abs() < 1e-3)
    };
    let crossed = touches(system, pattern, &motion.sections)
        .iter()
        .any(|touch| touch.gap < -CROSSED && !own(touch.arc, touch.phase));
    let certified = locus.kind == Kind::Grazing || fly(&Flight::new(system), motion).is_ok();
    (crossed || !certified).then_some((End::Grazes, Some(Special::Grazing)))
}
