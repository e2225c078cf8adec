//! Narrow clearances, weak damping, light and heavy second masses, resonances: no flight goes through a stop.

use impact_atlas::model::{Bound, Flight, Parameters, Real};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::common::cases::{Setup, narrow};
use crate::physics::flight;
use crate::physics::stops::{Touches, touches_of};

/// Forcing periods of each trajectory.
const PERIODS: u32 = 6;

/// The most roundings of one flight by which x1 may lie beyond a stop.
const ROUNDINGS: f64 = 16.0;

fn setups() -> Vec<Setup> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0003);
    (0..1000).map(|_| narrow(&mut rng, 1e-5, 1.0)).collect()
}

/// What every setup does at the stops, with its constants changed by `altered`.
fn all<T: Real>(altered: fn(Flight<T, 2>) -> Flight<T, 2>) -> Vec<(Setup, Touches)> {
    let follow = |setup: Setup| {
        let flight = altered(flight::<T>(setup.parameters));
        (setup, touches_of(&flight, setup.parameters, setup.start, PERIODS))
    };
    setups().into_par_iter().map(follow).collect()
}

fn beyond(all: &[(Setup, Touches)]) -> Vec<&(Setup, Touches)> {
    all.iter().filter(|(_, touches)| touches.roundings > ROUNDINGS).collect()
}

fn stays_between_the_stops<T: Real>() {
    let all = all::<T>(|flight| flight);
    let sum = |count: fn(&Touches) -> u32| all.iter().map(|(_, touches)| count(touches)).sum::<u32>();
    let worst = all.iter().map(|(_, touches)| touches.roundings).fold(0.0, f64::max);
    println!("at most {worst} roundings beyond a stop, {} releases", sum(|touches| touches.releases));
    assert!(sum(|touches| touches.releases) > 1000 && sum(|touches| touches.chatters) > 1000);
    let beyond = beyond(&all);
    assert!(beyond.is_empty(), "{} go through a stop, the first {:?}", beyond.len(), beyond[0]);
}

#[test]
fn no_narrow_clearance_is_left() {
    stays_between_the_stops::<f64>();
}

#[test]
fn no_narrow_clearance_is_left_in_single_precision() {
    stays_between_the_stops::<f32>();
}

/// The negative control: without the bound on x1'''' no flight is certified, and many go through a stop. Where debug
/// assertions are on, the engine's own is first.
#[test]
#[cfg_attr(debug_assertions, should_panic(expected = "beyond a stop"))]
fn a_search_without_its_bound_is_seen() {
    let all = all::<f64>(|mut flight| {
        let normal = &mut flight.normals[0];
        normal.bound = Bound { x: [0.0; 2], v: [0.0; 2], forcing: 0.0 };
        flight
    });
    let beyond = beyond(&all);
    println!("{} of {} go through a stop", beyond.len(), all.len());
    assert!(beyond.len() > 10, "{}", beyond.len());
}

/// A system that is near its resonance at an ordinary clearance, and was thrown across it from rest on a stop.
#[test]
fn a_resonance_does_not_throw_the_mass_across_the_clearance() {
    let parameters =
        Parameters { omega: 1.414, delta: 0.1, zeta: 0.0005, r: 0.6, f20: 1.0, ..Parameters::default() };
    let double = touches_of(&flight::<f64>(parameters), parameters, [0.0; 4], 320);
    let single = touches_of(&flight::<f32>(parameters), parameters, [0.0; 4], 320);
    assert!(double.roundings <= ROUNDINGS && single.roundings <= ROUNDINGS, "{double:?} {single:?}");
    assert!(double.releases > 100, "{double:?}");
}
