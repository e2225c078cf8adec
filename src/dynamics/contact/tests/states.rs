//! What holds a mass on a stop, and the safe time of a state.

use super::super::*;
use crate::dynamics::example::{first_below, single};

fn pressing<T: Real>() {
    let time = |force: f64, slope: f64, bound: f64, window: f64| {
        pressed_time(T::of(force), T::of(slope), T::of(bound), T::of(window)).widen()
    };
    // A force that falls steadily is 0 exactly at the end of the window, or before.
    assert_eq!(time(0.5, -1.0, 0.0, 0.5), 0.5);
    assert_eq!(time(0.5, -1.0, 0.0, 4.0), 0.5);
    // At 0 already: it lasts only where it grows.
    assert_eq!(time(0.0, -1.0, 0.0, 1.0), 0.0);
    assert_eq!(time(0.0, 0.0, 1.0, 1.0), 0.0);
    assert_eq!(time(-1e-3, -1.0, 1.0, 1.0), 0.0);
    for force in [0.0, 1e-3, 0.2, 1.0] {
        for slope in [-1.0, -1e-3, 0.0, 0.3] {
            for bound in [1e-3, 0.5, 4.0] {
                let found = time(force, slope, bound, 1.0);
                let least = |s: f64| force + s * (slope - 0.5 * bound * s);
                let lasts = first_below(least, 1.0).unwrap_or(1.0);
                assert!(
                    found
                        <= lasts
                            + 32.0 * T::EPSILON.sqrt() * f64::from(u8::from(force < 1e-2))
                            + 1e-3 * lasts
                );
                assert!(found >= lasts - 1e-3, "{force} {slope} {bound}: {found} for {lasts}");
            }
        }
    }
}

#[test]
fn a_pressing_force_lasts_until_the_parabola_below_it_is_zero() {
    pressing::<f64>();
    pressing::<f32>();
}

/// A swing x = ½ sin t from one stop's side to the other, whose amplitude is a share of the gap.
fn swings<T: Real>() {
    let system = single(|_| {});
    let flight = Flight::<f64, 1>::new(&system).round::<T>();
    for (v, contact) in [(1.0, Some(0.5f64.asin())), (-1.0, Some(0.5f64.asin())), (0.499, None), (0.0, None)]
    {
        let state = State { x: [T::zero()], v: [T::of(v)] };
        let mut point = Point::at_phase_zero(state);
        let (mut at, mut rounds) = (0.0, 0);
        while at < 1.5 && rounds < 200 {
            let window = flight.h.min(T::of(1.5 - at));
            let motion = point.motion(&flight, Contact::FREE);
            let time = safe_time(&flight, &point, &motion, Contact::FREE, window);
            if time.widen() < 4.0 * T::EPSILON {
                break;
            }
            point = point.flown(&flight, time, Contact::FREE);
            at += time.widen();
            rounds += 1;
        }
        match contact {
            Some(contact) => assert!((at - contact).abs() < 64.0 * T::EPSILON, "{v}: {at} for {contact}"),
            None => assert!(at >= 1.5 - T::EPSILON * 4.0, "{v}: {at}"),
        }
    }
    // Nothing ends the safe time where both ends are ignored.
    let both = Contact::FREE.with(End { normal: 0, side: 0 }).with_opposite_ends();
    let point = Point::at_phase_zero(State { x: [T::of(0.5)], v: [T::one()] });
    let motion = point.motion(&flight, Contact::FREE);
    assert_eq!(safe_time(&flight, &point, &motion, both, flight.h), flight.h);
    assert_eq!(safe_time(&flight, &point, &motion, Contact::FREE, flight.h), T::zero());
}

#[test]
fn a_swing_comes_safely_to_the_stop_that_it_meets() {
    swings::<f64>();
    swings::<f32>();
}
