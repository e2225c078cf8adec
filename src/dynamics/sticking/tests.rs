use std::f64::consts::{PI, TAU};

use super::*;
use crate::dynamics::example::{pair_with, single};
use crate::dynamics::{Contact, Impact};
use crate::model::{Parameters, State, System};

/// A free mass on the upper stop, pressed on it by load + cos(ωt − φ), ω = 1.
fn pressed(load: f64, phase: f64) -> System {
    single(|plant| {
        plant.stiffness[(0, 0)] = 0.0;
        plant.load[0] = load;
        plant.force_sin[0] = phase.sin();
        plant.force_cos[0] = phase.cos();
        plant.stops.truncate(1);
    })
}

/// The trajectory that begins at rest on the stop at forcing phase 0, to a time: where it is, and the times of releases and of
/// contacts that begin to hold.
struct Rested {
    state: State<f64, 1>,
    contact: Contact,
    released: Vec<f64>,
    caught: Vec<f64>,
    /// Moves within a step, at rest.
    pieces: u32,
}

fn rested<T: Real>(system: &System, until: f64) -> Rested {
    let flight = Flight::<f64, 1>::new(system).round::<T>();
    let start = State { x: [T::of(0.5)], v: [T::zero()] };
    let mut trajectory = Trajectory::new(&flight, start);
    let (mut at, mut released, mut caught, mut pieces) = (0.0, Vec::new(), Vec::new(), 0);
    while at < until {
        let begins = at;
        let taken = trajectory.advance(&flight, &mut []);
        at += taken.time.widen();
        match taken.event {
            Event::Released(_) => released.push(begins),
            Event::Caught { impact: Impact { velocity_before, .. }, .. } => {
                assert_eq!(velocity_before.widen(), 0.0, "it rests there already");
                caught.push(at);
            }
            Event::Impact(impact) => panic!("no impact: {impact:?} at {at}"),
            Event::Flight => pieces += u32::from(!taken.contact.is_free()),
            _ => {}
        }
    }
    Rested {
        state: trajectory.point.state.map(Real::widen),
        contact: trajectory.contact,
        released,
        caught,
        pieces,
    }
}

fn releases<T: Real>() {
    let steps = pressed(0.0, 0.0).steps();
    let h = TAU / f64::from(steps);
    // The force cos(t − φ) changes its sign at t = φ + π/2: at the end of a step, just before and after it, in the middle.
    for place in [3.0, 3.0 - 1e-6, 3.0 + 1e-6, 3.5, f64::from(steps / 4)] {
        let expected = place * h;
        let phase = expected - 0.5 * PI;
        let until = expected + 1.5 * h;
        let found = rested::<T>(&pressed(0.0, phase), until);
        assert_eq!((found.released.len(), found.caught.len()), (1, 1), "{place}");
        assert!(found.pieces <= 1, "{place}: a mass does not creep towards its release: {}", found.pieces);
        // A force of the size of rounding, and flights of √ε h at least.
        let allowed = 8.0 * T::EPSILON.sqrt() * h;
        let near = |expected: f64| (found.released[0] - expected).abs() < allowed;
        assert!(near(expected), "{place}: {} for {expected}", found.released[0]);
        assert!(!near(expected + 0.01 * h), "the check can fail");
        assert!(found.contact.is_free());
        // From there x″ = −sin s, s being the time since.
        let s = (until / h).ceil() * h - expected;
        let [x, v] = [0.5 + s.sin() - s, s.cos() - 1.0];
        let away = (found.state.x[0] - x).abs().max((found.state.v[0] - v).abs());
        assert!(away < 64.0 * T::EPSILON, "{place}: {:?} for {x} {v}", found.state);
    }
}

#[test]
fn a_contact_opens_where_the_pressing_force_changes_its_sign() {
    releases::<f64>();
    releases::<f32>();
}

fn holds<T: Real>() {
    // A force that is always above 0 holds the mass for ever, exactly where it is.
    for (load, phase) in [(1.0, 0.0), (1.0, 1.0), (1.01, 0.0)] {
        let found = rested::<T>(&pressed(load + 0.01, phase), 2.0 * TAU);
        assert_eq!(found.released, Vec::<f64>::new(), "{load} {phase}");
        assert_eq!((found.state.x[0], found.state.v[0]), (0.5, 0.0));
        assert!(!found.contact.is_free());
    }
    // One that falls below 0 for a while does not.
    let found = rested::<T>(&pressed(0.9, 0.0), 0.9 * PI);
    assert_eq!(found.released.len(), 1);
}

#[test]
fn a_contact_holds_while_a_force_presses() {
    holds::<f64>();
    holds::<f32>();
}

/// A force that falls below 0 for far less than a step, somewhere in the middle of one.
fn lets_go_within_a_step<T: Real>() {
    let h = TAU / f64::from(pressed(0.0, 0.0).steps());
    for (beneath, place) in [(1e-3, 2.5), (1e-2, 2.3)] {
        let opens = (1.0f64 - beneath).acos();
        let middle = place * h;
        assert!(opens < 0.35 * h, "{opens} of {h}");
        // 1 − beneath − cos(t − middle), which is below 0 for `opens` on either side of the middle.
        let found = rested::<T>(&pressed(1.0 - beneath, middle - PI), middle);
        assert_eq!(found.released.len(), 1, "{beneath}");
        let away = (found.released[0] - (middle - opens)).abs();
        assert!(away < 8.0 * T::EPSILON.sqrt() * h + 4.0 * T::EPSILON / opens, "{beneath}: {away}");
        assert_eq!(
            rested::<T>(&pressed(1.0 + beneath, middle - PI), 2.0 * middle).released,
            Vec::<f64>::new()
        );
    }
}

