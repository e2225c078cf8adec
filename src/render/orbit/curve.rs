//! An orbit as a curve: its samples and impacts in order, and short hops between impacts filled in.

use super::reader::Reader;
use crate::dynamics::Recording;
use crate::model::StateVector;

/// Into how many parts the flight to or from an impact is cut.
const PARTS: u32 = 6;
/// How many straight pieces reach across a window at least, and into how many a piece is cut at most.
const PIECES: f64 = 300.0;
const MOST_PARTS: u32 = 100_000;

/// A place on the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// (x, v).
    pub state: StateVector,
    /// Whether it is a side of an impact.
    impact: bool,
}

impl Place {
    /// The motion a share `u` of the way to a later place, by the cubic through both with their velocities.
    fn towards(&self, later: &Place, u: f64) -> Place {
        let duration = later.time - self.time;
        let n = self.state.coordinates();
        let mut state = self.state;
        for i in 0..n {
            let ends = [&self.state, &later.state].map(|state| [state[i], state[n + i]]);
            [state[i], state[n + i]] = cubic(ends[0], ends[1], duration, u);
        }
        Place { time: self.time + u * duration, state, impact: false }
    }
}

/// An orbit as a curve, and when masses rest meanwhile.
pub(super) struct Curve {
    places: Vec<Place>,
    /// The times of rest on any stop, in order, apart from each other.
    rests: Vec<[f64; 2]>,
}

/// Value and slope of the cubic Hermite polynomial.
fn cubic([x0, v0]: [f64; 2], [x1, v1]: [f64; 2], duration: f64, u: f64) -> [f64; 2] {
    let (m0, m1) = (v0 * duration, v1 * duration);
    let c2 = 3.0 * (x1 - x0) - 2.0 * m0 - m1;
    let c3 = 2.0 * (x0 - x1) + m0 + m1;
    [x0 + u * (m0 + u * (c2 + u * c3)), (m0 + u * (2.0 * c2 + 3.0 * u * c3)) / duration]
}

impl Curve {
    /// The curve of a recorded orbit, both sides of every impact on it.
    pub fn of(recording: &Recording, reader: &Reader) -> Self {
        let impacts = recording.impacts.iter().flat_map(|impact| {
            [impact.velocity_before, impact.velocity_after].map(|velocity| Place {
                time: impact.time,
                state: reader.side(impact, velocity),
                impact: true,
            })
        });
        let sample = |sample: &crate::dynamics::Sample| Place {
            time: sample.time,
            state: sample.state,
            impact: false,
        };
        let mut nodes: Vec<Place> = recording.samples.iter().map(sample).collect();
        nodes.extend(impacts);
        nodes.sort_by(|a, b| a.time.total_cmp(&b.time)); // stable: the sides of an impact stay in order
        let mut curve = Curve { places: Vec::with_capacity(nodes.len()), rests: rests(recording) };
        for node in nodes {
            if let Some(last) = curve.places.last().copied() {
                let flight =
                    node.time > last.time && (last.impact || node.impact) && !curve.is_at_rest(&last, &node);
                if flight {
                    let parts = (1..PARTS).map(|i| last.towards(&node, f64::from(i) / f64::from(PARTS)));
                    curve.places.extend(parts);
                }
            }
            curve.places.push(node);
        }
        curve
    }

    /// Its places, in order.
    pub fn places(&self) -> &[Place] {
        &self.places
    }

    /// The places and more of them wherever the curve is seen through a window: `at` says where a place is, from 0 to 1
    /// along either side of the window.
    ///
    /// No straight piece is then longer than a small part of the window, however far that is zoomed in.
    pub fn refined(&self, at: impl Fn(&Place) -> [f64; 2]) -> Vec<Place> {
        let mut fine = Vec::with_capacity(self.places.len());
        for (here, next) in self.places.iter().zip(self.places.iter().skip(1)) {
            fine.push(*here);
            let parts = parts(at(here), at(next));
            if parts > 1 && next.time > here.time && !self.is_at_rest(here, next) {
                fine.extend((1..parts).map(|i| here.towards(next, f64::from(i) / f64::from(parts))));
            }
        }
        fine.extend(self.places.last());
        fine
    }

