//! What counts as a return, and what goes by unseen.

use super::*;

/// As many strobes as nothing can happen at, by trying one after the other.
fn tried(since: u32, periods: u32, max_period: u32) -> u32 {
    (0..).find(|k| since + k + 1 >= patience(periods + k + 1, max_period)).unwrap()
}

#[test]
fn strobes_are_unseen_until_the_anchor_moves() {
    let flight = Flight::<f64, 1>::blank(1, 0.0);
    let mut most = 0;
    for max_period in [0, 1, 2, 7, 32, 100] {
        for periods in 0..500 {
            for since in (0..40).filter(|&since| since <= periods) {
                let waiting = Recurrence { since, ..Recurrence::anchored(State::zero()) };
                let unseen = waiting.unseen(&flight, periods, max_period).strobes;
                assert_eq!(unseen, tried(since, periods, max_period));
                let returned = Recurrence { n: 1, ..waiting };
                assert_eq!(returned.unseen(&flight, periods, max_period).strobes, 0);
                most = most.max(unseen);
            }
        }
    }
    assert_eq!(most, 99);
}

#[test]
fn what_is_unseen_is_farther_than_a_return() {
    // Large, small, and small where all is.
    for (place, unit) in [(-20.0, 1.0), (-0.2, 1.0), (-2e-6, 1e-6), (-2e-8, 1e-6)] {
        let flight = Flight { unit, ..Flight::blank(1, 0.0) };
        let anchor = State { x: [place], v: [0.1 * place] };
        let nearest = Recurrence::anchored(anchor).unseen(&flight, 100, 32).nearest;
        let away = distance(&flight, &State { v: [0.1 * place + nearest], ..anchor }, &anchor);
        assert!(away > f64::RETURNING && away < 1.01 * f64::RETURNING, "{away} at {place}");
    }
}

/// The N that is found of strobes that go round `places`, with so many impacts before each, and for how many periods it has held by
/// the end.
fn found<T: Real>(places: &[f64], impacts: &[u32], tolerance: f64) -> (u32, u32) {
    let flight = Flight { unit: T::one(), ..Flight::<T, 1>::blank(1, T::zero()) };
    let at = |k: usize| State { x: [T::of(places[k % places.len()])], v: [T::one()] };
    let mut recurrence = Recurrence::anchored(at(0));
    for k in 1..=96 {
        recurrence.count_finite(Stop(0), impacts[k % impacts.len()]);
        let point = Point { state: at(k), sin: T::zero(), cos: T::one() };
        recurrence.at_strobe(&flight, &point, T::of(tolerance), 32, false);
    }
    (recurrence.n, recurrence.since)
}

fn finds_alternations<T: Real>() {
    // Smaller than the tolerance and larger by turns, as a strobe after the next may be nearer or farther.
    let wobble = [0.0, 0.6e-4, 1.7e-4, 1.1e-4];
    let scaled = |size: f64| wobble.map(|place| 0.5 + size * place);
    for (size, tolerance) in [(1.0, 1e-4), (0.7, 1e-4), (40.0, 1e-4), (0.3, 4e-5)] {
        let (n, since) = found::<T>(&scaled(size), &[5], tolerance);
        assert!(n == 4 && since >= 64, "{n} for {since} periods of an alternation of {size}");
    }
    // Far smaller, but with other impacts.
    for size in [0.1, 0.02] {
        let (n, since) = found::<T>(&scaled(size), &[37, 37, 38, 38], 1e-4);
        assert!(n == 4 && since >= 64, "{n} for {since} periods of an alternation of {size}");
        assert_eq!(found::<T>(&scaled(size), &[5], 1e-4).0, 1, "nothing else tells it from one period");
    }
}

#[test]
fn small_alternations_are_found_that_lead_astray() {
    finds_alternations::<f64>();
    finds_alternations::<f32>();
}

#[test]
fn after_a_search_in_vain_any_return_counts_again() {
    let flight = Flight { unit: 1.0, ..Flight::<f64, 1>::blank(1, 0.0) };
    let point = |x: f64| Point { state: State { x: [x], v: [1.0] }, sin: 0.0, cos: 1.0 };
    let mut recurrence = Recurrence::anchored(point(0.0).state);
    let mut see = |x: f64| {
        recurrence.at_strobe(&flight, &point(x), 1e-4, 8, false);
        recurrence
    };
    assert_eq!(see(1e-5).n, 1);
    assert_eq!((see(0.5).n, see(0.5 + 2e-5).n), (0, 0), "farther than the return that led astray");
    (0..7).for_each(|k| assert_eq!(see(0.6 + 0.1 * f64::from(k)).n, 0));
    assert_eq!(see(1.2 + 2e-5).n, 1);
    assert_eq!((see(0.1).n, see(0.1 + 1e-5).n), (0, 1), "nearer");
}
