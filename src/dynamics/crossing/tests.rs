use nalgebra::{DMatrix, DVector};

use super::*;
use crate::dynamics::example::single;
use crate::dynamics::{Contact, Trajectory};
use crate::model::System;
use crate::system::{Plant, PlantStop};

/// A swing x = A sin(s + φ) of the unit mass on the unit spring, at the beginning of a step: its flight and its step's end.
struct Swing<T> {
    flight: Flight<T, 1>,
    from: Point<T, 1>,
    to: Point<T, 1>,
}

impl<T: Real> Swing<T> {
    fn new(amplitude: f64, phase: f64, edit: impl FnOnce(&mut Plant)) -> Self {
        let flight = Flight::<f64, 1>::new(&single(edit)).round::<T>();
        let (sin, cos) = phase.sin_cos();
        let state = State { x: [T::of(amplitude * sin)], v: [T::of(amplitude * cos)] };
        let from = Point::at_phase_zero(state);
        Swing { to: from.stepped(&flight), from, flight }
    }

    fn leg(&self) -> Leg<'_, T, 1> {
        Leg { from: &self.from, to: &self.to, window: self.flight.h }
    }

    fn h(&self) -> f64 {
        self.flight.h.widen()
    }
}

/// The length of a step.
fn step() -> f64 {
    Swing::<f64>::new(0.0, 0.0, |_| {}).h()
}

/// Sets both gaps and restitutions.
fn stops(gap: f64, restitution: f64) -> impl Fn(&mut Plant) {
    move |plant| {
        for stop in &mut plant.stops {
            (stop.gap, stop.restitution) = (gap, restitution);
        }
    }
}

fn through<T: Real>() {
    let h = step();
    let mut met = 0;
    for restitution in [0.05, 0.7, 1.0] {
        for phase in [-0.5 * h, 0.0, 0.4, 0.9] {
            for share in [1e-3, 0.1, 0.49, 0.51, 0.9, 0.999] {
                for side in [1.0, -1.0] {
                    let gap = (phase + share * h).sin();
                    if phase + share * h > 1.3 || gap <= phase.sin().abs() {
                        continue;
                    }
                    let swing = Swing::<T>::new(side, phase, stops(gap, restitution));
                    let crossing =
                        crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight);
                    assert!(crossing.certain, "{restitution} {phase} {share} {side}");
                    assert_eq!((crossing.normals[0], crossing.upper), (true, side > 0.0));
                    let slope = (phase + share * h).cos();
                    let close = |found: T, expected: f64| {
                        (found.widen() - expected).abs() < 32.0 * T::EPSILON / slope
                    };
                    assert!(close(crossing.time, share * h), "{:?} for {}", crossing.time, share * h);
                    assert!(!close(crossing.time, share * h + 1e-4), "the check can fail");
                    let velocity = side * slope;
                    assert!(close(crossing.impact.velocity, velocity));
                    assert!(close(crossing.rebound, -restitution * velocity));
                    assert_eq!(crossing.point.state.x[0].widen(), side * T::of(gap).widen(), "on the stop");
                    // The rest of the step: a swing from the stop, back.
                    let (sin, cos) = (h - share * h).sin_cos();
                    let [x, v] = [
                        side * gap * cos - restitution * velocity * sin,
                        -side * gap * sin - restitution * velocity * cos,
                    ];
                    assert!(close(crossing.ahead.state.x[0], x) && close(crossing.ahead.state.v[0], v));
                    met += 1;
                }
            }
        }
    }
    assert!(met > 50, "contacts are met: {met}");
}

