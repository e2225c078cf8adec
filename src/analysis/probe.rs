//! A quantity read on a section, of a trajectory.

use std::f64::consts::TAU;

use super::section::{Reading, Section, SectionError};
use crate::dynamics::{Event, Stop, Trajectory};
use crate::model::vector::{axpy, dot};
use crate::model::{FAR, Flight, Real, State};
use crate::system::Family;

/// A quantity on a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Probe {
    /// The section on which it is read.
    pub section: Section,
    /// The quantity that is read.
    pub reading: Reading,
}

impl Probe {
    /// A checked probe.
    ///
    /// # Errors
    /// [`SectionError::NotThere`] for a reading of impacts on the strobe section.
    pub fn new(section: Section, reading: Reading) -> Result<Self, SectionError> {
        let there = reading.is_on(section);
        there.then_some(Probe { section, reading }).ok_or_else(|| SectionError::NotThere(reading.to_string()))
    }

    /// Whether a family has the stops and the components that it names.
    pub fn fits(&self, family: &Family) -> bool {
        let has = |stop: Stop| stop.index() < family.stops().len();
        let section = match self.section {
            Section::Impact(stop) => has(stop),
            Section::Strobe => true,
        };
        section
            && match self.reading {
                Reading::X(i) | Reading::V(i) => usize::from(i) < family.n(),
                Reading::Gap(stop) | Reading::Speed(stop) => has(stop),
                Reading::VBefore | Reading::VAfter | Reading::Tau => true,
            }
    }

    /// What is read at the end of a move that ended with `event`, if that is on the section.
    ///
    /// The last impact before sticking stands for the rebounds that follow it in finite time; coming to rest on a
    /// stop without an impact is none.
    #[inline(always)]
    pub fn read<T: Real, const N: usize>(
        &self,
        flight: &Flight<T, N>,
        trajectory: &Trajectory<T, N>,
        event: &Event<T>,
    ) -> Option<T> {
        match (self.section, event) {
            (Section::Strobe, Event::Strobe) => Some(self.of_state(flight, &trajectory.point.state)),
            (Section::Impact(stop), Event::Impact(impact) | Event::Caught { impact, .. })
                if stop == impact.stop && impact.velocity_before != T::zero() =>
            {
                Some(match self.reading {
                    Reading::VBefore => impact.velocity_before,
                    Reading::VAfter => impact.velocity_after,
                    Reading::Tau => phase(flight, trajectory),
                    _ => {
                        let state = trajectory.present(flight).state;
                        self.of_state(flight, &leaving(flight, &state, stop, impact.velocity_after))
                    }
                })
            }
            _ => None,
        }
    }

    /// A quantity of the state; 0 for one of impacts.
    #[inline(always)]
    fn of_state<T: Real, const N: usize>(&self, flight: &Flight<T, N>, state: &State<T, N>) -> T {
        match self.reading {
            Reading::X(i) => state.x[usize::from(i)],
            Reading::V(i) => state.v[usize::from(i)],
            Reading::Gap(stop) => {
                along(flight, stop, |direction, sign, gap| gap - sign * dot(direction, &state.x))
            }
            Reading::Speed(stop) => along(flight, stop, |direction, sign, _| sign * dot(direction, &state.v)),
            Reading::VBefore | Reading::VAfter | Reading::Tau => T::zero(),
        }
    }
}

/// The state just after an impact that leaves the stop with `rebound` along its normal, where masses that come to rest
/// there still move so.
#[inline(always)]
fn leaving<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    state: &State<T, N>,
    stop: Stop,
    rebound: T,
) -> State<T, N> {
    let mut leaving = *state;
    for (k, normal) in flight.normals().iter().enumerate() {
        if is_on(flight, k, 0, stop) || is_on(flight, k, 1, stop) {
            let change = rebound - dot(&normal.direction, &state.v);
            leaving.v = axpy(change, &normal.response, &state.v);
        }
    }
    leaving
}

/// Whether a stop is at an end of a contact normal.
#[inline(always)]
fn is_on<T: Real, const N: usize>(flight: &Flight<T, N>, normal: usize, side: usize, stop: Stop) -> bool {
    let normal = &flight.normals[normal];
    normal.gap[side] < T::of(FAR) && normal.stop[side] == stop.0
}

/// What a function makes of the direction, the sign and the gap of a stop.
#[inline(always)]
fn along<T: Real, const N: usize>(flight: &Flight<T, N>, stop: Stop, of: impl Fn(&[T; N], T, T) -> T) -> T {
    let mut value = T::zero();
    for (k, normal) in flight.normals().iter().enumerate() {
        if is_on(flight, k, 0, stop) {
            value = of(&normal.direction, T::one(), normal.gap[0]);
        }
        if is_on(flight, k, 1, stop) {
            value = of(&normal.direction, -T::one(), normal.gap[1]);
        }
    }
    value
}

/// The forcing phase, from the step and the offset in it.
#[inline(always)]
fn phase<T: Real, const N: usize>(flight: &Flight<T, N>, trajectory: &Trajectory<T, N>) -> T {
    let steps = T::of(f64::from(trajectory.step)) + trajectory.offset * flight.inverse_h;
    steps * (T::of(TAU) / T::of(f64::from(flight.steps)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Parameters, System};

    /// The printed X* at ω = 3.7: what is read at an impact is the impact's.
    #[test]
    fn readings_are_those_of_the_instant() {
        let flight = Flight::<f64, 2>::new(&System::new(Parameters::default()).unwrap());
        let mut trajectory = Trajectory::new(&flight, State::zero());
        let readings = Reading::all(Family::paper());
        let mut last = vec![f64::NAN; readings.len()];
        let mut strobes = 0;
        while strobes < 2000 {
            let event = trajectory.advance(&flight, &mut []).event;
            strobes += u32::from(event == Event::Strobe);
            for (last, &reading) in last.iter_mut().zip(&readings) {
                let probe = Probe { section: Section::A, reading };
                *last = probe.read(&flight, &trajectory, &event).unwrap_or(*last);
            }
        }
        let speeds = [0.345457 / 0.8, -0.345457];
        let printed = [0.1, -0.006341, -0.345457, 0.021160, 1.802134, 0.0, 0.2, -0.345457, 0.345457];
        for (read, printed) in last.iter().zip(speeds.iter().chain(&printed)) {
            assert!((read - printed).abs() < 1e-6, "{last:?}");
        }
        assert_eq!(last.len(), 11);
    }

    /// Along a stop between two masses, what is read is relative.
    #[test]
    fn stops_between_masses_are_read_along_their_direction() {
        let system = System::new(crate::model::Setting::defaults(Family::builtin("impact-damper"))).unwrap();
        let flight = Flight::<f64, 2>::new(&system);
        let trajectory = Trajectory::new(&flight, State { x: [0.5, 1.0], v: [0.2, -0.3] });
        let read = |reading| {
            Probe { section: Section::Strobe, reading }.read(&flight, &trajectory, &Event::Strobe).unwrap()
        };
        let found = [
            Reading::Gap(Stop::A),
            Reading::Gap(Stop::B),
            Reading::Speed(Stop::A),
            Reading::Speed(Stop::B),
            Reading::X2,
        ];
        let expected = [2.5, 3.5, -0.5, 0.5, 1.0];
        assert!(found.map(read).iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15));
    }
}
