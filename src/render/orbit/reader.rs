//! Quantities of an orbit of any system: from its states, its impacts and the places of its stops.

use crate::analysis::Reading;
use crate::dynamics::{ImpactEvent, Stop};
use crate::model::{Line, StateVector, System};

/// The contact normals of a system's stops, along which quantities are read.
#[derive(Clone, Debug)]
pub(super) struct Reader {
    lines: Vec<Line>,
}

impl Reader {
    /// Of a system.
    pub fn new(system: &System) -> Self {
        Reader { lines: (0..system.plant().stops.len()).map(|stop| system.line(stop)).collect() }
    }

    /// Every stop, the last one first.
    pub fn stops(&self) -> impl Iterator<Item = Stop> + use<> {
        (0..self.lines.len() as u8).rev().map(Stop)
    }

    /// A quantity of a state; NaN for one of impacts.
    pub fn of_state(&self, state: &StateVector, reading: Reading) -> f64 {
        let n = state.coordinates();
        match reading {
            Reading::X(i) => state[usize::from(i)],
            Reading::V(i) => state[n + usize::from(i)],
            Reading::Gap(stop) => {
                let line = &self.lines[stop.index()];
                line.sign * (line.place - dot(line, &state[..n]))
            }
            Reading::Speed(stop) => {
                let line = &self.lines[stop.index()];
                line.sign * dot(line, &state[n..])
            }
            Reading::VBefore | Reading::VAfter | Reading::Tau => f64::NAN,
        }
    }

    /// A quantity at an impact, just after it.
    pub fn of_impact(&self, impact: &ImpactEvent, reading: Reading) -> f64 {
        match reading {
            Reading::VBefore => impact.velocity_before,
            Reading::VAfter => impact.velocity_after,
            Reading::Tau => impact.phase,
            _ => self.of_state(&self.side(impact, impact.velocity_after), reading),
        }
    }

    /// The state at an impact with a velocity along its contact normal: that before it, or that after it.
    pub fn side(&self, impact: &ImpactEvent, velocity: f64) -> StateVector {
        let line = &self.lines[impact.stop.index()];
        let mut state = impact.state;
        let n = state.coordinates();
        let change = velocity - dot(line, &state[n..]);
        for (v, response) in state[n..].iter_mut().zip(&line.response) {
            *v += change * response;
        }
        state
    }

    /// The value of a quantity at which a stop is met, whatever the rest of the state.
    pub fn level(&self, stop: Stop, reading: Reading) -> Option<f64> {
        let line = &self.lines[stop.index()];
        match reading {
            Reading::X(i) => {
                let own = line.direction[usize::from(i)];
                let alone = own != 0.0 && line.direction.iter().filter(|d| **d != 0.0).count() == 1;
                alone.then(|| line.place / own)
            }
            Reading::Gap(of) => {
                let other = &self.lines[of.index()];
                (other.direction == line.direction).then_some(other.sign * (other.place - line.place))
            }
            _ => None,
        }
    }

    /// Where a stop is met in the plane of two displacements that alone meet it: y as a function of x.
    pub fn slanted(&self, stop: Stop, [x, y]: [Reading; 2]) -> Option<impl Fn(f64) -> f64 + use<>> {
        let (Reading::X(i), Reading::X(j)) = (x, y) else { return None };
        let line = &self.lines[stop.index()];
        let [a, b] = [i, j].map(|k| line.direction[usize::from(k)]);
        let both = a != 0.0 && b != 0.0 && line.direction.iter().filter(|d| **d != 0.0).count() == 2;
        let place = line.place;
        both.then_some(move |x: f64| (place - a * x) / b)
    }

    /// Whether an impact at a stop shows in a quantity.
    pub fn shows(&self, stop: Stop, reading: Reading) -> bool {
        match reading {
            Reading::X(i) => self.lines[stop.index()].direction[usize::from(i)] != 0.0,
            Reading::Gap(_) => self.level(stop, reading).is_some(),
            _ => false,
        }
    }
}

fn dot(line: &Line, values: &[f64]) -> f64 {
    line.direction.iter().zip(values).map(|(d, value)| d * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::record;
    use crate::model::Setting;
    use crate::system::{BUILTIN, Family};

    /// At every impact of every family, the stop that is met is at no distance, and the velocities are those of the law.
    #[test]
    fn impacts_are_read_where_they_are() {
        let mut impacts = 0;
        for builtin in BUILTIN {
            let system = System::new(Setting::defaults(Family::builtin(builtin.name))).unwrap();
            let reader = Reader::new(&system);
            let start = system.between_stops(StateVector::zeros(system.plant().n));
            for impact in record(&system, start, 50, 10, 0).impacts {
                let read = |reading| reader.of_impact(&impact, reading);
                assert!(read(Reading::Gap(impact.stop)).abs() < 1e-12, "{}", builtin.name);
                let restitution = system.plant().stops[impact.stop.index()].restitution;
                let [before, after] = [impact.velocity_before, impact.velocity_after]
                    .map(|v| reader.of_state(&reader.side(&impact, v), Reading::Speed(impact.stop)));
                assert!(before > 0.0 && (after + restitution * before).abs() < 1e-12, "{}", builtin.name);
                assert_eq!(read(Reading::Speed(impact.stop)), after);
                impacts += 1;
            }
        }
        assert!(impacts > 50, "{impacts}");
    }
}
