use super::*;
use crate::dynamics::example::first_below;
use crate::model::Real;

/// A gap by its coefficients in s, up to the fifth degree.
struct Gap([f64; 6]);

impl Gap {
    fn at(&self, s: f64) -> f64 {
        self.0.iter().rev().fold(0.0, |sum, c| sum * s + c)
    }

    /// Its m-th derivative.
    fn derivative(&self, m: usize, s: f64) -> f64 {
        let weight = |k: usize| (k + 1 - m..=k).map(|j| j as f64).product::<f64>();
        (m..6).rev().fold(0.0, |sum, k| sum * s + weight(k) * self.0[k])
    }

    /// The speed with which it closes.
    fn speed(&self, s: f64) -> f64 {
        -self.derivative(1, s)
    }

    /// The polynomial in the share of a window that is left, by what is known at both ends of it.
    fn seen_from_the_end<T: Real>(&self, window: f64) -> Quintic<T> {
        let ends = |m: usize, weight: f64| [window, 0.0].map(|s| T::of(weight * self.derivative(m, s)));
        let [bend, _] = ends(2, window.powi(2) / 2.0);
        let [twist, _] = ends(3, -window.powi(3) / 6.0);
        Quintic::through(ends(0, 1.0), ends(1, -window), [bend, twist])
    }

    /// The root in a window, as a time, at a precision.
    fn root<T: Real>(&self, window: f64) -> f64 {
        let gaps = [T::of(self.at(0.0)), T::of(self.at(window))];
        let start = Quintic::chord(gaps, T::of(self.speed(0.0) * window));
        (1.0 - self.seen_from_the_end::<T>(window).root(T::one() - start).widen()) * window
    }
}

#[test]
fn the_root_of_a_fall_and_of_a_hop() {
    // A polynomial of fifth degree is its own interpolant.
    let fall = Gap([0.3, -0.5, -0.7, 0.1, 0.0, -0.04]);
    let w = 0.9;
    let root = fall.root::<f64>(w);
    assert!(fall.at(root).abs() < 1e-14 && root > 0.0 && root < w, "{root}");
    // The motion leaves the stop and returns: the root sought is not the one at 0.
    let hop = Gap([0.0, 0.2, -0.6, 0.0, 0.0, 0.0]);
    let root = hop.root::<f64>(w);
    assert!((root - 1.0 / 3.0).abs() < 1e-14, "{root}");
}

fn edges<T: Real>() {
    let near = |found: f64, expected: f64| (found - expected).abs() < 32.0 * T::EPSILON;
    // A straight way, without acceleration.
    assert!(near(Gap([0.25, -0.5, 0.0, 0.0, 0.0, 0.0]).root::<T>(1.0), 0.5));
    // From rest, by the acceleration alone.
    assert!(near(Gap([0.125, 0.0, -0.5, 0.0, 0.0, 0.0]).root::<T>(1.0), 0.5));
    // Met exactly at the end of the window.
    assert!(near(Gap([0.5, -0.25, -0.25, 0.0, 0.0, 0.0]).root::<T>(1.0), 1.0));
    // No gap: a hop off the stop that returns at its end.
    assert!(near(Gap([0.0, 1.0, -2.0, 0.0, 0.0, 0.0]).root::<T>(1.0), 0.5));
    // No gap, and on the way into the stop.
    assert!(near(Gap([0.0, -1.0, -0.5, 0.0, 0.0, 0.0]).root::<T>(1.0), 0.0));
    assert!(!near(Gap([0.01, -1.0, -0.5, 0.0, 0.0, 0.0]).root::<T>(1.0), 0.0), "the check can fail");
}

#[test]
fn the_root_at_the_edges_is_that_of_the_closed_form() {
    edges::<f64>();
    edges::<f32>();
}

