//! Where the motion without impact grazes: the forced response just reaches a stop.

use nalgebra::DVector;
use rayon::prelude::*;

use super::condition::Kind;
use super::curve::{Curve, CurveMotion, CurvePoint, End, Special};
use super::path::{Equations, PathPoint};
use super::response::{Response, decays};
use super::unknowns::Span;
use super::until::Until;
use crate::dynamics::Stop;
use crate::model::{Setting, System};
use crate::plane::RegionMap;
use crate::theory::StopSet;

/// The longest step, in sides of the plane.
const STEP: f64 = 5e-3;
/// The most points in one direction.
const MOST_POINTS: usize = 2000;
/// Places along each side at which the curve is looked for.
const SCAN: usize = 64;
/// The share of the room to another stop by which the motion may go beyond that before it counts.
const CROSSED: f64 = 1e-9;
/// Bisections to place the end of a curve.
const BISECTIONS: usize = 40;

/// The forced response just reaches a stop.
struct Reach {
    fixed: Setting,
    spans: [Span; 2],
    stop: Stop,
    /// The other stops.
    others: Vec<Stop>,
}

impl Reach {
    fn parameters(&self, shares: [f64; 2]) -> Setting {
        self.spans
            .iter()
            .zip(shares)
            .fold(self.fixed, |parameters, (span, share)| parameters.with(span.parameter, span.value(share)))
    }

    fn response(&self, shares: [f64; 2]) -> Option<Response> {
        Response::of(&System::new(self.parameters(shares)).ok()?)
    }

    fn excess(&self, shares: [f64; 2]) -> Option<f64> {
        self.response(shares)?.excess(self.stop)
    }

    /// Whether it crosses no other stop.
    fn is_motion(&self, shares: [f64; 2]) -> bool {
        let crossed = |response: Response| self.others.iter().any(|&stop| response.crosses(stop, CROSSED));
        self.response(shares).is_some_and(|response| !crossed(response))
    }
}

impl Equations for Reach {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        self.excess([y[0], y[1]]).map(|value| DVector::from_element(1, value))
    }
}

/// The curves on which the motion without impact begins to touch a stop, of stops that are mirror images the first.
pub(super) fn no_impact_curves(
    map: &RegionMap,
    spans: [Span; 2],
    stops: &StopSet,
    until: Until<'_>,
) -> Vec<Curve> {
    let all = || (0..stops.count()).map(|stop| Stop(stop as u8));
    let of_stop = |stop: Stop| {
        let others = all().filter(|&other| other != stop).collect();
        found(&Reach { fixed: map.plane.parameters, spans, stop, others }, stops, until)
    };
    all().filter(|&stop| stops.image(stop) >= stop).flat_map(of_stop).collect()
}

/// The excess at places that stand evenly on the plane, column by column.
fn scanned(reach: &Reach, until: Until<'_>) -> Vec<Vec<Option<f64>>> {
    let share = |i: usize| i as f64 / SCAN as f64;
    let of_place = |x: usize, y: usize| reach.excess([share(x), share(y)]);
    let column = |x: usize| match until.is_over() {
        true => vec![None; SCAN + 1],
        false => (0..=SCAN).map(|y| of_place(x, y)).collect(),
    };
    (0..=SCAN).into_par_iter().map(column).collect()
}

fn found(reach: &Reach, stops: &StopSet, until: Until<'_>) -> Vec<Curve> {
    let excess = scanned(reach, until);
    let mut paths: Vec<Path> = Vec::new();
    for line in 0..=SCAN {
        for along in 0..SCAN {
            for turned in [false, true] {
                let turn = |[a, b]: [f64; 2]| if turned { [b, a] } else { [a, b] };
                let value = |end: usize| if turned { excess[line][end] } else { excess[end][line] };
                let [Some(a), Some(b)] = [along, along + 1].map(value) else { continue };
                if a * b > 0.0 || until.is_over() {
                    continue;
                }
                let [begin, end, across] = [along, along + 1, line].map(|i| i as f64 / SCAN as f64);
                let start = turn([begin + (end - begin) * a / (a - b), across]);
                let near = |[x, y]: &[f64; 2]| (x - start[0]).hypot(y - start[1]) < 3.0 * STEP;
                if paths.iter().any(|path| path.shares.iter().any(near)) {
                    continue;
                }
                paths.extend(traced(reach, start));
            }
        }
    }
    let motions = paths.into_iter().flat_map(|path| path.of_motions(reach));
    motions.map(|path| path.curve(reach, stops)).collect()
}

