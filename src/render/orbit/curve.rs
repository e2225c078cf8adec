//! An orbit as a curve: its samples and impacts in order, and short hops between impacts filled in.

use crate::analysis::Reading;
use crate::dynamics::{Recording, Sample, Stop};

/// Into how many parts the flight to or from an impact is cut.
const PARTS: u32 = 6;

/// A place on the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Time since the start of the trajectory.
    pub time: f64,
    /// (x1, x2, v1, v2).
    pub state: [f64; 4],
    /// Whether it is a side of an impact.
    impact: bool,
}

impl Place {
    /// The place of a sample.
    pub fn of_sample(sample: &Sample) -> Self {
        Place { time: sample.time, state: [sample.x1, sample.x2, sample.v1, sample.v2], impact: false }
    }

    /// A component of the state.
    pub fn component(&self, reading: Reading) -> f64 {
        let [x1, x2, v1, v2] = self.state;
        match reading {
            Reading::X1 => x1,
            Reading::X2 => x2,
            Reading::V2 => v2,
            Reading::V1 | Reading::VBefore | Reading::VAfter | Reading::Tau => v1,
        }
    }

    /// The motion a share `u` of the way to a later place, by the cubic through both with their velocities.
    fn towards(&self, later: &Place, u: f64) -> Place {
        let duration = later.time - self.time;
        let [x1, v1] = cubic([self.state[0], self.state[2]], [later.state[0], later.state[2]], duration, u);
        let [x2, v2] = cubic([self.state[1], self.state[3]], [later.state[1], later.state[3]], duration, u);
        Place { time: self.time + u * duration, state: [x1, x2, v1, v2], impact: false }
    }
}

/// Value and slope of the cubic Hermite polynomial.
fn cubic([x0, v0]: [f64; 2], [x1, v1]: [f64; 2], duration: f64, u: f64) -> [f64; 2] {
    let (m0, m1) = (v0 * duration, v1 * duration);
    let c2 = 3.0 * (x1 - x0) - 2.0 * m0 - m1;
    let c3 = 2.0 * (x0 - x1) + m0 + m1;
    [x0 + u * (m0 + u * (c2 + u * c3)), (m0 + u * (2.0 * c2 + 3.0 * u * c3)) / duration]
}

/// The curve of a recorded orbit between stops at ±`delta`, both sides of every impact on it.
pub(super) fn curve(recording: &Recording, delta: f64) -> Vec<Place> {
    let impacts = recording.impacts.iter().flat_map(|i| {
        let x1 = if i.stop == Stop::A { delta } else { -delta };
        let side = |v1| Place { time: i.time, state: [x1, i.x2, v1, i.v2], impact: true };
        [side(i.velocity_before), side(i.velocity_after)]
    });
    let mut nodes: Vec<Place> = recording.samples.iter().map(Place::of_sample).collect();
    nodes.extend(impacts);
    nodes.sort_by(|a, b| a.time.total_cmp(&b.time)); // stable: the sides of an impact stay in order
    let mut places: Vec<Place> = Vec::with_capacity(nodes.len());
    for node in nodes {
        if let Some(last) = places.last().copied() {
            let flight =
                node.time > last.time && (last.impact || node.impact) && !rests(recording, &last, &node);
            if flight {
                places.extend((1..PARTS).map(|i| last.towards(&node, f64::from(i) / f64::from(PARTS))));
            }
        }
        places.push(node);
    }
    places
}

/// Whether the first mass rests on a stop for a part of the way between two places.
fn rests(recording: &Recording, from: &Place, until: &Place) -> bool {
    let first = recording.sticks.partition_point(|stick| stick.until <= from.time);
    recording.sticks.get(first).is_some_and(|stick| stick.from < until.time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::record;
    use crate::model::{Parameters, System};

    #[test]
    fn hops_that_no_sample_shows_are_filled_in() {
        let system = System::new(Parameters { omega: 0.35, delta: 0.545, ..Parameters::default() }).unwrap();
        let coarse = curve(&record(&system, [0.0; 4], 200, 1, 20), 0.545);
        let fine = record(&system, [0.0; 4], 200, 1, 20_000);
        let mut worst = 0.0_f64;
        for place in coarse.windows(2).filter(|pair| pair[0].impact && !pair[1].impact).map(|pair| pair[1]) {
            let near =
                fine.samples.partition_point(|sample| sample.time < place.time).min(fine.samples.len() - 1);
            worst = worst.max((fine.samples[near].x1 - place.state[0]).abs());
        }
        assert!(worst > 0.0 && worst < 2e-3, "{worst}");
        let inside = coarse.iter().all(|place| place.state[0].abs() <= 0.545 + 1e-9);
        assert!(inside);
    }

    #[test]
    fn the_cubic_meets_its_ends() {
        for (u, expected) in [(0.0, [0.1, -2.0]), (1.0, [0.3, 0.5])] {
            let found = cubic([0.1, -2.0], [0.3, 0.5], 0.7, u);
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?}");
        }
    }
}
