use super::*;
use crate::dynamics::example::{integrated, pair};
use crate::dynamics::{End, Point};

/// A tiny trajectory of the two masses: from a phase through one impact, which it reaches by itself, to a time.
const PHASE: f64 = 0.4;
const TIME: f64 = 0.2;

/// Where the trajectory is at the end, and the impact on the way; the contact is found by bisection on the integrated flight.
struct Path {
    end: State<f64, 2>,
    contact: f64,
    struck: Saltation<f64, 2>,
}

fn point(state: State<f64, 2>, phase: f64) -> Point<f64, 2> {
    let (sin, cos) = phase.sin_cos();
    Point { state, sin, cos }
}

fn path(flight: &Flight<f64, 2>, start: State<f64, 2>, about: f64) -> Path {
    let normal = &flight.normals[0];
    let place = |s: f64| normal.gap[0] - dot(&normal.direction, &integrated(flight, start, PHASE, s).x);
    // A bracket about the contact that is expected.
    let from = 0.5 * about;
    let contact = from + bisected(|s| place(from + s), about);
    let arrived = integrated(flight, start, PHASE, contact);
    let velocity = dot(&normal.direction, &arrived.v);
    let kick = -(1.0 + normal.restitution[0]) * velocity;
    let after = State { x: arrived.x, v: axpy(kick, &normal.response, &arrived.v) };
    let phase = PHASE + flight.omega * contact;
    let struck = Saltation {
        normal: 0,
        velocity,
        kick,
        before: point(arrived, phase).accelerations(flight),
        after: point(after, phase).accelerations(flight),
        contact: Contact::FREE,
    };
    Path { end: integrated(flight, after, phase, TIME - contact), contact, struck }
}

