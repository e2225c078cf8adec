use super::*;
use crate::dynamics::placing::rested;
use crate::dynamics::{Contact, End, Point};
use crate::model::{Flight, Setting, State, System};
use crate::system::Family;

/// What presses by a force a + b cos(t − φ), from a time on.
fn pressed<T: Real>([steady, swing, phase]: [f64; 3], begins: f64, time: f64) -> Pressed<T> {
    let ends = [begins, begins + time].map(|t| t - phase);
    Pressed {
        forces: ends.map(|t| T::of(steady + swing * t.cos())),
        slopes: ends.map(|t| T::of(-swing * t.sin())),
        bound: T::of(swing.abs()),
        time: T::of(time),
    }
}

/// The least of the force, looked at densely.
fn least([steady, swing, phase]: [f64; 3], begins: f64, time: f64) -> f64 {
    let at = |i: u32| begins + time * f64::from(i) / 4096.0;
    (0..=4096).map(|i| steady + swing * (at(i) - phase).cos()).fold(f64::INFINITY, f64::min)
}

fn looked_at<T: Real>() {
    let (mut lasting, mut missed, mut open) = (0, 0, 0);
    for steady in [-0.5, 0.0, 0.3, 0.99, 1.01, 1.5] {
        for phase in 0..64 {
            for time in [0.01, 0.2, 0.6, 1.0] {
                let force = [steady, 1.0, 0.1 * f64::from(phase)];
                if force[0] + force[2].cos() < 0.0 {
                    // It does not press at the beginning.
                    continue;
                }
                let found = pressed::<T>(force, 0.0, time);
                let least = least(force, 0.0, time);
                // Forces are known but for their rounding.
                let rounding = 16.0 * T::EPSILON;
                match found.lasts(T::zero()) {
                    true => {
                        assert!(least > -rounding, "{force:?} {time}: {least}");
                        lasting += 1;
                    }
                    false if least > 0.0 => missed += 1,
                    false => open += 1,
                }
            }
        }
    }
    // Almost nothing that lasts is missed, and what does not last is found out.
    println!("{lasting} last, {missed} more do unseen, {open} do not");
    assert!(lasting > 50 * missed && missed > 0 && lasting > 400 && open > 50, "{lasting} {missed} {open}");
}

#[test]
fn what_surely_presses_to_the_end_never_lets_go_before() {
    looked_at::<f64>();
    looked_at::<f32>();
}

fn found<T: Real>() {
    // cos(t − φ) falls to 0 at φ + π/2.
    for (opens, time) in [(0.05, 1.0), (0.3, 1.0), (0.5, 0.6), (0.9, 1.0), (0.02, 0.03)] {
        let force = [0.0, 1.0, opens - 0.5 * std::f64::consts::PI];
        let first = pressed::<T>(force, 0.0, time);
        assert!(!first.lasts(T::zero()));
        let once = first.vanishes().widen();
        assert!((once - opens).abs() < 4e-3 * time * time, "{opens} of {time}: {once}");
        // From both ends of a flight that ends near by it is found as if it were a root of the cubic.
        for beside in [1e-3, -1e-3] {
            let near = opens + beside * time;
            let twice = pressed::<T>(force, 0.0, near).vanishes().widen();
            assert!((twice - opens).abs() < 1e-6 * time + 8.0 * T::EPSILON, "{opens} of {time}: {twice}");
        }
    }
    let grows = Pressed { forces: [1.0, 1.0], slopes: [-1.0, 1.0], bound: 8.0, time: 1.0 };
    assert_eq!(grows.vanishes(), FAR);
}

#[test]
fn a_contact_opens_where_the_cubic_through_both_ends_says() {
    found::<f64>();
    found::<f32>();
}

#[test]
fn a_flight_may_end_a_little_after_the_force_vanished() {
    let after = |late: f64| pressed::<f64>([0.0, 1.0, -0.5 * std::f64::consts::PI + 0.5], 0.0, 0.5 + late);
    assert!(after(1e-9).lasts(1.001e-9));
    assert!(!after(1e-9).lasts(0.9e-9));
    assert!(!after(1e-3).lasts(1e-9));
}