#[test]
fn a_force_that_vanishes_for_a_moment_lets_the_mass_go() {
    lets_go_within_a_step::<f64>();
    lets_go_within_a_step::<f32>();
}

/// A force that comes to 0 without changing its sign, at phase π.
fn touches_zero<T: Real>() {
    let found = rested::<T>(&pressed(1.0, 0.0), TAU);
    assert!((found.state.x[0] - 0.5).abs() < 4.0 * T::EPSILON && found.state.v[0].abs() < 4.0 * T::EPSILON);
    assert!(!found.contact.is_free(), "it rests again, if it was let go at all");
    assert!(found.released.iter().all(|at| (at - PI).abs() < 4.0 * T::EPSILON.powf(0.25)));
}

#[test]
fn a_force_that_only_touches_zero_leaves_the_mass_on_its_stop() {
    touches_zero::<f64>();
    touches_zero::<f32>();
}

/// A mass at rest on its stop that nothing presses on: pulled off at once, whether by the force or by its rate alone.
fn is_let_go<T: Real>() {
    for phase in [PI, 0.75 * PI, -0.5 * PI] {
        let system = pressed(0.0, phase);
        let h = system.period() / f64::from(system.steps());
        let found = rested::<T>(&system, 1.5 * h);
        assert!(found.contact.is_free() && found.state.x[0] < 0.5, "{phase}: {:?}", found.state);
        assert!(found.released.iter().all(|&at| at < 8.0 * T::EPSILON.sqrt() * h), "{:?}", found.released);
        // x″ = cos(t − φ), from rest.
        let t = 2.0 * h;
        let v = (t - phase).sin() + phase.sin();
        let x = 0.5 - (t - phase).cos() + phase.cos() + t * phase.sin();
        let away = (found.state.x[0] - x).abs().max((found.state.v[0] - v).abs());
        assert!(away < 64.0 * T::EPSILON, "{phase}: {:?} for {x} {v}", found.state);
    }
}

#[test]
fn a_mass_that_nothing_presses_leaves_its_stop_at_once() {
    is_let_go::<f64>();
    is_let_go::<f32>();
}

/// Whole steps at rest of a long motion, in which no other stop is met: how often the contacts were seen to last, how often not,
/// and how often several were.
fn glances<T: Real>(system: &System) -> [u32; 3] {
    let flight = Flight::<f64, 2>::new(system).round::<T>();
    let mut trajectory = Trajectory::new(&flight, State::zero());
    let late = flight.least();
    let mut met = [0; 3];
    for _ in 0..20_000 {
        let (point, contact) = (trajectory.point, trajectory.contact);
        let motion = point.motion(&flight, contact);
        let clear = clear_time(&flight, &point, &motion, [contact, contact.with_opposite_ends()], flight.h);
        if !contact.is_free() && trajectory.offset == T::zero() && clear >= flight.h {
            match trajectory.rested_step(&flight, &motion, late) {
                None => met[1] += 1,
                Some(there) => {
                    met[0] += 1;
                    met[2] += u32::from(contact.held().count_ones() > 1);
                    // Whatever is known from its beginning alone.
                    for sure in [late, T::of(0.5) * flight.h, flight.h] {
                        let found = trajectory.held_flight(&flight, &motion, [sure, flight.h], late);
                        assert_eq!(found, (flight.h, there), "{trajectory:?}");
                    }
                }
            }
        }
        trajectory.advance(&flight, &mut []);
    }
    met
}

#[test]
fn contacts_that_are_seen_to_last_are_those_of_a_held_flight() {
    let paper = |omega: f64, delta: f64| {
        System::new(Parameters { omega, delta, r: 0.5, ..Parameters::default() }).unwrap()
    };
    for system in [paper(0.3, 0.2), paper(0.45, 0.4), paper(0.6, 0.1)] {
        for [seen, not, _] in [glances::<f64>(&system), glances::<f32>(&system)] {
            assert!(seen > 200 && not > 20, "{seen} {not}");
        }
    }
    // Masses that rest on two stops at once.
    let both = pair_with(&[[1.0, -0.4], [0.3, 1.0]], 0.3, 1.0);
    for [seen, _, several] in [glances::<f64>(&both), glances::<f32>(&both)] {
        assert!(several > 100 && several <= seen, "{several} of {seen}");
    }
}

/// What nothing presses at first is let go, even where it would be pressed soon after.
fn pulled_at_first<T: Real>() {
    // The force is cos(t − φ), which grows.
    for (beneath, held) in [(0.01, false), (-0.01, true)] {
        let system = pressed(0.0, 0.5 * PI + beneath);
        let flight = Flight::<f64, 1>::new(&system).round::<T>();
        let trajectory = Trajectory::new(&flight, State { x: [T::of(0.5)], v: [T::zero()] });
        let end = End { normal: 0, side: 0 };
        let trajectory = Trajectory { contact: Contact::FREE.with(end), ..trajectory };
        let motion = trajectory.point.motion(&flight, trajectory.contact);
        let late = flight.least();
        let there = trajectory.glided(&flight, flight.h);
        let then = there.motion(&flight, trajectory.contact);
        let pressing = Pressing::on(&flight, &trajectory.point, &motion, trajectory.contact, end);
        let bound = motion.pressed_bound(&flight, trajectory.contact, 0);
        let pressed = Pressed::over(flight.h, &pressing, &then, bound, end);
        assert!(pressed.lasts(late), "what follows lasts, as far as that is asked");
        assert_eq!(trajectory.rested_step(&flight, &motion, late).is_some(), held, "{beneath}");
    }
}

#[test]
fn a_contact_that_opens_now_is_not_seen_to_last() {
    pulled_at_first::<f64>();
    pulled_at_first::<f32>();
}