/// The zero of a function that is positive at 0 and negative at `to`.
fn bisected(function: impl Fn(f64) -> f64, to: f64) -> f64 {
    let (mut low, mut high) = (0.0, to);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if function(middle) > 0.0 { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

/// The state that comes to the stop after `about`, with the speed `speed` against it.
fn start(flight: &Flight<f64, 2>, about: f64, speed: f64) -> State<f64, 2> {
    // On the stop with that speed, and back in time by Newton's method on the integrated flight.
    let normal = &flight.normals[0];
    let x = [0.05, (0.05 - normal.gap[0]) / 0.4];
    let at = State { x, v: [0.3, (0.3 - speed) / 0.4] };
    let mut from = at;
    for _ in 0..40 {
        let reached = integrated(flight, from, PHASE, about);
        from = from.plus(-1.0, &reached).plus(1.0, &at);
    }
    from
}

fn unit(component: usize) -> State<f64, 2> {
    let one = |at: usize| [0, 1].map(|i| if at + i == component { 1.0 } else { 0.0 });
    State { x: one(0), v: one(2) }
}

fn tangent_at_the_end<T: Real>(flight: &Flight<f64, 2>, path: &Path, seed: State<f64, 2>) -> State<f64, 2> {
    let round = |v: [f64; 2]| v.map(T::of);
    let Saltation { velocity, kick, before, after, .. } = path.struck;
    let impact = Saltation {
        normal: 0,
        velocity: T::of(velocity),
        kick: T::of(kick),
        before: round(before),
        after: round(after),
        contact: Contact::FREE,
    };
    let flight = flight.round::<T>();
    let seed = Tangent(seed.map(T::of));
    let carried = seed.flown(&flight, T::of(path.contact), Contact::FREE).struck(&flight, &impact);
    carried.flown(&flight, T::of(TIME - path.contact), Contact::FREE).0.map(Real::widen)
}

/// The same, carried as the deviation of the end: `rest` is the time from the impact to it.
fn tangent_of_the_end<T: Real>(
    flight: &Flight<f64, 2>,
    path: &Path,
    seed: State<f64, 2>,
    rest: f64,
) -> State<f64, 2> {
    let flight = flight.round::<T>();
    let normal = &flight.normals[0];
    let rest = T::of(rest);
    let impact = FreeSaltation {
        velocity: T::of(path.struck.velocity),
        kick: T::of(path.struck.kick),
        pull: dot(&normal.direction, &path.struck.before.map(T::of)),
        wake: normal.wake(rest * flight.inverse_h),
    };
    let ahead = Tangent(seed.map(T::of)).flown(&flight, T::of(TIME), Contact::FREE);
    ahead.struck_ahead(&flight, &normal.look_back(rest * flight.inverse_h), &impact).0.map(Real::widen)
}

fn distance(a: &State<f64, 2>, b: &State<f64, 2>) -> f64 {
    a.plus(-1.0, b).length()
}

#[test]
fn a_deviation_passes_an_impact_like_the_difference_of_two_trajectories() {
    for restitution in [0.0, 0.7, 1.0] {
        let system = pair(restitution);
        let flight = Flight::<f64, 2>::new(&system);
        assert!(TIME < flight.h, "the tangent flies within a step: {}", flight.h);
        for speed in [0.02, 0.3, 2.0] {
            let from = start(&flight, 0.1, speed);
            let middle = path(&flight, from, 0.1);
            assert!((middle.struck.velocity - speed).abs() < 1e-9 && (middle.contact - 0.1).abs() < 1e-9);
            let (mut missed, mut misplaced) = (0.0f64, 0.0f64);
            for component in 0..4 {
                // A slow impact bends the difference more: its time shifts by 1/speed.
                let step = 1e-4 * speed;
                let of = |sign: f64| path(&flight, from.plus(sign * step, &unit(component)), 0.1).end;
                // Differences of the fourth order.
                let near = of(1.0).plus(-1.0, &of(-1.0)).scaled(8.0);
                let difference = near.plus(-1.0, &of(2.0)).plus(1.0, &of(-2.0)).scaled(1.0 / (12.0 * step));
                let found = tangent_at_the_end::<f64>(&flight, &middle, unit(component));
                let size = 1.0 + difference.length();
                let away = distance(&found, &difference);
                assert!(away < 2e-6 * size, "{restitution} {speed} {component}: {found:?} {difference:?}");
                let rounded = tangent_at_the_end::<f32>(&flight, &middle, unit(component));
                assert!(distance(&rounded, &difference) < 2e-5 * size, "{rounded:?}");
                // The deviation of the end, changed by what the impact comes to there, is the same.
                let rest = TIME - middle.contact;
                let ahead = tangent_of_the_end::<f64>(&flight, &middle, unit(component), rest);
                assert!(distance(&ahead, &found) < 1e-13 * size, "{ahead:?} {found:?}");
                let rounded = tangent_of_the_end::<f32>(&flight, &middle, unit(component), rest);
                assert!(distance(&rounded, &difference) < 2e-5 * size, "{rounded:?}");
                let sooner = tangent_of_the_end::<f64>(&flight, &middle, unit(component), 0.9 * rest);
                misplaced = misplaced.max(distance(&sooner, &found) / size);
                // Without what the accelerations differ by, the deviation is another.
                let same = Saltation { after: middle.struck.before, ..middle.struck };
                let without = Path { struck: same, ..path(&flight, from, 0.1) };
                let without = tangent_at_the_end::<f64>(&flight, &without, unit(component));
                missed = missed.max(distance(&without, &difference) / size);
            }
            assert!(missed > 1e-4 && misplaced > 1e-4, "the checks can fail: {missed} {misplaced}");
        }
    }
}

/// The volume of deviations shrinks by r² in an impact, and by exp(−t tr M⁻¹C) in flight.
#[test]
fn an_impact_takes_the_square_of_its_restitution_from_volumes() {
    for restitution in [0.3, 0.7, 1.0] {
        let system = pair(restitution);
        let flight = Flight::<f64, 2>::new(&system);
        let middle = path(&flight, start(&flight, 0.1, 0.3), 0.1);
        let columns = [0, 1, 2, 3].map(|k| {
            let State { x, v } = tangent_at_the_end::<f64>(&flight, &middle, unit(k));
            [x[0], x[1], v[0], v[1]]
        });
        let volume = nalgebra::Matrix4::from_fn(|i, j| columns[j][i]).determinant();
        let expected = restitution * restitution * (-TIME * system.contraction()).exp();
        assert!((volume / expected - 1.0).abs() < 1e-8, "{volume} for {expected}");
    }
}

/// In contact a deviation has no part along the normal, and flies as the difference of two trajectories that stick.
fn sticks<T: Real>() {
    let flight = Flight::<f64, 2>::new(&pair(0.7)).round::<T>();
    let contact = Contact::FREE.with(End { normal: 0, side: 0 });
    let direction = &flight.normals[0].direction;
    let none = |vector: &[T; 2]| dot(direction, vector).abs() < T::of(8.0) * T::epsilon();
    let seed = Tangent(State { x: [0.8, -0.3].map(T::of), v: [-0.5, 0.9].map(T::of) });
    assert!(!none(&seed.0.x) && !none(&seed.0.v));
    let caught = seed.caught(&flight, contact);
    assert!(none(&caught.0.x) && none(&caught.0.v), "{caught:?}");
    let time = T::of(0.15);
    let flown = caught.flown(&flight, time, contact);
    assert!(none(&flown.0.x) && none(&flown.0.v), "{flown:?}");
    let on = |sign: f64| {
        let along = |part: &[T; 2]| axpy(T::of(sign), part, &[T::zero(); 2]);
        let state = State { x: along(&caught.0.x), v: along(&caught.0.v) };
        Point::at_phase_zero(state).flown(&flight, time, contact).state
    };
    let difference = on(1.0).plus(-T::one(), &on(-1.0)).scaled(T::of(0.5));
    let away = difference.plus(-T::one(), &flown.0).length();
    assert!(away < T::of(16.0) * T::epsilon(), "{away:?}");
}

#[test]
fn a_deviation_in_contact_has_no_part_along_the_normal() {
    sticks::<f64>();
    sticks::<f32>();
}

#[test]
fn a_deviation_flies_back_to_where_it_was() {
    fn returns<T: Real>() {
        let flight = Flight::<f64, 2>::new(&pair(0.7)).round::<T>();
        let seed = Tangent(State { x: [0.8, -0.3].map(T::of), v: [-0.5, 0.9].map(T::of) });
        for time in [1e-3, 0.1, 1.0].map(|share| T::of(share) * flight.h) {
            let there = seed.flown(&flight, time, Contact::FREE);
            let back = there.flown(&flight, -time, Contact::FREE);
            let away = back.0.plus(-T::one(), &seed.0).length();
            assert!(away < T::of(16.0) * T::epsilon(), "{away:?}");
            let half = there.flown(&flight, -(time * T::of(0.5)), Contact::FREE);
            assert!(half.0.plus(-T::one(), &seed.0).length() > T::of(1e-4), "the check can fail");
        }
    }
    returns::<f64>();
    returns::<f32>();
}