/// Where the forced response reaches a stop, point by point, in shares of the plane's sides.
#[derive(Clone)]
struct Path {
    shares: Vec<[f64; 2]>,
    ends: [End; 2],
}

impl Path {
    /// The parts on which it crosses no other stop.
    fn of_motions(mut self, reach: &Reach) -> Vec<Path> {
        let mut is_motion: Vec<bool> = self.shares.iter().map(|&share| reach.is_motion(share)).collect();
        let Some(first) = is_motion.iter().position(|is| !is) else { return vec![self] };
        if self.ends[0] == End::Closes {
            // The curve is closed: its last point is its first.
            self.shares.pop();
            is_motion.pop();
            self.shares.rotate_left(first);
            is_motion.rotate_left(first);
        }
        let last = self.shares.len() - 1;
        let mut parts = Vec::new();
        let mut from = 0;
        for run in is_motion.chunk_by(|a, b| a == b) {
            let until = from + run.len();
            if run[0] {
                let mut shares = self.shares[from..until].to_vec();
                let mut ends = self.ends;
                if from > 0 {
                    shares.insert(0, edge(reach, self.shares[from], self.shares[from - 1]));
                    ends[0] = End::Grazes;
                }
                if until <= last {
                    shares.push(edge(reach, self.shares[until - 1], self.shares[until]));
                    ends[1] = End::Grazes;
                } else if self.ends[1] == End::Closes {
                    shares.push(edge(reach, self.shares[last], self.shares[0]));
                    ends[1] = End::Grazes;
                }
                parts.push(Path { shares, ends });
            }
            from = until;
        }
        parts
    }

    fn curve(self, reach: &Reach, stops: &StopSet) -> Curve {
        let point = |&share: &[f64; 2]| {
            let parameters = reach.parameters(share);
            let [x, y] = reach.spans.map(|span| parameters.get(span.parameter));
            let bounding = System::new(parameters).is_ok_and(|system| decays(&system));
            CurvePoint { x, y, criticality: None, bounding, special: None }
        };
        let mut points: Vec<CurvePoint> = self.shares.iter().map(point).collect();
        let last = points.len() - 1;
        for (place, end) in [0, last].into_iter().zip(self.ends) {
            points[place].special = (end == End::Grazes).then_some(Special::Grazing);
        }
        let motion = CurveMotion::without_impact(stops);
        Curve { kind: Kind::Grazing, motion, touches: Some(reach.stop), points, ends: self.ends }
    }
}

/// The last place of a motion between a place where there is one and the next, where there is none.
fn edge(reach: &Reach, inside: [f64; 2], outside: [f64; 2]) -> [f64; 2] {
    let along = [0, 1].map(|i| outside[i] - inside[i]);
    let held = usize::from(along[1].abs() > along[0].abs());
    let at = |part: f64| {
        let guess = DVector::from_fn(2, |i, _| inside[i] + part * along[i]);
        PathPoint::near(reach, guess, held).map(|point| [point.y[0], point.y[1]])
    };
    let (mut low, mut high, mut last) = (0.0, 1.0, inside);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        match at(middle).filter(|&share| reach.is_motion(share)) {
            Some(share) => (low, last) = (middle, share),
            None => high = middle,
        }
    }
    last
}

fn traced(reach: &Reach, start: [f64; 2]) -> Option<Path> {
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
    (shares.len() > 1).then_some(Path { shares, ends: [first_end, second_end] })
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
