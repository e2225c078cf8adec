use super::*;
use crate::dynamics::Contact;
use crate::model::vector::dot;
use crate::model::{Setting, State, System};
use crate::system::Family;

/// A flight of a system and a point of its motion, neither at phase 0 nor at rest.
fn begun<T: Real, const N: usize>(system: &System) -> (Flight<T, N>, Point<T, N>) {
    let flight = Flight::<f64, N>::new(system).round::<T>();
    let number = |value: f64| T::of(value);
    let state = State {
        x: std::array::from_fn(|i| number(0.1 - 0.4 * i as f64)),
        v: std::array::from_fn(|i| number(0.9 - 0.5 * i as f64)),
    };
    let (sin, cos) = 0.7f64.sin_cos();
    (flight, Point { state, sin: number(sin), cos: number(cos) })
}

/// How far what the end of a step says of the way to it is from the flight along it, in roundings of the state: place, speed and
/// pull, where so much of the step is left, and there from a little before.
fn errors<T: Real, const N: usize>(system: &System, left: f64, said: f64) -> [f64; 3] {
    let (flight, from) = begun::<T, N>(system);
    let end = from.flown(&flight, flight.h, Contact::FREE);
    let there = from.flown(&flight, flight.h * T::of(1.0 - left), Contact::FREE);
    let mut most = [0.0f64; 3];
    for (k, normal) in flight.normals().iter().enumerate() {
        let course = Course::to(&end, Along::of(&end, normal).speed, &flight, k);
        let began = [T::one(), dot(&normal.direction, &from.state.x)];
        let nudged = |by: f64| course.about(T::of(said + by), began).changed(T::of(-by));
        for found in [course.about(T::of(said), began), nudged(T::STRAIGHT), nudged(-T::STRAIGHT)] {
            let Along { place, speed } = found.along(&flight);
            let pull = found.pull(&flight);
            let exact = [there.state.x, there.state.v, there.accelerations(&flight)]
                .map(|of| dot(&normal.direction, &of));
            let size = there.state.length().widen() + flight.rate.widen();
            for (most, (found, exact)) in most.iter_mut().zip([place, speed, pull].into_iter().zip(exact)) {
                *most = most.max((found - exact).widen().abs() / (T::EPSILON * size));
            }
        }
    }
    most
}

fn of_system<T: Real>(system: &System, left: f64, said: f64) -> [f64; 3] {
    match system.plant().n {
        1 => errors::<T, 1>(system, left, said),
        2 => errors::<T, 2>(system, left, said),
        3 => errors::<T, 3>(system, left, said),
        _ => errors::<T, 4>(system, left, said),
    }
}

fn follows_the_flight<T: Real>(most: [f64; 3]) {
    let paper = Setting::defaults(Family::paper());
    let changed = [("omega", 0.05), ("omega", 9.0), ("mu_k", 0.9999), ("zeta", 0.0), ("zeta", 30.0)];
    let systems = (crate::system::BUILTIN.iter())
        .map(|builtin| Setting::defaults(Family::builtin(builtin.name)))
        .chain(changed.map(|(name, value)| paper.with_named(name, value)));
    for system in systems.map(|setting| System::new(setting).unwrap()) {
        for left in [0.0, 0.07, 0.4, 0.75, 0.98, 1.0] {
            let found = of_system::<T>(&system, left, left);
            let within = found.iter().zip(most).all(|(found, most)| *found < most);
            assert!(within, "{found:?} roundings with {left} left of {:?}", system.setting());
            let wrong = of_system::<T>(&system, left, (left + 0.05).min(0.9));
            assert!(wrong.iter().zip(most).any(|(wrong, most)| *wrong > most), "the check can fail");
        }
    }
}

#[test]
fn the_end_of_a_step_tells_the_way_to_it() {
    follows_the_flight::<f64>([8.0, 16.0, 2048.0]);
    follows_the_flight::<f32>([8.0, 16.0, 256.0]);
}

fn finds_a_place_near_by<T: Real>() {
    let system = System::new(Setting::defaults(Family::paper())).unwrap();
    let (flight, from) = begun::<T, 2>(&system);
    let end = from.flown(&flight, flight.h, Contact::FREE);
    let course = Course::to(&end, Along::of(&end, &flight.normals[0]).speed, &flight, 0);
    let began = [T::one(), dot(&flight.normals[0].direction, &from.state.x)];
    let place = course.about(T::of(0.4), began).along(&flight).place;
    for share in [1.0, 0.1, -0.1, -1.0] {
        let off = T::of(share * T::STRAIGHT);
        let about = course.about(T::of(0.4) + off, began);
        let change = about.change_to(place);
        let missed = (change + off).widen().abs() / T::EPSILON;
        assert!(missed < 8.0, "{missed} roundings for {share}");
        assert!((about.change_to(place * T::of(1.001)) + off).widen().abs() > 64.0 * T::EPSILON);
    }
}

#[test]
fn a_place_near_by_is_found() {
    finds_a_place_near_by::<f64>();
    finds_a_place_near_by::<f32>();
}

#[test]
fn a_narrow_way_is_as_exact_as_it_is_narrow() {
    let setting = Setting::defaults(Family::paper()).with_named("delta", 1e-3);
    let (flight, mut from) = begun::<f32, 2>(&System::new(setting).unwrap());
    from.state.x[0] = -1e-3;
    let end = from.flown(&flight, flight.h, Contact::FREE);
    let course = Course::to(&end, Along::of(&end, &flight.normals[0]).speed, &flight, 0);
    let missed = |began: [f32; 2]| {
        // A share without rounding.
        let after = flight.h / 512.0;
        let there = from.flown(&flight, after, Contact::FREE).state.x[0];
        let u = 1.0 - 1.0 / 512.0;
        (course.about(u, began).along(&flight).place - there).abs()
    };
    let [near, far] = [missed([1.0, from.state.x[0]]), missed([0.0, end.state.x[0]])];
    assert!(near < f32::EPSILON * flight.h / 128.0, "{near}");
    assert!(far > 16.0 * near, "from the other end it is not: {far}");
}
