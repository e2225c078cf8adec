//! Masses that come to rest where a stop is: rebounds and swings that die away, of which nothing tells one from the next but its size.

use std::f64::consts::PI;

use impact_atlas::dynamics::record;
use impact_atlas::model::{Real, System};
use impact_atlas::system::Plant;
use nalgebra::DMatrix;

use crate::common::general::Follower;
use crate::common::general::conditioning::deviation;
use crate::general::subject::{Period, follow, masses, stop};

const DAMPING: f64 = 0.05;
const RESTITUTION: f64 = 0.7;

/// Moves in a forcing period of which none of these motions needs more: there are some eight steps in each.
const FEW: u32 = 100;

/// One mass, pressed to 0.3 by its load alone, and a stop so far beyond that.
fn alone(beyond: f64) -> Plant {
    let mut plant = masses(&[1.0], 1.0);
    plant.damping[(0, 0)] = DAMPING;
    plant.stiffness[(0, 0)] = 1.0;
    plant.load[0] = 0.3;
    plant.stops = vec![stop(&[1.0], 0.3 + beyond, RESTITUTION)];
    plant
}

/// Two masses, of which the second is forced but rests on its stop: then nothing moves the first, which is at equilibrium at its own.
fn beside_a_forced_one(beyond: f64) -> Plant {
    let mut plant = masses(&[1.0, 1.0], 1.7);
    plant.damping = DMatrix::from_diagonal_element(2, 2, 0.1);
    plant.stiffness = DMatrix::from_row_slice(2, 2, &[2.0, -1.0, -1.0, 2.0]);
    plant.force_sin[1] = 1.0;
    (plant.load[0], plant.load[1]) = (0.3, 5.0);
    plant.stops = vec![stop(&[1.0, 0.0], 0.3 + beyond, RESTITUTION), stop(&[0.0, 1.0], 0.3, RESTITUTION)];
    plant
}

/// From impact to impact half a period of the damped swing passes, and its speed falls by the same share: in closed form.
#[test]
fn rebounds_die_away_as_in_closed_form() {
    let damped = (1.0 - 0.25 * DAMPING * DAMPING).sqrt();
    let decay = RESTITUTION * (-0.5 * DAMPING * PI / damped).exp();
    let recording = record(&System::of_plant(alone(0.0)).unwrap(), [-0.2, 0.0], 0, 60, 0);
    let impacts = &recording.impacts;
    assert!(impacts.len() > 50, "{} impacts", impacts.len());
    let mut compared = 0;
    for pair in impacts.windows(2) {
        let [speed, next] = [0, 1].map(|k| pair[k].velocity_before);
        // What moves is a difference of numbers of 0.3.
        if next < 1e-12 {
            break;
        }
        let rounding = 64.0 * f64::EPSILON / next;
        assert!((next / (decay * speed) - 1.0).abs() < rounding, "{pair:?}");
        assert!(
            (pair[1].time - pair[0].time - PI / damped).abs() < rounding + 1e-12 * pair[1].time,
            "{pair:?}"
        );
        compared += 1;
    }
    assert!(compared > 50, "{compared}");
}

/// The first mass moves as in the oracle, and is at rest in the end where its stop is, or near.
fn settles(plant: &Plant, start: &[f64], beyond: f64, periods: usize) -> Vec<Period> {
    let mut oracle = Follower::new(plant.clone(), start);
    let followed = follow::<f64>(plant, start, periods);
    assert_eq!(followed.len(), periods, "it does not get on: {beyond}");
    for period in &followed[..6] {
        let off = deviation(&period.strobe, &oracle.next_period().strobe);
        assert!(off < 1e-9, "off by {off:e}: {beyond}");
    }
    let last = &followed[periods - 1].strobe;
    let (place, speed) = (last[0] - 0.3 - beyond.min(0.0), last[plant.n]);
    // A swing that does not reach the stop dies away more slowly.
    let left = f64::max(1e-14, 2.0 * beyond);
    assert!(place.abs() < left && speed.abs() < left, "{beyond}: {last:?}");
    followed
}

#[test]
fn a_mass_settles_where_its_stop_is_or_near() {
    for beyond in [0.0, 1e-9, -1e-9, 1e-12, -1e-12, 1e-15, -1e-15, 1e-6, -1e-6] {
        settles(&alone(beyond), &[-0.2, 0.0], beyond, 300);
    }
}

#[test]
fn so_it_does_beside_one_that_is_forced_and_held() {
    for beyond in [0.0, 1e-9, -1e-9, 1e-12, -1e-12, 1e-6, -1e-6] {
        let periods = settles(&beside_a_forced_one(beyond), &[0.0; 4], beyond, 200);
        assert!(periods[199].held.contains(&1), "the forced one rests");
    }
}

/// However little is left of a motion, a forcing period takes few moves: in either precision.
fn takes_few_moves<T: Real>(plant: &Plant, start: &[f64]) {
    let periods = follow::<T>(plant, start, 300);
    assert_eq!(periods.len(), 300, "it does not get on: {plant:?}");
    let most = periods.iter().map(|period| period.moves).max().unwrap();
    assert!(most < FEW, "{most} moves in a period: {plant:?}");
}

#[test]
fn what_dies_away_takes_no_more_moves_than_what_does_not() {
    for beyond in [0.0, 1e-6, -1e-6, 3e-8, -3e-8, 1e-9, -1e-9, 1e-12, -1e-12] {
        takes_few_moves::<f64>(&alone(beyond), &[-0.2, 0.0]);
        takes_few_moves::<f32>(&alone(beyond), &[-0.2, 0.0]);
        takes_few_moves::<f64>(&beside_a_forced_one(beyond), &[0.0; 4]);
        takes_few_moves::<f32>(&beside_a_forced_one(beyond), &[0.0; 4]);
    }
}