#[test]
fn a_contact_within_a_step_is_that_of_the_closed_form() {
    through::<f64>();
    through::<f32>();
}

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
    for share in [0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9] {
        let touch = share * h;
        let phase = 0.5 * std::f64::consts::PI - touch;
        for beyond in [-0.3, -0.1, -0.05, -1e-3, 1e-3, 1e-2] {
            if (1.0 + beyond) * phase.sin() > 1.0 {
                // It begins beyond the stop.
                continue;
            }
            let swing = Swing::<T>::new(0.5 * (1.0 + beyond), phase, stops(0.5, 0.7));
            match fate(&swing) {
                Fate::Clears => assert!(beyond < -1e-3, "{share} {beyond}"),
                Fate::Passes => assert!((-0.1..0.0).contains(&beyond), "{share} {beyond}"),
                Fate::Meets => assert!(beyond > 0.0, "{share} {beyond}"),
                // The polynomial finds a contact the less exactly the more it is tangential.
                Fate::Uncertain => assert_eq!(beyond, 1e-3, "{share}"),
            }
            let impact = first_impact(&swing);
            assert_eq!(impact.is_some(), beyond > 0.0, "{share} {beyond}");
            if let Some((at, struck)) = impact {
                let contact = (1.0 / (1.0 + beyond)).asin() - phase;
                let speed = 0.5 * (1.0 + beyond) * (contact + phase).cos();
                let most = 64.0 * T::EPSILON / speed;
                assert!((at - contact).abs() < most, "{share} {beyond}: {at} for {contact}");
                assert!((struck - speed).abs() < most, "{share} {beyond}: {struck} for {speed}");
                met += 1;
            }
        }
        for roundings in [-256, -64, -48, -32, -24, -16, -8, 0, 8, 32, 64, 256] {
            let beyond = f64::from(roundings) * T::EPSILON;
            let swing = Swing::<T>::new(0.5 * (1.0 + beyond), phase, stops(0.5, 0.7));
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
    assert_eq!(met, 13, "contacts are met");
}

#[test]
fn a_swing_that_turns_at_the_stop_meets_it_where_it_reaches_it() {
    grazes::<f64>();
    grazes::<f32>();
}

/// A leg that turns off one stop meets none only if it stays off those along all other normals too: two masses swing alike, the
/// second towards a stop of its own.
#[test]
fn a_leg_that_passes_one_stop_may_meet_another() {
    let of_second = |gap: f64| {
        let unit = || DMatrix::<f64>::identity(2, 2);
        let stop = |direction: [f64; 2], gap: f64| PlantStop {
            direction: DVector::from_row_slice(&direction),
            gap,
            restitution: 0.7,
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
            stops: vec![stop([1.0, 0.0], 0.51), stop([0.0, 1.0], gap)],
        };
        let flight = Flight::<f64, 2>::new(&System::of_plant(plant).unwrap());
        assert_eq!(flight.count, 2, "two normals");
        let (sin, cos) = (0.5 * std::f64::consts::PI - 0.5 * flight.h).sin_cos();
        let from = Point::at_phase_zero(State { x: [0.5 * sin; 2], v: [0.5 * cos; 2] });
        let to = from.stepped(&flight);
        let leg = Leg { from: &from, to: &to, window: flight.h };
        let crossing = crossing(&leg, &leg.clearances(&flight), &flight);
        assert!(!crossing.certain);
        crossing.passes
    };
    assert_eq!([1.0, 0.51, 0.5 - 1e-3].map(of_second), [true, true, false]);
}

/// What is left to the approach from the safe side.
fn refuses<T: Real>() {
    let h = step();
    let certain = |amplitude: f64, phase: f64, gap: f64, restitution: f64| {
        let swing = Swing::<T>::new(amplitude, phase, stops(gap, restitution));
        crossing(&swing.leg(), &swing.leg().clearances(&swing.flight), &swing.flight).certain
    };
    let gap = (0.5 * h).sin();
    assert!(certain(1.0, 0.0, gap, 0.7));
    assert!(!certain(1.0, 0.0, gap, 0.0), "an impact without rebound may stick");
    assert!(!certain(1.0, 0.0, 2.0 * h, 0.7), "a leg that ends within the stops crosses none");
    assert!(!certain(1.0, 0.0, h.sin() * (1.0 + 4.0 * T::EPSILON), 0.7), "nor one that ends at it");
    assert!(!certain(0.0, 0.0, gap, 0.7), "nor one at rest");
}

#[test]
fn what_is_not_certain_is_refused() {
    refuses::<f64>();
    refuses::<f32>();
}

/// A way to the stop that the certificates are asked about: from rest at `gap` with the speed and the accelerations at both
/// ends of a step of length 1, between which the acceleration changes steadily.
struct Way {
    speed: f64,
    pulls: [f64; 2],
    time: f64,
}

impl Way {
    fn place(&self, s: f64) -> f64 {
        let [first, last] = self.pulls;
        s * (self.speed + s * (0.5 * first + s * (last - first) / 6.0))
    }

    /// Whether the contact after `time` is known to be the first, by either certificate, with the other stop as far away.
    fn certified(&self, bound: f64, width: f64) -> [bool; 2] {
        let [first, last] = self.pulls;
        let arrives = self.speed + self.time * (first + 0.5 * self.time * (last - first));
        let gap = self.place(self.time);
        let face = Face::<f64, 1> {
            only: true,
            found: true,
            returns: false,
            opposite_clear: false,
            normals: [true, false, false, false],
            upper: true,
            sign: 1.0,
            gap,
            width,
            restitution: 1.0,
            direction: [1.0],
            response: [1.0],
            bound,
            coupling: 0.0,
        };
        [
            is_first(&face, [self.speed, arrives], self.pulls, self.time, 1.0),
            stays_off(&face, gap, [self.speed, arrives], self.time),
        ]
    }
}

#[test]
fn a_way_that_slows_down_and_speeds_up_again_is_certified_by_its_hull() {
    let slows = Way { speed: 0.3, pulls: [-1.0, 3.0], time: 0.9 };
    assert_eq!(slows.certified(0.0, 1.0), [false, true]);
    assert_eq!(slows.certified(1e3, 1.0), [false, false], "what bounds it is too far away");
    assert_eq!(slows.certified(0.0, 0.25), [false, false], "the other stop lies on the way");
    // It would meet the stop before, and turn: the contact is the second.
    let turns = Way { speed: 2.0, pulls: [-14.0, 20.0], time: 0.85 };
    assert!(turns.place(0.184) > turns.place(turns.time), "the stop is passed before");
    assert_eq!(turns.certified(0.0, 10.0), [false, false]);
}
