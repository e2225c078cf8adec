use nalgebra::{DMatrix, DVector};

use super::*;
use crate::dynamics::contact::gap_to;
use crate::dynamics::example::{integrated, pair_with, single};
use crate::dynamics::placing::rested;
use crate::model::System;

/// Steps of a time at which a motion is looked at.
const LOOKS: u32 = 50;

/// Two masses and two stops, of which the first one holds or none does: what is asked about is the second one. They are forced, or
/// at equilibrium where both stops are; that is said as well.
fn systems() -> impl Iterator<Item = (System, Contact, [f64; 2])> {
    let forced = pair_with(&[[1.0, -0.4], [0.3, 1.0]], 0.3, 0.2);
    let mut plant = forced.plant().clone();
    let [first, second] = [&plant.stops[0], &plant.stops[1]];
    let directions = DMatrix::from_rows(&[first.direction.transpose(), second.direction.transpose()]);
    let rest = directions.lu().solve(&DVector::from_vec(vec![first.gap, second.gap])).unwrap();
    plant.load = &plant.stiffness * &rest;
    (plant.force_sin, plant.force_cos) = (DVector::zeros(2), DVector::zeros(2));
    let balanced = System::of_plant(plant).unwrap();
    let held = Contact::FREE.with(End { normal: 0, side: 0 });
    let about = [(forced, [0.0; 2]), (balanced, [rest[0], rest[1]])];
    about
        .into_iter()
        .flat_map(move |(system, at)| [Contact::FREE, held].map(|contact| (system.clone(), contact, at)))
}

/// Points of a motion about a place, small ones among them, at phases of all kinds.
fn points(flight: &Flight<f64, 2>, contact: Contact, at: [f64; 2]) -> impl Iterator<Item = Point<f64, 2>> {
    (0..200).map(move |k| {
        let of = |rate: f64| (0.1 + rate * f64::from(k)).sin();
        let size = 10f64.powi(-2 * (k % 5));
        let state = State {
            x: [at[0] + size * of(1.3), at[1] + size * of(2.1)],
            v: [size * of(3.7), size * of(0.9)],
        };
        let (sin, cos) = (0.7 * f64::from(k)).sin_cos();
        Point { state: rested(flight, &state, contact), sin, cos }
    })
}

#[test]
fn an_acceleration_moves_as_the_motion_goes_on() {
    for (system, contact, at) in systems() {
        let flight = Flight::<f64, 2>::new(&system);
        for point in points(&flight, contact, at) {
            let motion = point.motion(&flight, contact);
            let onward = onward(&flight, &point, &motion, contact);
            let s = 1e-4;
            let later = point.flown(&flight, s, contact).motion(&flight, contact);
            for i in 0..2 {
                let exact = motion.acceleration[i]
                    + s * (motion.jerk[i] + 0.5 * s * (onward.acceleration[i] + s / 3.0 * onward.jerk[i]));
                assert!((later.acceleration[i] - exact).abs() < 1e-13, "{point:?}");
                let exact = motion.jerk[i] + s * (onward.acceleration[i] + 0.5 * s * onward.jerk[i]);
                assert!((later.jerk[i] - exact).abs() < 1e-10, "{point:?}");
            }
        }
    }
}

#[test]
fn the_fourth_derivative_stays_within_its_bound() {
    let mut nearest = f64::MAX;
    for (system, contact, at) in systems() {
        let flight = Flight::<f64, 2>::new(&system);
        for point in points(&flight, contact, at) {
            let motion = point.motion(&flight, contact);
            let motions = [&motion, &onward(&flight, &point, &motion, contact)];
            let bound = fourth(&flight, motions, contact, 1, flight.h);
            for k in 0..=LOOKS {
                let s = flight.h * f64::from(k) / f64::from(LOOKS);
                let there = point.flown(&flight, s, contact);
                let onward = onward(&flight, &there, &there.motion(&flight, contact), contact);
                let now = dot(&flight.normals[1].direction, &onward.acceleration).abs();
                assert!(now <= bound * (1.0 + 1e-12), "{now} beyond {bound} after {s}: {point:?}");
                nearest = nearest.min(bound / now);
            }
        }
    }
    assert!(nearest < 2.0, "half of the bound would not hold: {nearest}");
}

/// Within the bound as without it: no stop is missed.
#[test]
fn nothing_is_met_in_a_time_that_is_clear() {
    let mut longer = 0;
    for (system, contact, at) in systems() {
        let flight = Flight::<f64, 2>::new(&system);
        let ignored = contact.with_opposite_ends();
        let direction = flight.normals[1].direction;
        for point in points(&flight, contact, at) {
            let upper = [0, 1].map(|normal| End { normal, side: 0 });
            if !upper.iter().all(|&end| ignored.includes(end) || gap_to(&flight, &point, end) > 0.0) {
                continue;
            }
            let motion = point.motion(&flight, contact);
            let clear = clear_time(&flight, &point, &motion, [contact, ignored], flight.h);
            longer += u32::from(clear > safe_time(&flight, &point, &motion, ignored, flight.h));
            for k in 1..=LOOKS {
                let s = clear * f64::from(k) / f64::from(LOOKS);
                let there = match contact.is_free() {
                    true => integrated(&flight, point.state, point.sin.atan2(point.cos), s),
                    false => point.flown(&flight, s, contact).state,
                };
                let place = dot(&direction, &there.x);
                assert!(place <= flight.normals[1].gap[0] + 1e-12, "{place} after {s} of {clear}: {point:?}");
            }
        }
    }
    assert!(longer > 20, "bounds that are asked again tell more: {longer}");
}

/// A mass that swings about its equilibrium, which is where its stop is: from wherever it is, a share of a step is clear.
#[test]
fn what_is_clear_does_not_shrink_as_the_motion_does() {
    let system = single(|plant| plant.load[0] = 0.5);
    let flight = Flight::<f64, 1>::new(&system);
    let clear = |size: f64, again: bool| {
        let point = Point::at_phase_zero(State { x: [0.5 - 0.2 * size], v: [-0.3 * size] });
        let motion = point.motion(&flight, Contact::FREE);
        match again {
            true => clear_time(&flight, &point, &motion, [Contact::FREE; 2], flight.h),
            false => safe_time(&flight, &point, &motion, Contact::FREE, flight.h),
        }
    };
    for size in [1.0, 1e-3, 1e-6, 1e-9] {
        assert!(clear(size, true) > SHORT * flight.h, "{size:e}");
    }
    // Without asking again it does.
    assert!(clear(1e-9, false) < 1e-3 * flight.h);
}
