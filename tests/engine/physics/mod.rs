//! What physics says of the motion, held against the library's trajectories.

mod invariants;
mod limits;
mod narrow;
mod paper;
mod stops;

use impact_atlas::dynamics::{Event, Stop, Trajectory};
use impact_atlas::model::{Flight, Parameters, Real, State, System};

/// The paper's parameters at a frequency and a half clearance.
fn at(omega: f64, delta: f64) -> Parameters {
    Parameters { omega, delta, ..Parameters::default() }
}

fn flight<T: Real>(parameters: Parameters) -> Flight<T, 2> {
    Flight::<f64, 2>::new(&System::new(parameters).unwrap()).round()
}

/// (x1, x2, v1, v2) of a state.
fn values<T: Real>(state: &State<T, 2>) -> [f64; 4] {
    std::array::from_fn(|i| state.get(i).widen())
}

/// An impact: time since the start, where, and v1 on either side.
#[derive(Clone, Copy, Debug)]
struct Hit {
    time: f64,
    stop: Stop,
    before: f64,
    after: f64,
}

/// The first `count` impacts of a trajectory, fewer if it makes no more within `periods` forcing periods.
fn hits(mut trajectory: Trajectory<f64, 2>, flight: &Flight<f64, 2>, count: usize, periods: f64) -> Vec<Hit> {
    let end = periods * f64::from(flight.steps) * flight.h;
    let mut time = 0.0;
    let mut hits = Vec::new();
    while hits.len() < count && time < end {
        let taken = trajectory.advance(flight, &mut []);
        time += taken.time;
        if let Event::Impact(impact) | Event::Caught { impact, .. } = taken.event {
            let (before, after) = (impact.velocity_before, impact.velocity_after);
            hits.push(Hit { time, stop: impact.stop, before, after });
        }
    }
    hits
}
