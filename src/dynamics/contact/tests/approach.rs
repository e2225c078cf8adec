//! The safe time of single motions whose derivatives are given.

use super::super::*;
use crate::dynamics::example::first_below;

/// A motion towards a stop whose fourth derivative is constant: the gap to it, and what closes it.
#[derive(Clone, Copy, Debug)]
struct Course {
    gap: f64,
    speed: f64,
    acceleration: f64,
    jerk: f64,
    fourth: f64,
}

impl Course {
    /// Without a fourth derivative.
    fn of(gap: f64, speed: f64, acceleration: f64, jerk: f64) -> Self {
        Course { gap, speed, acceleration, jerk, fourth: 0.0 }
    }

    /// The gap a time later.
    fn gap_at(&self, s: f64) -> f64 {
        let Course { gap, speed, acceleration, jerk, fourth } = *self;
        gap - s * (speed + s / 2.0 * (acceleration + s / 3.0 * (jerk + s / 4.0 * fourth)))
    }

    /// The course as it is seen a time later.
    fn later(&self, s: f64) -> Self {
        let Course { speed, acceleration, jerk, fourth, .. } = *self;
        Course {
            gap: self.gap_at(s),
            speed: speed + s * (acceleration + s / 2.0 * (jerk + s / 3.0 * fourth)),
            acceleration: acceleration + s * (jerk + s / 2.0 * fourth),
            jerk: jerk + s * fourth,
            fourth,
        }
    }

    /// The engine's safe time within a window; every number is rounded to the precision first.
    fn safe<T: Real>(&self, window: f64) -> f64 {
        let Course { gap, speed, acceleration, jerk, fourth } = *self;
        let towards =
            Approach { acceleration: T::of(acceleration), jerk: T::of(jerk), bound: T::of(fourth.abs()) };
        safe_from_stop(T::of(gap), T::of(speed), &towards, T::one(), T::of(window)).widen()
    }

    /// Where repeated safe times lead within a window, and how many it took: they end where one is short beside the window.
    fn approached<T: Real>(&self, window: f64) -> (f64, u32) {
        let mut at = 0.0;
        for count in 1..200 {
            let time = self.later(at).safe::<T>(window - at);
            at += time;
            if at >= window || time < 4.0 * T::EPSILON * window {
                return (at, count);
            }
        }
        (at, 200)
    }
}

/// Numbers of both signs and 0, small and large.
const VALUES: [f64; 7] = [-2.0, -0.3, -1e-3, 0.0, 1e-3, 0.3, 2.0];

/// Courses of all kinds, none of which is in contact at first.
fn courses() -> impl Iterator<Item = Course> {
    let four = |k: usize| [VALUES[k % 7], VALUES[k / 7 % 7], VALUES[k / 49 % 7], VALUES[k / 343 % 7]];
    (0..7 * 7 * 7 * 7).flat_map(move |k| {
        let [speed, acceleration, jerk, fourth] = four(k);
        [1e-6, 0.01, 0.5].map(|gap| Course { gap, speed, acceleration, jerk, fourth })
    })
}

/// How far beyond a contact a time may be for rounding, where nothing grazes.
fn rounding<T: Real>(contact: f64) -> f64 {
    16.0 * T::EPSILON * (1.0 + contact)
}

fn never_beyond<T: Real>() {
    let (mut met, mut sharp) = (0, 0);
    for course in courses() {
        let safe = course.safe::<T>(1.0);
        assert!((0.0..=1.0).contains(&safe), "{course:?}: {safe}");
        let Some(contact) = first_below(|s| course.gap_at(s), 1.0) else { continue };
        // Where the gap closes at a crawl, rounding moves the contact.
        let steep = course.later(contact).speed.abs().max(1e-4);
        let may = rounding::<T>(contact) / steep;
        assert!(safe <= contact + may, "{course:?}: {safe} beyond {contact}");
        met += 1;
        sharp += u32::from(safe * 1.05 > contact + may);
    }
    assert!(met > 3000, "contacts are met: {met}");
    assert!(sharp > 300, "a time longer by a twentieth would not pass: {sharp}");
}

#[test]
fn the_safe_time_is_never_beyond_the_first_contact() {
    never_beyond::<f64>();
    never_beyond::<f32>();
}

#[test]
fn safe_times_repeated_lead_to_the_contact_or_to_the_end_of_the_window() {
    let mut ends = 0;
    for course in courses() {
        let (at, count) = course.approached::<f64>(1.0);
        match first_below(|s| course.gap_at(s), 1.0) {
            Some(contact) => {
                let speed = course.later(contact).speed;
                if speed > 1e-3 {
                    assert!((at - contact).abs() < 1e-9, "{course:?}: {at} for {contact}");
                    assert!(count < 40, "{course:?}: {count}");
                }
            }
            None => {
                assert!(at >= 1.0, "{course:?}: {at} after {count}");
                ends += 1;
            }
        }
    }
    assert!(ends > 1000, "windows are passed: {ends}");
}

