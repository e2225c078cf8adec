use super::*;
use crate::dynamics::example::pair_with;
use crate::dynamics::placing::rested;
use crate::model::State;

/// What presses on either of two stops with masses at rest on both, under a load on the first mass, at a forcing phase.
fn on_both<T: Real>(load: f64, phase: f64) -> [Pressing<T>; 2] {
    let system = pair_with(&[[1.0, -0.4], [0.3, 1.0]], 0.3, load);
    let flight = Flight::<f64, 2>::new(&system).round::<T>();
    let ends = [0, 1].map(|normal| End { normal, side: 0 });
    let contact = ends.into_iter().fold(Contact::FREE, Contact::with);
    let state = rested(&flight, &State { x: [T::of(0.2); 2], v: [T::zero(); 2] }, contact);
    let point = Point { state, sin: T::of(phase.sin()), cos: T::of(phase.cos()) };
    let motion = point.motion(&flight, contact);
    ends.map(|end| Pressing::on(&flight, &point, &motion, contact, end))
}

/// The load with which nothing presses on the first of them at a forcing phase.
fn balanced(phase: f64) -> f64 {
    let force = |load: f64| on_both::<f64>(load, phase)[0].force;
    -force(0.0) / (force(1.0) - force(0.0))
}

/// The forcing phase at which what presses on it does not change.
fn still() -> f64 {
    let slope = |phase: f64| on_both::<f64>(0.0, phase)[0].slope;
    (-slope(0.0)).atan2(slope(0.5 * std::f64::consts::PI))
}

fn told_from_nothing<T: Real>() {
    let phase = still();
    let load = balanced(phase);
    let [first, second] = on_both::<T>(load, phase);
    assert!(first.slope.abs() < T::of(16.0) * T::epsilon(), "it does not change: {first:?}");
    assert!(first.slack > T::zero() && !first.opens, "{first:?}");
    assert!(first.slack < T::of(1e3) * T::epsilon(), "no more than rounding: {first:?}");
    assert_eq!(second.slack, T::zero(), "{second:?}");
    for more in [1e4 * T::EPSILON, -1e4 * T::EPSILON] {
        let [first, _] = on_both::<T>(load + more, phase);
        assert_eq!((first.slack, first.opens), (T::zero(), first.force < T::zero()), "{more}: {first:?}");
    }
    // Where it falls it opens at once, and where it grows it does not.
    for later in [0.5, -0.5] {
        let [first, _] = on_both::<T>(balanced(phase + later), phase + later);
        let falls = first.slope < T::zero();
        assert_eq!((first.slack == T::zero(), first.opens), (falls, falls), "{later}: {first:?}");
    }
}

#[test]
fn what_presses_is_nothing_where_rounding_decides_on_its_sign() {
    told_from_nothing::<f64>();
    told_from_nothing::<f32>();
}

#[test]
fn nothing_lasts_until_rounding_would_no_longer_hide_what_it_did() {
    let phase = still();
    let [first, _] = on_both::<f64>(balanced(phase), phase);
    // A pull that grows with t²/2 has done t³/6 to a speed.
    let lasts = first.lasts(1.0, 1.0);
    let done = lasts.powi(3) / 6.0;
    assert!(lasts > 1e-6 && done < first.slack, "{lasts} {done}");
    assert_eq!(first.lasts(0.0, 1.0), 1.0, "what never changes");
    // What can be told from nothing lasts as long as it does.
    let [first, _] = on_both::<f64>(balanced(phase) + 0.5e-6, phase);
    let exact = (2.0 * first.force / 8.0).sqrt();
    assert!((first.lasts(8.0, 1.0) - exact).abs() < 1e-6 * exact, "{first:?}");
}
