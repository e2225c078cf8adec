//! Plants that the unit tests share, and an integration that shares no code with the program's.

use nalgebra::{DMatrix, DVector};

use crate::model::vector::{added, applied, axpy, scaled};
use crate::model::{Flight, State, System};
use crate::system::{Plant, PlantStop};

/// A unit mass on a unit spring, ω = 1, without damping or force, between stops at ±½ with r = 0.8; `edit` changes it.
pub fn single(edit: impl FnOnce(&mut Plant)) -> System {
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let stop =
        |side: f64| PlantStop { direction: DVector::from_element(1, side), gap: 0.5, restitution: 0.8 };
    let mut plant = Plant {
        n: 1,
        mass: one(1.0),
        damping: one(0.0),
        stiffness: one(1.0),
        force_sin: DVector::zeros(1),
        force_cos: DVector::zeros(1),
        load: DVector::zeros(1),
        omega: 1.0,
        stops: vec![stop(1.0), stop(-1.0)],
    };
    edit(&mut plant);
    System::of_plant(plant).expect("the single mass is a plant")
}

/// Two masses on springs and dampers of no special numbers, forced and loaded, with one stop between them.
pub fn pair(restitution: f64) -> System {
    pair_with(&[[1.0, -0.4]], restitution, 0.1)
}

/// The same with other stops, each in a direction of its own, and a load on the first mass.
pub fn pair_with(directions: &[[f64; 2]], restitution: f64, load: f64) -> System {
    let stop = |d: &[f64; 2]| PlantStop { direction: DVector::from_row_slice(d), gap: 0.2, restitution };
    let plant = Plant {
        n: 2,
        mass: DMatrix::from_row_slice(2, 2, &[1.0, 0.1, 0.1, 0.6]),
        damping: DMatrix::from_row_slice(2, 2, &[0.3, -0.1, -0.1, 0.2]),
        stiffness: DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 1.5]),
        force_sin: DVector::from_row_slice(&[1.0, 0.3]),
        force_cos: DVector::from_row_slice(&[0.0, 0.2]),
        load: DVector::from_row_slice(&[load, 0.0]),
        omega: 1.3,
        stops: directions.iter().map(stop).collect(),
    };
    System::of_plant(plant).expect("the two masses are a plant")
}

/// Steps of one integration.
const STEPS: u32 = 400;

/// Free flight for a time from a state at a forcing phase, by the classical method of Runge and Kutta.
pub fn integrated<const N: usize>(
    flight: &Flight<f64, N>,
    state: State<f64, N>,
    phase: f64,
    time: f64,
) -> State<f64, N> {
    let rate = |state: &State<f64, N>, s: f64| {
        let (sin, cos) = (phase + flight.omega * s).sin_cos();
        let forced = axpy(sin, &flight.sin, &axpy(cos, &flight.cos, &flight.load));
        let moved = added(&applied(&flight.stiffness, &state.x), &applied(&flight.damping, &state.v));
        State { x: state.v, v: added(&moved, &forced) }
    };
    let step = time / f64::from(STEPS);
    (0..STEPS).fold(state, |state, k| {
        let s = f64::from(k) * step;
        let first = rate(&state, s);
        let second = rate(&state.plus(0.5 * step, &first), s + 0.5 * step);
        let third = rate(&state.plus(0.5 * step, &second), s + 0.5 * step);
        let fourth = rate(&state.plus(step, &third), s + step);
        let sum = State {
            x: added(&added(&first.x, &scaled(2.0, &second.x)), &added(&scaled(2.0, &third.x), &fourth.x)),
            v: added(&added(&first.v, &scaled(2.0, &second.v)), &added(&scaled(2.0, &third.v), &fourth.v)),
        };
        state.plus(step / 6.0, &sum)
    })
}

/// The first s in (0, `window`] at which a function that begins at 0 or above falls below 0, by a fine search and bisection;
/// none where it does not.
pub fn first_below(function: impl Fn(f64) -> f64, window: f64) -> Option<f64> {
    const PIECES: u32 = 4000;
    let at = |k: u32| window * f64::from(k) / f64::from(PIECES);
    let k = (1..=PIECES).find(|&k| function(at(k)) < 0.0)?;
    let (mut low, mut high) = (at(k - 1), at(k));
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if function(middle) < 0.0 { high = middle } else { low = middle }
    }
    Some(high)
}
