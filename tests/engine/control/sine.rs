//! The sine kick, Eqs. (21) to (23): a kick at each return to the section.

use impact_atlas::control::methods::Convention;
use impact_atlas::control::{ControlSchedule, Controlled, SectionPoint, Surface, multipliers};
use impact_atlas::dynamics::{Contact, Stop};
use impact_atlas::model::Flight;

use super::{FIXED_POINT, Returns, away, run, sine, starts, system};

fn largest(amplitude: f64) -> f64 {
    let controller = sine(Convention::Kick, amplitude, 0.0, 0.0).resolve(&system()).unwrap();
    multipliers(&system(), &controller, &FIXED_POINT).unwrap().unwrap()[0].norm()
}

#[test]
fn the_kick_has_the_multipliers_that_explain_the_paper() {
    let controller = sine(Convention::Kick, 0.152618, 0.0, 0.0).resolve(&system()).unwrap();
    let found = multipliers(&system(), &controller, &FIXED_POINT).unwrap().unwrap();
    for (re, im) in [(-0.591, 0.247), (-0.591, -0.247), (-0.674, 0.099), (-0.674, -0.099)] {
        let near = found.iter().any(|value| (value.re - re).abs() < 1e-3 && (value.im - im).abs() < 1e-3);
        assert!(near, "{re} + {im}i: {found:?}");
    }
}

#[test]
fn the_fixed_point_is_stable_between_two_amplitudes() {
    for (amplitude, stable) in
        [(0.0, false), (0.10, false), (0.12, true), (0.2, true), (0.3, true), (0.39, true), (0.42, false)]
    {
        assert_eq!(largest(amplitude) < 1.0, stable, "B = {amplitude}: {}", largest(amplitude));
    }
    // The lower end, by bisection.
    let (mut low, mut high) = (0.10, 0.12);
    while high - low > 1e-6 {
        let middle = 0.5 * (low + high);
        if largest(middle) < 1.0 { high = middle } else { low = middle }
    }
    assert!((low - 0.1077).abs() < 5e-4, "{low}");
}

/// Runs on from near the fixed point with a constant amplitude; how far away it ends.
fn from_nearby(amplitude: f64) -> f64 {
    let controller = sine(Convention::Kick, amplitude, 0.0, 0.0).resolve(&system()).unwrap();
    let flight = Flight::<f64, 2>::new(&system());
    let schedule =
        ControlSchedule { from: 0, iterates: 3000, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let [v1, x2, v2, tau] = FIXED_POINT;
    let surface = Surface::new(&system(), &flight, Stop::A);
    let begun =
        SectionPoint::<f64, 2>::new(&[v1 + 1e-4, x2, v2, tau]).trajectory(&flight, &surface, Contact::FREE);
    let mut controlled = Controlled::<f64, 2, 2>::new(begun, surface, controller, &schedule);
    let mut returns = Returns::default();
    controlled.follow(&flight, &schedule, &mut returns);
    away(returns.0.last().unwrap().section, FIXED_POINT)
}

#[test]
fn runs_stay_where_the_multipliers_say_so() {
    for (amplitude, stays) in [(0.0, false), (0.09, false), (0.13, true), (0.25, true), (0.38, true)] {
        assert_eq!(from_nearby(amplitude) < 1e-7, stays, "B = {amplitude}: {}", from_nearby(amplitude));
    }
}

#[test]
fn adaptation_captures_some_starts() {
    let runs = starts(24).map(|start| run(&sine(Convention::Kick, 0.0, 0.1, 0.0055), 6000, start));
    let captured: Vec<f64> = runs
        .filter(|(outcome, _)| outcome.verdict.label() == "1-2-1")
        .map(|(_, returns)| {
            let last = returns.last().unwrap();
            assert!(away(last.section, FIXED_POINT) < 1e-3, "{last:?}");
            assert!((last.section[3] - 1.802134).abs() < 0.0055);
            last.signal
        })
        .collect();
    assert!(captured.len() >= 3 && captured.len() < 24, "{captured:?}");
    assert!(captured.iter().all(|b| (0.10..0.40).contains(b)), "{captured:?}");
}

#[test]
fn the_amplitude_comes_to_rest_only_where_the_dead_band_is_wide_enough() {
    // The fixed point's phase is 0.0051 from the target.
    for (dead_band, rests) in [(0.004, false), (0.0055, true)] {
        let runs = starts(24).map(|start| run(&sine(Convention::Kick, 0.0, 0.1, dead_band), 6000, start));
        let captured: Vec<_> = runs.filter(|(outcome, _)| outcome.verdict.label() == "1-2-1").collect();
        assert!(!captured.is_empty(), "Δ = {dead_band}");
        for (outcome, returns) in captured {
            let [.., before, last] = &returns[..] else { panic!("no returns") };
            assert_eq!(before.signal == last.signal, rests, "Δ = {dead_band}: {outcome:?}");
        }
    }
}
