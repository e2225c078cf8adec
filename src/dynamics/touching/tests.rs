use nalgebra::{DMatrix, DVector};

use super::*;
use crate::dynamics::along::Alongs;
use crate::dynamics::crossing::{Crossing, crossing};
use crate::dynamics::leg::{Clearance, Clearances};
use crate::dynamics::swing::{Swing, bounded, step, stops};
use crate::dynamics::{Contact, Point, Trajectory};
use crate::model::vector::MOST;
use crate::model::{Real, State, System};
use crate::system::{Plant, PlantStop};

/// What becomes of a leg.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    Clears,
    Passes,
    Meets,
    Uncertain,
}

fn fate<T: Real>(swing: &Swing<T>) -> Fate {
    let clearances = swing.leg().clearances(&swing.flight);
    let crossing = crossing(&swing.leg(), &clearances, &swing.flight);
    assert!(!(crossing.certain && crossing.passes));
    match (clearances.all(swing.flight.count), crossing.certain, crossing.passes) {
        (true, ..) => Fate::Clears,
        (_, true, _) => Fate::Meets,
        (.., true) => Fate::Passes,
        _ => Fate::Uncertain,
    }
}

/// The first impact of a step, and when: the speed before it.
fn first_impact<T: Real>(swing: &Swing<T>) -> Option<(f64, f64)> {
    let mut trajectory = Trajectory::from_point(&swing.flight, swing.from, Contact::FREE, 0, T::zero());
    let mut at = 0.0;
    for _ in 0..200 {
        let taken = trajectory.advance(&swing.flight, &mut []);
        at += taken.time.widen();
        match taken.event {
            crate::dynamics::Event::Impact(impact) => return Some((at, impact.velocity_before.widen())),
            crate::dynamics::Event::Flight => {}
            _ => return None,
        }
    }
    panic!("the step does not end")
}

/// Swings that turn short of the stop, at it and beyond, early and late in a step: by more than rounding they are told apart, and
/// none that turns short of the stop is called a contact, however little.
fn grazes<T: Real>() {
    let h = step();
    let mut met = 0;
    let shares = [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9];
    let cases = shares.into_iter().flat_map(|share| [1.0, -1.0].map(|side| (share, side)));
    for (share, side) in cases {
        let touch = share * h;
        let phase = 0.5 * std::f64::consts::PI - touch;
        for beyond in [-0.3f64, -0.1, -0.05, -1e-3, 1e-4, 1e-3, 1e-2] {
            if (1.0 + beyond) * phase.sin() > 1.0 {
                // It begins beyond the stop.
                continue;
            }
            let swing = Swing::<T>::new(side * 0.5 * (1.0 + beyond), phase, stops(0.5, 0.7));
            match fate(&swing) {
                Fate::Clears => assert!(beyond < -1e-3, "{share} {beyond}"),
                Fate::Passes => assert!((-0.1..0.0).contains(&beyond), "{share} {beyond}"),
                Fate::Meets => assert!(beyond > 0.0, "{share} {beyond}"),
                // The polynomial finds a contact the less exactly the more it is tangential: the course is asked again.
                Fate::Uncertain => assert!(!T::ASKS_AGAIN && beyond == 1e-4, "{share} {beyond}"),
            }
            let impact = first_impact(&swing);
            assert_eq!(impact.is_some(), beyond > 0.0, "{share} {beyond}");
            if let Some((at, struck)) = impact {
                let contact = (1.0 / (1.0 + beyond)).asin() - phase;
                let speed = 0.5 * (1.0 + beyond) * (contact + phase).cos();
                let most = 64.0 * T::EPSILON / speed;
                assert!((at - contact).abs() < most, "{share} {beyond}: {at} for {contact}");
                assert!((side * struck - speed).abs() < most, "{share} {beyond}: {struck} for {speed}");
                met += 1;
            }
        }
        for roundings in [-256, -64, -48, -32, -24, -16, -8, 0, 8, 32, 64, 256] {
            let beyond = f64::from(roundings) * T::EPSILON;
            let swing = Swing::<T>::new(side * 0.5 * (1.0 + beyond), phase, stops(0.5, 0.7));
            match fate(&swing) {
                Fate::Clears => panic!("{share} {roundings}"),
                Fate::Passes => assert!(roundings < 0, "{share} {roundings}"),
                Fate::Meets => assert!(roundings > 0, "{share} {roundings}"),
                Fate::Uncertain => {}
            }
            if let Some((at, struck)) = first_impact(&swing) {
                // Within rounding of the touch, an impact is one whose speed is the root of rounding.
                assert!(roundings > -256 && struck.abs() < 16.0 * T::EPSILON.sqrt(), "{share} {roundings}");
                assert!((at - touch).abs() < 32.0 * T::EPSILON.sqrt(), "{share} {roundings}: {at}");
            }
        }
    }
    assert_eq!(met, 2 * 20, "contacts are met");
}