/// A stop that is just not touched, touched, and just met: speed 1 against an acceleration of −1, which turns it at s = 1.
fn grazes<T: Real>() {
    let course = |gap: f64| Course::of(gap, 1.0, -1.0, 0.0);
    let little = 64.0 * T::EPSILON;
    let (window, touch) = (1.75, 1.0);
    assert_eq!(course(0.5 * (1.0 + little)).safe::<T>(window), window, "it is passed at once");
    // The parabola and the gap touch each other, and every number is exact: it comes closer.
    let first = course(0.5).safe::<T>(window);
    assert!(first > 0.5 && first < touch, "{first}");
    assert_eq!(course(0.5).later(0.5).safe::<T>(0.5), 0.5, "the touch at the end of a window is not passed");
    let (at, _) = course(0.5).approached::<T>(window);
    assert!(
        at >= window || (at - touch).abs() < 64.0 * T::EPSILON.sqrt(),
        "it ends there or comes to nothing: {at}"
    );
    let deep = T::EPSILON.sqrt();
    let contact = 1.0 - deep.sqrt();
    let (at, _) = course(0.5 * (1.0 - deep)).approached::<T>(window);
    assert!(
        (at - contact).abs() < 1e-3 * deep.sqrt() + 8.0 * deep,
        "the first of two roots: {at} for {contact}"
    );
    assert!((at - (2.0 - contact)).abs() > deep.sqrt(), "and not the second");
}

#[test]
fn a_tangential_touch_is_told_from_a_contact() {
    grazes::<f64>();
    grazes::<f32>();
}

fn from_rest<T: Real>() {
    let near = |found: f64, expected: f64| (found - expected).abs() < 8.0 * T::EPSILON * expected;
    // Zero speed: the acceleration alone closes the gap, ½ a s² = gap.
    assert!(near(Course::of(0.125, 0.0, 4.0, 0.0).safe::<T>(1.0), 0.25));
    assert!(!near(Course::of(0.125, 0.0, 3.9, 0.0).safe::<T>(1.0), 0.25), "the check can fail");
    // The jerk alone, j s³/6 = gap: no single quadratic, but their sequence.
    let (at, _) = Course::of(0.125, 0.0, 0.0, 6.0).approached::<T>(1.0);
    assert!((at - 0.5).abs() < 1e-4 && at <= 0.5 + 8.0 * T::EPSILON, "{at}");
    // Nothing at all, or only what opens the gap.
    for course in [
        Course::of(0.125, 0.0, 0.0, 0.0),
        Course::of(0.125, 0.0, -1.0, 0.0),
        Course::of(0.125, -1.0, 0.0, -1.0),
    ] {
        assert_eq!(course.safe::<T>(1.0), 1.0, "{course:?}");
    }
}

#[test]
fn from_rest_the_acceleration_or_the_jerk_alone_closes_the_gap() {
    from_rest::<f64>();
    from_rest::<f32>();
}

fn at_the_stop<T: Real>() {
    // No gap: nothing is safe towards the stop, whether by speed, acceleration or jerk; a gap below 0 by rounding is none.
    for gap in [0.0, -T::EPSILON] {
        for course in
            [Course::of(gap, 1.0, 0.0, 0.0), Course::of(gap, 0.0, 1.0, 0.0), Course::of(gap, 0.0, 0.0, 1.0)]
        {
            assert_eq!(course.safe::<T>(1.0), 0.0, "{course:?}");
        }
    }
    // A hop from the stop, against a force that presses back, lasts 2u/a.
    let hop = Course::of(0.0, -0.5, 2.0, 0.0);
    let (at, _) = hop.approached::<T>(1.0);
    assert!((at - 0.5).abs() < 8.0 * T::EPSILON, "{at}");
    assert!(hop.safe::<T>(1.0) > 0.25, "and is not taken for the contact at its beginning");
    // Pulled off with a jerk that presses: the acceleration −1 + 6s changes its sign at 1/6, and ½ s² = s³ at ½.
    let (at, _) = Course::of(0.0, 0.0, -1.0, 6.0).approached::<T>(1.0);
    assert!((at - 0.5).abs() < 1e-4, "{at}");
}

#[test]
fn on_the_stop_only_what_leaves_it_is_safe() {
    at_the_stop::<f64>();
    at_the_stop::<f32>();
}

fn to_the_end<T: Real>() {
    // Met exactly at the end of the window, and a little before it.
    let straight = Course::of(0.5, 1.0, 0.0, 0.0);
    let falling = Course::of(0.5, 0.0, 1.0, 0.0);
    for (course, contact) in [(straight, 0.5), (falling, 1.0)] {
        assert_eq!(course.safe::<T>(contact), contact, "{course:?}");
        let longer = contact * (1.0 + 8.0 * T::EPSILON);
        assert!(course.approached::<T>(longer).0 <= contact * (1.0 + 4.0 * T::EPSILON), "{course:?}");
        assert_eq!(course.safe::<T>(0.5 * contact), 0.5 * contact, "{course:?}");
    }
}

#[test]
fn a_window_that_ends_at_the_contact_is_safe_to_its_end() {
    to_the_end::<f64>();
    to_the_end::<f32>();
}

/// The time for which acceleration + jerk·s + bound·s² stays below 0.
#[test]
fn a_pull_off_the_stop_lasts_until_its_quadratic_changes_sign() {
    for acceleration in [-2.0, -1e-3, 0.0, 0.4] {
        for jerk in [-1.0, -1e-6, 0.0, 1e-6, 3.0] {
            for bound in [1e-6, 0.7] {
                let found = pulled_off_time(acceleration, jerk, bound);
                let value = |s: f64| -(acceleration + jerk * s + bound * s * s);
                if acceleration > 0.0 || (acceleration == 0.0 && jerk >= 0.0) {
                    assert_eq!(found, 0.0);
                    continue;
                }
                let scale = acceleration.abs() + (jerk * found).abs() + bound * found * found;
                assert!(value(found).abs() < 1e-14 * scale, "{acceleration} {jerk} {bound}: {found}");
                assert!(value(0.5 * found) > 0.0 && value(1.1 * found) < 0.0);
            }
        }
    }
}