#[test]
fn the_next_flight_is_longer_than_what_is_sure_and_ends_within_the_last() {
    // Nobody knows where it vanishes, or whether it presses before the end: it may be anywhere in between.
    let away = Pressed { forces: [1.0, -1.0], slopes: [f64::NAN, -1.0], bound: 1.0, time: 1.0 };
    assert_eq!([0.0625, 0.25].map(|sure| away.next(sure, 0.0)), [(0.25, false), (0.5, false)]);
    let dips = Pressed { forces: [1.0, 0.0], slopes: [-1.0, 1.0], bound: 200.0, time: 1.0 };
    assert_eq!([0.0625, 0.25].map(|sure| dips.next(sure, 0.0)), [(0.25, false), (0.5, false)]);
    // It presses between both ends as far as these say, and only the bound says otherwise: it is tried for as long as that allows.
    let steady = Pressed { forces: [1.0, 1.0], slopes: [0.0, 0.0], bound: 1e4, time: 1.0 };
    let (next, lasts) = steady.next(0.1, 0.0);
    assert!(!lasts && next > 0.3 && next < 0.4, "{next}");
    assert!(Pressed { time: next, ..steady }.lasts(0.0), "it is seen to last");
    assert!(!Pressed { time: 1.05 * next, ..steady }.lasts(0.0), "hardly longer would not be");
    assert_eq!([0.0625, 0.25, 0.5625].map(|sure| steady.next(sure, 0.0).0), [next, next, 0.75]);
    // It lasts, and falls steadily until later.
    let falls = Pressed { forces: [1.0, 0.5], slopes: [-0.5, -0.5], bound: 0.0, time: 1.0 };
    assert_eq!(falls.next(0.25, 0.0), (2.0, true));
    let opens = Pressed { forces: [1.0, -1.0], slopes: [-2.0, -2.0], bound: 0.0, time: 1.0 };
    assert_eq!(opens.next(0.25, 0.0), (0.5, false));
    assert_eq!(opens.next(0.5625, 0.0), (0.75, false), "before what is sure it does not vanish");
}

/// The largest |p''''| of what presses on the stop of the first normal, by differences of its derivative, as a share of the bound.
fn share_of_bound(omega: f64, state: State<f64, 2>) -> f64 {
    let setting = Setting::defaults(Family::paper()).with_named("omega", omega).with_named("delta", 0.1);
    let flight = Flight::<f64, 2>::new(&System::new(setting).unwrap());
    let end = End { normal: 0, side: 0 };
    let contact = Contact::FREE.with(end);
    let (sin, cos) = 0.4f64.sin_cos();
    let point = Point { state: rested(&flight, &state, contact), sin, cos };
    let bound = point.motion(&flight, contact).pressed_bound(&flight, contact, 0);
    let d = flight.h / 16.0;
    let slope = |k: u32| {
        let there = point.flown(&flight, f64::from(k) * d, contact);
        there.motion(&flight, contact).pressure(end)[1]
    };
    let fourth = |k: u32| (slope(k + 3) - 3.0 * slope(k + 2) + 3.0 * slope(k + 1) - slope(k)) / (d * d * d);
    (0..=13).map(|k| (fourth(k) / bound).abs()).fold(0.0, f64::max)
}

#[test]
fn the_fourth_derivative_of_what_presses_is_bounded() {
    let still = State { x: [0.1, 0.0], v: [0.0, 0.0] };
    // The forcing alone, fast; and mostly what the masses do of themselves.
    for (omega, state) in
        [(6.0, still), (0.1, State { x: [0.1, 40.0], ..still }), (0.1, State { v: [0.0, 40.0], ..still })]
    {
        let share = share_of_bound(omega, state);
        assert!(share < 1.001, "{omega} {state:?}: {share}");
        assert!(share > 0.1, "nothing of the bound can be left out: {omega} {state:?}: {share}");
    }
}