/// Every turn within rounding short of the stop.
fn turns_within_rounding<T: Real>() {
    let h = step();
    for (part, roundings) in (1..38).flat_map(|part| (-64..=0).map(move |roundings| (part, roundings))) {
        let phase = 0.5 * std::f64::consts::PI - h * f64::from(part) / 38.0;
        let amplitude = 0.5 * (1.0 + f64::from(roundings) * T::EPSILON);
        let swing = Swing::<T>::new(amplitude, phase, stops(0.5, 0.7));
        assert!(matches!(fate(&swing), Fate::Uncertain | Fate::Passes), "{part} {roundings}");
    }
}

/// Swings that come near to the stop and end before they turn, or turned before they began; what is known of them beforehand is
/// far less than what they do.
fn comes_near<T: Real>() {
    let (h, quarter) = (step(), 0.5 * std::f64::consts::PI);
    const BOUND: f64 = 16.0;
    let (mut passed, mut met) = (0, 0);
    for (side, late) in [1.0, -1.0].into_iter().flat_map(|side| [0.02, 0.1, 0.2].map(|late| (side, late))) {
        for phase in [quarter - h - late, quarter + late] {
            let nearest = phase.sin().max((phase + h).sin());
            let to = |place: f64| {
                let mut swing = Swing::<T>::new(side * place / nearest, phase, stops(0.5, 0.7));
                swing.flight.normals[0].bound.forcing = T::of(BOUND);
                fate(&swing)
            };
            for left in [1e-4, 1e-3, 1e-2, 0.05] {
                let fate = to(0.5 - left);
                assert!(
                    matches!(fate, Fate::Clears | Fate::Passes),
                    "{side} {late} {left} {phase}: {fate:?}"
                );
                passed += usize::from(fate == Fate::Passes);
            }
            met += usize::from(phase < quarter && to(0.51) == Fate::Meets);
        }
    }
    assert!(passed > 8 && met == 6, "{passed} of 48 passed, {met} of 6 met");
}

#[test]
fn a_swing_that_comes_near_to_the_stop_and_does_not_turn_passes_it() {
    comes_near::<f64>();
    comes_near::<f32>();
}

#[test]
fn no_swing_that_turns_within_rounding_of_the_stop_is_certain_to_meet_it() {
    turns_within_rounding::<f64>();
    turns_within_rounding::<f32>();
}

#[test]
fn a_swing_that_turns_at_the_stop_meets_it_where_it_reaches_it() {
    grazes::<f64>();
    grazes::<f32>();
}

/// Two masses that swing alike in one step, about where the first turns, each between stops of its own; a gap of none leaves one
/// out. The second begins at a place with a speed.
fn two_masses(gaps: [[Option<f64>; 2]; 2], [place, speed]: [f64; 2]) -> Crossing<f64, 2> {
    let unit = || DMatrix::<f64>::identity(2, 2);
    let stop = |mass: usize, side: usize| {
        let mut direction = DVector::zeros(2);
        direction[mass] = [1.0, -1.0][side];
        Some(PlantStop { direction, gap: gaps[mass][side]?, restitution: 0.7 })
    };
    let plant = Plant {
        n: 2,
        mass: unit(),
        damping: DMatrix::zeros(2, 2),
        stiffness: unit(),
        force_sin: DVector::zeros(2),
        force_cos: DVector::zeros(2),
        load: DVector::zeros(2),
        omega: 1.0,
        stops: [(0, 0), (0, 1), (1, 0), (1, 1)]
            .into_iter()
            .filter_map(|(mass, side)| stop(mass, side))
            .collect(),
    };
    let flight = Flight::<f64, 2>::new(&System::of_plant(plant).unwrap());
    assert_eq!(flight.count, 2, "two normals");
    let (sin, cos) = (0.5 * std::f64::consts::PI - 0.5 * flight.h).sin_cos();
    let from = Point::at_phase_zero(State { x: [0.5 * sin, place], v: [0.5 * cos, speed] });
    let to = from.stepped(&flight);
    let leg = Leg::new(Alongs::of(&from, &flight, flight.count), &to, Span::of(flight.h), &flight);
    crossing(&leg, &leg.clearances(&flight), &flight)
}