    /// Whether masses rest on a stop for a part of the way between two places.
    fn is_at_rest(&self, from: &Place, until: &Place) -> bool {
        let first = self.rests.partition_point(|[_, end]| *end <= from.time);
        self.rests.get(first).is_some_and(|[begin, _]| *begin < until.time)
    }
}

/// The times of rest on any stop, joined where they overlap.
fn rests(recording: &Recording) -> Vec<[f64; 2]> {
    let mut joined: Vec<[f64; 2]> = Vec::new();
    for stick in &recording.sticks {
        match joined.last_mut().filter(|last| stick.from <= last[1]) {
            Some(last) => last[1] = last[1].max(stick.until),
            None => joined.push([stick.from, stick.until]),
        }
    }
    joined
}

/// Into how many parts a piece between two points of the window is cut: none where it stays out of sight.
fn parts(a: [f64; 2], b: [f64; 2]) -> u32 {
    let length = (a[0] - b[0]).abs().max((a[1] - b[1]).abs());
    // A curve bulges out of the box around its ends by less than the size of that box.
    let beside = |i: usize| a[i].max(b[i]) < -length || a[i].min(b[i]) > 1.0 + length;
    if !length.is_finite() || beside(0) || beside(1) {
        return 1;
    }
    ((length * PIECES).ceil() as u32).clamp(1, MOST_PARTS)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::record;
    use crate::model::{Parameters, System};

    #[test]
    fn hops_that_no_sample_shows_are_filled_in() {
        let system = System::new(Parameters { omega: 0.35, delta: 0.545, ..Parameters::default() }).unwrap();
        let coarse = record(&system, [0.0; 4], 200, 1, 20);
        let coarse = Curve::of(&coarse, &Reader::new(&system)).places;
        let fine = record(&system, [0.0; 4], 200, 1, 20_000);
        let mut worst = 0.0_f64;
        for place in coarse.windows(2).filter(|pair| pair[0].impact && !pair[1].impact).map(|pair| pair[1]) {
            let near =
                fine.samples.partition_point(|sample| sample.time < place.time).min(fine.samples.len() - 1);
            worst = worst.max((fine.samples[near].state[0] - place.state[0]).abs());
        }
        assert!(worst > 0.0 && worst < 2e-3, "{worst}");
        let inside = coarse.iter().all(|place| place.state[0].abs() <= 0.545 + 1e-9);
        assert!(inside);
    }

    #[test]
    fn a_window_is_crossed_in_small_pieces_along_the_true_curve() {
        let system = System::new(Parameters { omega: 2.0, delta: 0.3, ..Parameters::default() }).unwrap();
        let coarse = record(&system, [0.0; 4], 100, 1, 400);
        let fine = record(&system, [0.0; 4], 100, 1, 200_000);
        let curve = Curve::of(&coarse, &Reader::new(&system));
        let places = curve.places().to_vec();
        let middle = &fine.samples[77_777];
        // Half of a hundredth of the curve's size to either side.
        let at = |place: &Place| {
            [(place.state[0] - middle.state[0]) / 3e-3 + 0.5, (place.state[2] - middle.state[2]) / 3e-3 + 0.5]
        };
        let seen = |places: &[Place]| -> Vec<[f64; 2]> {
            let inside = |[x, y]: &[f64; 2]| (-0.1..=1.1).contains(x) && (-0.1..=1.1).contains(y);
            places.iter().map(at).filter(inside).collect()
        };
        let found = curve.refined(at);
        let shown = seen(&found);
        assert!(seen(&places).len() < 8 && shown.len() > 200, "{} {}", seen(&places).len(), shown.len());
        assert!(found.len() < places.len() + 3000, "nothing is filled in out of sight: {}", found.len());
        let truth: Vec<Place> =
            Curve::of(&Recording { impacts: Vec::new(), ..fine.clone() }, &Reader::new(&system)).places;
        let truth = seen(&truth);
        for [x, y] in shown {
            let near = truth.iter().map(|[a, b]| (a - x).hypot(b - y)).fold(f64::INFINITY, f64::min);
            assert!(near < 1e-2, "{x} {y} is {near} of the window off");
        }
    }

    #[test]
    fn the_cubic_meets_its_ends() {
        for (u, expected) in [(0.0, [0.1, -2.0]), (1.0, [0.3, 0.5])] {
            let found = cubic([0.1, -2.0], [0.3, 0.5], 0.7, u);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
    }
}
