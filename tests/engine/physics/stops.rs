//! Nothing goes through a stop, and nothing rests on one that does not press.

use impact_atlas::dynamics::{Event, Point, Stop, Trajectory};
use impact_atlas::model::{Flight, Parameters, Real, State};
use rayon::prelude::*;

use crate::physics::{at, flight, values};

/// What a trajectory did at the stops; everything non-dimensional.
#[derive(Clone, Copy, Debug, Default)]
pub struct Touches {
    /// How far beyond a stop x1 was, at the worst.
    pub penetration: f64,
    /// The same in units of what rounding makes of x1 in one flight.
    pub roundings: f64,
    /// How strongly a stop would have had to pull on the resting mass, at the worst.
    pub pull: f64,
    /// The largest contact force at a release.
    pub release: f64,
    /// Sequences of infinitely many rebounds.
    pub chatters: u32,
    /// Releases.
    pub releases: u32,
}

/// Samples within each move.
const SAMPLES: u32 = 16;

/// Far more moves than any of these trajectories needs.
const MOST_MOVES: u32 = 2_000_000;

impl Touches {
    fn see<T: Real>(&mut self, flight: &Flight<T, 2>, parameters: &Parameters, point: &Point<T, 2>) {
        let delta = flight.normals[0].gap[0];
        let beyond = (point.state.x[0].abs() - delta).widen();
        let [_, x2, v1, v2] = values(&point.state).map(f64::abs);
        let h = flight.h.widen();
        let force = 1.0 + x2 + 2.0 * parameters.zeta * (v1 + v2);
        let size = delta.widen() + h * (v1 + h * force);
        self.penetration = self.penetration.max(beyond);
        self.roundings = self.roundings.max(beyond / (T::epsilon().widen() * size));
    }
}

pub fn touches<T: Real>(parameters: Parameters, start: [f64; 4], periods: u32) -> Touches {
    touches_of(&flight::<T>(parameters), parameters, start, periods)
}

/// What a trajectory does whose flight may be another than its parameters'.
pub fn touches_of<T: Real>(
    flight: &Flight<T, 2>,
    parameters: Parameters,
    start: [f64; 4],
    periods: u32,
) -> Touches {
    let mut trajectory = Trajectory::<T, 2>::new(flight, State::from_slice(&start.map(T::of)));
    let mut touches = Touches::default();
    let mut done = 0;
    let mut moves = 0;
    while done < periods {
        moves += 1;
        assert!(
            moves < MOST_MOVES,
            "no progress after {done} periods from {start:?} with {parameters:?}: {trajectory:?}"
        );
        let before = trajectory;
        let taken = trajectory.advance(flight, &mut []);
        for sample in 0..=SAMPLES {
            let time = taken.time * T::of(f64::from(sample) / f64::from(SAMPLES));
            let point = before.point.flown(flight, time, taken.contact);
            touches.see(flight, &parameters, &point);
            if let Some(end) = taken.contact.end_along(0) {
                let stop = Stop(flight.normals[0].stop[end.side]);
                let [x1, x2, _, v2] = values(&point.state);
                let force = (1.0 - parameters.f20) * point.sin.widen() + 2.0 * parameters.zeta * v2 + x2 - x1;
                touches.pull = touches.pull.max(-stop.side::<f64>() * force);
                assert_eq!(point.state.x[0], stop.side::<T>() * flight.normals[0].gap[0]);
            }
        }
        touches.see(flight, &parameters, &trajectory.point);
        match taken.event {
            Event::Strobe => done += 1,
            Event::Caught { complete_chatter, .. } => touches.chatters += u32::from(complete_chatter),
            Event::Released(stop) => {
                touches.releases += 1;
                let [x1, x2, _, v2] = values(&before.point.state);
                let sin = before.point.sin.widen();
                let force = (1.0 - parameters.f20) * sin + 2.0 * parameters.zeta * v2 + x2 - x1;
                touches.release = touches.release.max((stop.side::<f64>() * force).abs());
            }
            _ => {}
        }
    }
    touches
}

