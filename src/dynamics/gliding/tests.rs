use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;
use crate::dynamics::example::pair_with;
use crate::dynamics::stop::End;
use crate::model::{Setting, State, System};
use crate::system::{BUILTIN, Family};

/// Two masses with stops along two normals, both of them oblique.
fn oblique() -> System {
    pair_with(&[[1.0, -0.4], [0.3, 1.0]], 0.5, 0.1)
}

/// How far apart two states are, for the size of the first.
fn apart<T: Real, const N: usize>(a: &State<T, N>, b: &State<T, N>) -> f64 {
    let size = a.values().map(|value| value.widen().abs()).fold(1.0, f64::max);
    a.values().zip(b.values()).map(|(a, b)| (a - b).widen().abs()).fold(0.0, f64::max) / size
}

/// Whole steps at rest on one stop alone, from states of all kinds: how far the motion and a deviation are from their flights by
/// series at most, and how far a step of free flight is.
fn distances<T: Real, const N: usize>(system: &System, random: &mut ChaCha8Rng) -> ([f64; 2], f64) {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    let (mut most, mut free) = ([0.0f64; 2], 0.0f64);
    for (normal, of_normal) in flight.normals().iter().enumerate() {
        for side in (0..2).filter(|&side| of_normal.stop[side] != u8::MAX) {
            let contact = Contact::FREE.with(End { normal, side });
            for step in [0, 1, flight.steps - 1] {
                let mut any = || State {
                    x: [(); N].map(|()| T::of(random.random_range(-1.0..1.0))),
                    v: [(); N].map(|()| T::of(random.random_range(-1.0..1.0))),
                };
                let (sin, cos) =
                    (std::f64::consts::TAU * f64::from(step) / f64::from(flight.steps)).sin_cos();
                let (sin, cos) = (T::of(sin), T::of(cos));
                let point = Point { state: rested(&flight, &any(), contact), sin, cos };
                let trajectory = Trajectory::from_point(&flight, point, contact, step, T::zero());
                let there = trajectory.glided(&flight, flight.h);
                let flown = point.flown(&flight, flight.h, contact);
                let exact = rested(&flight, &flown.state, contact);
                most[0] = most[0].max(apart(&exact, &there.state));
                most[0] = most[0].max((flown.sin - there.sin).widen().abs());
                free = free.max(apart(&exact, &point.stepped(&flight).state));
                let tangent = Tangent(any()).caught(&flight, contact);
                let (mut gliding, mut tangents) = (trajectory, [tangent]);
                gliding.glide(&flight, &mut tangents, flight.h);
                let exact = tangent.flown(&flight, flight.h, contact);
                most[1] = most[1].max(apart(&exact.0, &tangents[0].0));
                assert_eq!((gliding.point, gliding.offset), (there, flight.h));
                // Of a part of a step it is the series alone.
                let part = T::of(0.7) * flight.h;
                let flown = point.flown(&flight, part, contact);
                let exact = Point { state: rested(&flight, &flown.state, contact), ..flown };
                assert_eq!(trajectory.glided(&flight, part), exact);
            }
        }
    }
    (most, free)
}

#[test]
fn a_whole_step_on_one_stop_is_the_flight_under_its_contact() {
    fn check<T: Real>() {
        let mut random = ChaCha8Rng::seed_from_u64(17);
        let builtin = BUILTIN.iter().map(|builtin| {
            let setting = Setting::defaults(Family::builtin(builtin.name));
            (builtin.name, System::new(setting).unwrap())
        });
        for (name, system) in builtin.chain([("two normals", oblique())]) {
            let ([motion, deviation], free) = match system.coordinates() {
                1 => distances::<T, 1>(&system, &mut random),
                2 => distances::<T, 2>(&system, &mut random),
                3 => distances::<T, 3>(&system, &mut random),
                _ => distances::<T, 4>(&system, &mut random),
            };
            let allowed = 32.0 * T::EPSILON;
            assert!(motion < allowed && deviation < allowed, "{name}: {motion} {deviation} of {allowed}");
            assert!(free > 1e-3, "{name}: {free}, the check can fail");
        }
    }
    check::<f64>();
    check::<f32>();
}

#[test]
fn several_contacts_and_parts_of_a_step_have_no_such_matrix() {
    let flight = Flight::<f64, 2>::new(&oblique());
    assert_eq!(flight.count, 2);
    let ends = [0, 1].map(|normal| End { normal, side: 0 });
    for (k, &end) in ends.iter().enumerate() {
        let contact = Contact::FREE.with(end);
        assert_eq!(whole_step(&flight, contact, flight.h), Some(&flight.normals[k].held));
        assert_eq!(whole_step(&flight, contact, 0.999 * flight.h), None);
    }
    assert_eq!(whole_step(&flight, Contact::FREE.with(ends[0]).with(ends[1]), flight.h), None);
    assert_eq!(whole_step(&flight, Contact::FREE, flight.h), None);
    assert!(whole_step(&flight, Contact::FREE.clamped(1), flight.h).is_some());
    assert_ne!(flight.normals[0].held, flight.normals[1].held);
}