/// Ways that end beyond the stop and cross it once: within a twentieth of the window of the contact, three of Newton's steps
/// end in rounding.
fn crossed<T: Real>() {
    let mut met = 0;
    for gap in [0.01, 0.2, 0.45] {
        for speed in [0.2, 0.6, 1.0] {
            for bend in [-0.2, 0.0, 0.2] {
                for jerk in [-0.05, 0.0, 0.05] {
                    let way = Gap([gap, -speed, -bend, -jerk, 0.01, -0.005]);
                    let Some(contact) = first_below(|s| way.at(s), 1.0) else { continue };
                    if way.at(1.0) >= 0.0 || way.speed(contact) < 0.1 {
                        continue;
                    }
                    let root = way.root::<T>(1.0);
                    let allowed = 32.0 * T::EPSILON / way.speed(contact);
                    assert!((root - contact).abs() < allowed.max(1e-9), "{:?}: {root} for {contact}", way.0);
                    met += 1;
                }
            }
        }
    }
    assert!(met > 40, "contacts are met: {met}");
}

#[test]
fn three_steps_of_newton_find_the_contact_of_a_step() {
    crossed::<f64>();
    crossed::<f32>();
}

#[test]
fn a_gap_is_narrowest_where_its_derivative_is_zero() {
    let way = |gap: f64| Gap([gap, -0.5, 0.4, 0.15, -0.06, 0.01]);
    let narrowest = |gap: f64| {
        let way = way(gap);
        way.seen_from_the_end::<f64>(1.0).narrowest(way.speed(0.0))
    };
    let found = narrowest(0.2);
    let s = 1.0 - found.u;
    assert!(s > 0.3 && s < 0.7 && way(0.2).speed(s).abs() < 1e-9, "{found:?}");
    let bend = way(0.2).derivative(2, s);
    assert!((found.gap - way(0.2).at(s)).abs() < 1e-15 && (found.bend - bend).abs() < 1e-6);
    // A gap that is closed there closes before, about where the parabola does.
    for depth in [1e-12, 1e-6, 1e-3, 1e-2] {
        let way = way(0.2 - found.gap - depth);
        let seen = way.seen_from_the_end::<f64>(1.0);
        let start = seen.narrowest(way.speed(0.0)).touch();
        assert!(start > found.u && way.at(1.0 - start).abs() < 0.2 * depth, "{depth}: {start}");
        let root = seen.root(start);
        assert!(way.at(1.0 - root).abs() < 1e-15 && root > found.u, "{depth}: {root}");
    }
    assert_eq!(narrowest(0.3).touch(), narrowest(0.3).u, "one that stays open does not");
}

#[test]
fn a_gap_without_an_extremum_is_looked_at_beside_its_narrower_end() {
    for (way, aside) in [
        (Gap([0.4, -0.3, -0.02, 0.01, 0.0, 0.0]), ASIDE),
        (Gap([0.1, 0.3, 0.02, -0.01, 0.0, 0.0]), 1.0 - ASIDE),
    ] {
        let found = way.seen_from_the_end::<f64>(1.0).narrowest(-way.derivative(1, 0.0));
        assert_eq!(found.u, aside);
        assert!((found.gap - way.at(1.0 - aside)).abs() < 1e-15, "{found:?}");
    }
}

#[test]
fn the_cubic_has_the_places_and_slopes_of_both_ends() {
    for (places, slopes, window) in [([1.0, -0.5], [-2.0, -1.0], 0.5), ([0.2, 0.3], [1.0, -4.0], 2.0)] {
        let found = Quintic::cubic(places, slopes, window);
        let slope = |u: f64| (cubic(found.rise(), u) * u + found.0[1]) / window;
        let away = [
            found.at(0.0) - places[0],
            found.at(1.0) - places[1],
            slope(0.0) - slopes[0],
            slope(1.0) - slopes[1],
        ];
        assert!(away.iter().all(|away| away.abs() < 1e-14), "{away:?}");
        assert_eq!(found.0[4..], [0.0, 0.0]);
    }
}
