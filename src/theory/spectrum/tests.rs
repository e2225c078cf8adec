use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::*;
use crate::system::{Plant, PlantStop};
use crate::theory::example::{Ball, chain};

/// A unit mass on a unit spring with a damper, its stop out of reach; ω = 1.
fn damped(damping: f64) -> System {
    let one = |value: f64| DMatrix::from_element(1, 1, value);
    let row = |value: f64| DVector::from_element(1, value);
    let plant = Plant {
        n: 1,
        mass: one(1.0),
        damping: one(damping),
        stiffness: one(1.0),
        force_sin: row(0.2),
        force_cos: row(0.0),
        load: row(0.0),
        omega: 1.0,
        stops: vec![PlantStop { direction: row(1.0), gap: 50.0, restitution: 0.5 }],
    };
    System::of_plant(plant).unwrap()
}

#[test]
fn without_impacts_the_exponents_are_those_of_the_damped_spring() {
    for damping in [0.1f64, 1.0, 2.5, 4.0] {
        // λ² + cλ + 1 = 0: a pair with the real part −c/2, or two real roots.
        let root = (0.25 * damping * damping - 1.0).max(0.0).sqrt();
        let expected = [-0.5 * damping + root, -0.5 * damping - root].map(|rate| rate * TAU);
        let spectrum = Spectrum::of(&damped(damping), [0.1, 0.2], 4, 160).unwrap();
        for ((found, expected), error) in
            spectrum.per_period.iter().zip(expected).zip(&spectrum.standard_error)
        {
            // A pair turns while it shrinks, so that only its average is even.
            assert!((found - expected).abs() < 0.02 + 3.0 * error, "{damping}: {spectrum:?} for {expected}");
        }
        assert!((spectrum.per_period.iter().sum::<f64>() + damping * TAU).abs() < 1e-9, "{spectrum:?}");
        assert!((spectrum.sum_identity(&damped(damping)) + damping * TAU).abs() < 1e-12);
        assert_eq!((spectrum.lost, spectrum.impacts, spectrum.per_iterate(Stop::A)), (0, 0, None));
    }
}

#[test]
fn on_the_motion_of_the_bouncing_ball_the_exponents_are_those_of_its_multipliers() {
    let ball = Ball::STABLE;
    let section = ball.section(false).unwrap();
    let multipliers = ball.jacobian(section).complex_eigenvalues();
    let expected = multipliers[0].norm().ln();
    assert!((expected - ball.restitution.ln()).abs() < 1e-12, "a complex pair of modulus r: {multipliers}");
    let spectrum = Spectrum::of(&ball.system(), ball.state(section), 8, 320).unwrap();
    for found in &spectrum.per_period {
        assert!((found - expected).abs() < 0.02, "{spectrum:?} for {expected}");
    }
    assert!((spectrum.per_period.iter().sum::<f64>() - 2.0 * expected).abs() < 1e-9);
    assert_eq!((spectrum.impacts, spectrum.returns(Stop::A)), (320, Some(320)), "one impact a period");
    assert_eq!(spectrum.per_iterate(Stop::A).unwrap(), spectrum.per_period);
}

#[test]
fn the_exponents_add_up_to_what_impacts_and_damping_take() {
    let system = chain();
    let spectrum = Spectrum::of(&system, [0.05, -0.02, 0.03, 0.4, 0.6, -0.3], 20, 160).unwrap();
    assert!(spectrum.impacts > 0 && spectrum.lost == 0);
    let sum: f64 = spectrum.per_period.iter().sum();
    let identity = spectrum.sum_identity(&system);
    assert!((sum - identity).abs() < 1e-8 * identity.abs(), "{sum} for {identity}");
    let flight_alone = -system.period() * system.contraction();
    assert!((sum - flight_alone).abs() > 0.1, "the check can fail");
}

#[test]
fn a_ball_that_sticks_loses_both_directions() {
    let plastic = Ball { restitution: 0.0, ..Ball::STABLE };
    let spectrum = Spectrum::of(&plastic.system(), [-0.1, 0.0], 4, 16).unwrap();
    assert_eq!(spectrum.lost, 2);
    assert_eq!(spectrum.per_period, [f64::NEG_INFINITY; 2]);
}

#[test]
fn a_state_that_is_not_bounded_fails_in_its_period() {
    let system = Ball::STABLE.system();
    for (transient, velocity) in [(0, f64::NAN), (3, f64::NAN), (3, 1e19)] {
        let failed = Spectrum::of(&system, [-0.1, velocity], transient, 16).unwrap_err();
        assert_eq!((failed.periods, failed.reason), (0, "it grows without bounds"));
    }
}

#[test]
fn moves_without_end_are_given_up() {
    let system = Ball::STABLE.system();
    let mut follower = follower(&system);
    follower.begin(&[-0.1, 0.0]);
    let mut headway = Headway { periods: 7, moves: Moves::default() };
    let mut note = |event: Event<f64>| headway.note(follower.as_ref(), &event);
    for _ in 0..crate::dynamics::constants::MOST_MOVES {
        assert_eq!(note(Event::Flight), Ok(true));
    }
    assert_eq!(
        (note(Event::StepEnd), note(Event::Strobe)),
        (Ok(true), Ok(false)),
        "a period is over in time"
    );
    for _ in 0..crate::dynamics::constants::FAIR_MOVES {
        assert_eq!(note(Event::Flight), Ok(true), "of which each has its share");
    }
    let failed = note(Event::Flight).unwrap_err();
    assert_eq!((failed.periods, failed.reason), (8, "too many impacts in each forcing period"));
}