#[test]
fn a_leg_that_passes_one_stop_may_meet_another() {
    let h = step();
    let (sin, cos) = (0.5 * std::f64::consts::PI - 0.5 * h).sin_cos();
    let first = [Some(0.51), None];
    let turns = [0.5 * sin, 0.5 * cos];
    for (gap, passes) in [(1.0, true), (0.51, true), (0.5 - 1e-3, false)] {
        let met = two_masses([first, [Some(gap), None]], turns);
        assert_eq!((met.certain, met.passes), (false, passes), "{gap}");
    }
    // The other way, towards the lower end of a normal with two stops, or of its own.
    for second in [[Some(2.0), Some(0.51)], [None, Some(0.51)]] {
        let met = two_masses([first, second], turns.map(|x| -x));
        assert_eq!((met.certain, met.passes), (false, true), "{second:?}");
        assert_eq!((met.normal, met.upper), (1.0, second[0].is_none()));
    }
    // Through its own stop.
    let met = two_masses([first, [Some(0.3), None]], [0.0, 0.9]);
    assert_eq!((met.certain, met.passes), (false, false));
    let alone = two_masses([[Some(5.0), None], [Some(0.3), None]], [0.0, 0.9]);
    assert!(alone.certain, "the check can fail");
}

#[test]
fn a_leg_returns_from_the_one_stop_that_it_does_not_stay_off() {
    let swing = Swing::<f64>::new(0.4, 0.3, stops(0.5, 0.7));
    let face = |upper: bool, lower: bool| {
        let clearances = Clearances([Clearance { upper, lower }; MOST]);
        let face = Face::of(&swing.leg(), &clearances, &swing.flight);
        (face.only, face.returns, face.upper)
    };
    assert_eq!(face(true, false), (true, true, false));
    assert_eq!(face(false, true), (true, true, true));
    for neither in [face(true, true), face(false, false)] {
        assert_eq!(neither, (false, false, false));
    }
}

#[test]
fn what_is_not_a_number_meets_and_passes_nothing() {
    let phase = 0.5 * std::f64::consts::PI - 0.5 * step();
    let swing = Swing::<f64>::new(0.49, phase, stops(0.5, 0.7));
    assert_eq!(fate(&swing), Fate::Passes);
    for spoilt in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for k in 0..4 {
            let mut swing = Swing::<f64>::new(0.49, phase, stops(0.5, 0.7));
            let Swing { from, to, .. } = &mut swing;
            let places = [&mut from.state.x[0], &mut from.state.v[0], &mut to.state.x[0], &mut to.state.v[0]];
            *places.into_iter().nth(k).unwrap() = spoilt;
            assert_eq!(fate(&swing), Fate::Uncertain, "{spoilt} at {k}");
        }
    }
}

#[test]
fn a_touch_is_deep_where_it_goes_beyond_the_stop_by_more_than_rounding() {
    // At most 0.5 + 0.8/8 pulls it back: v² is held against 2 · 1e-10 · 0.6.
    let deep =
        |arrives: f64, pulls: [f64; 2], rounding: f64| is_deep(&bounded(0.8), arrives, pulls, rounding);
    assert!(deep(1.1e-5, [-0.3, -0.5], 1e-10) && deep(1.1e-5, [-0.5, -0.3], 1e-10));
    assert!(!deep(1.09e-5, [-0.3, -0.5], 1e-10));
    assert!(deep(1e-9, [1.0, 0.5], 1e-10), "nothing pulls it back");
    assert!(!deep(f64::NAN, [-0.3, -0.5], 1e-10) && !deep(1.0, [-0.3, -0.5], f64::NAN));
}