fn between(first: f64, last: f64, count: u32) -> impl Iterator<Item = f64> + Clone {
    (0..count).map(move |i| first + (last - first) * f64::from(i) / f64::from(count - 1))
}

/// The cells in which general solvers of events go through the wall, by more than the clearance.
fn slow_cells() -> Vec<Parameters> {
    let restitution =
        |(omega, delta)| between(0.5, 0.8, 4).map(move |r| Parameters { r, ..at(omega, delta) });
    let clearance = |omega| between(0.1, 0.3, 5).map(move |delta| (omega, delta));
    between(0.2, 0.5, 9).flat_map(clearance).flat_map(restitution).collect()
}

fn worst<T: Real>() -> Touches {
    slow_cells().into_par_iter().map(|cell| touches::<T>(cell, [0.0; 4], 30)).reduce(
        Touches::default,
        |a, b| Touches {
            penetration: a.penetration.max(b.penetration),
            roundings: a.roundings.max(b.roundings),
            pull: a.pull.max(b.pull),
            release: a.release.max(b.release),
            chatters: a.chatters + b.chatters,
            releases: a.releases + b.releases,
        },
    )
}

#[test]
fn slow_motion_does_not_go_through_a_stop() {
    let worst = worst::<f64>();
    assert!(worst.penetration <= 1e-12, "{worst:?}");
    assert!(worst.pull <= 1e-8 && worst.release <= 1e-8, "{worst:?}");
    assert!(worst.chatters > 1000 && worst.releases >= worst.chatters / 2, "{worst:?}");
}

#[test]
fn slow_motion_does_not_go_through_a_stop_in_single_precision() {
    let worst = worst::<f32>();
    assert!(worst.penetration <= 1e-5, "{worst:?}");
    assert!(worst.pull <= 1e-3 && worst.release <= 1e-3, "{worst:?}");
    assert!(worst.chatters > 1000 && worst.releases >= worst.chatters / 2, "{worst:?}");
}

/// The ends of every parameter's range, combined.
fn corners() -> impl ParallelIterator<Item = Parameters> {
    let corners: Vec<Parameters> = [0.3, 2.83]
        .into_iter()
        .flat_map(|omega| [1e-3, 0.1].map(|delta| at(omega, delta)))
        .flat_map(|p| [0.0, 0.9, 1.0].map(|r| Parameters { r, ..p }))
        .flat_map(|p| [0.0, 0.1, 3.0].map(|zeta| Parameters { zeta, ..p }))
        .flat_map(|p| [0.0, 1.0].map(|f20| Parameters { f20, ..p }))
        .flat_map(|p| [0.1, 0.9].map(|mu_c| Parameters { mu_c, ..p }))
        .collect();
    corners.into_par_iter()
}

/// Between elastic stops rebounds that press on are shrunk by the damper alone.
fn is_dragged(parameters: &Parameters) -> bool {
    parameters.r == 1.0 && parameters.zeta > 1.0
}

/// Follows a corner from starts with and without speed, in either precision.
fn stays_between_the_stops(parameters: Parameters) {
    for start in [[0.0; 4], [parameters.delta, 0.2, 0.5, -0.3], [-parameters.delta, 0.0, 0.0, 0.0]] {
        let double = touches::<f64>(parameters, start, 5).penetration;
        let single = touches::<f32>(parameters, start, 5).penetration;
        assert!(double <= 1e-12 && single <= 1e-5, "{double:e}, {single:e} with {parameters:?}");
    }
}

#[test]
fn no_corner_of_the_parameters_lets_a_stop_be_passed() {
    corners().filter(|p| !is_dragged(p)).for_each(stays_between_the_stops);
}

#[test]
#[ignore = "rebounds between elastic stops with strong damping number millions in a period"]
fn elastic_stops_with_strong_damping_take_few_moves() {
    corners().filter(is_dragged).for_each(stays_between_the_stops);
}

/// Nothing is found by a check that cannot fail: a start beyond the stop is one.
#[test]
fn a_penetration_is_seen() {
    assert!(touches::<f64>(at(2.0, 0.1), [0.1 + 1e-9, 0.0, -1.0, 0.0], 1).penetration > 1e-12);
}
