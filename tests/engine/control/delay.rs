//! Delayed feedback, Eq. (30).

use impact_atlas::control::methods::Sign;
use impact_atlas::control::{Controller, Outcome, Return, converged_at, multipliers};
use impact_atlas::dynamics::Stop;
use impact_atlas::theory::impact_map;
use nalgebra::Complex;

use super::{FIXED_POINT, away, delay, run, starts, system};

/// The first of some starts that feedback captures at the fixed point: from a chaotic transient the smallest rounding error
/// decides which motion captures a start, this one, its mirror image or another.
fn captured(gain: f64, iterates: u32) -> (Outcome, Vec<Return<f64>>) {
    let mut runs = starts(12).map(|start| run(&delay(gain, Sign::Stabilising), iterates, start));
    let is_there = |(outcome, _): &(Outcome, _)| outcome.verdict.label() == "1-2-1";
    runs.find(is_there).unwrap_or_else(|| panic!("no start is captured with g = {gain}"))
}

/// The fixed point to the last digit: F's own, by the feedback that stabilises it.
fn fixed_point() -> [f64; 4] {
    captured(0.4, 3000).0.section[..].try_into().unwrap()
}

#[test]
fn gains_of_a_half_and_less_reach_the_unstable_fixed_point() {
    for gain in [0.3, 0.4, 0.5] {
        let (outcome, returns) = captured(gain, 4000);
        assert_eq!(outcome.period, 1, "g = {gain}");
        assert!(away(outcome.section, FIXED_POINT) < 1e-7, "g = {gain}: {outcome:?}");
        let iterates = converged_at(&system(), &returns, 2000, 1, 1e-6).unwrap();
        assert!((20..250).contains(&iterates), "g = {gain}: {iterates}");
        assert!(returns.last().unwrap().signal < 1e-12, "the control does not vanish");
    }
}

#[test]
fn a_gain_just_large_enough_takes_over_half_a_thousand_iterates() {
    let (outcome, returns) = captured(0.25, 8000);
    assert!(away(outcome.section, FIXED_POINT) < 1e-7);
    let iterates = converged_at(&system(), &returns, 2000, 1, 1e-6).unwrap();
    assert!((500..4000).contains(&iterates), "{iterates}");
}

#[test]
fn below_the_threshold_the_motion_has_two_points() {
    // It, or its mirror image, which meets this section four times in its period.
    let wanted = [("2-4-2".to_owned(), 2), ("2-2-4".to_owned(), 4)];
    for gain in [0.1, 0.2, 0.24, 0.247] {
        let runs = starts(24).map(|start| run(&delay(gain, Sign::Stabilising), 6000, start).0);
        let reached: Vec<_> = runs.map(|outcome| (outcome.verdict.label(), outcome.period)).collect();
        // At g = 0.1 one of six starts or so is captured by a third motion.
        let there = reached.iter().filter(|motion| wanted.contains(motion)).count();
        assert!(there > reached.len() / 2, "g = {gain}: {reached:?}");
        assert!(reached.iter().all(|&(_, period)| period > 1), "g = {gain}: {reached:?}");
    }
}

#[test]
fn the_fixed_point_is_one_of_the_uncontrolled_map() {
    let fixed = fixed_point();
    let next = impact_map(&system(), fixed).unwrap();
    let [v1, x2, v2, tau] = next.section[..] else { panic!("four components") };
    assert!(away([v1, x2, v2, tau - std::f64::consts::TAU], fixed) < 1e-12, "{next:?}");
    assert_eq!(next.impacts.len(), 3);
}

/// The larger root of μ² − (λ + g) μ + g = 0.
fn root(lambda: Complex<f64>, g: f64) -> f64 {
    let sum = lambda + g;
    let difference = (sum * sum - 4.0 * g).sqrt();
    ((sum + difference) / 2.0).norm().max(((sum - difference) / 2.0).norm())
}

#[test]
fn linear_theory_predicts_threshold_and_rate() {
    let fixed = fixed_point();
    let lambdas = impact_map(&system(), fixed).unwrap().jacobian.unwrap().complex_eigenvalues();
    let mut moduli: Vec<f64> = lambdas.iter().map(|lambda| lambda.re).collect();
    moduli.sort_by(f64::total_cmp);
    for (found, known) in moduli.iter().zip([-1.4954, -0.6637, -0.5644, -0.1235]) {
        assert!((found - known).abs() < 1e-4, "{moduli:?}");
    }
    let predicted = |g: f64| lambdas.iter().map(|&lambda| root(lambda, g)).fold(0.0, f64::max);
    // With λ = −1.4954 the root −1 means 1 + λ + 2g = 0.
    let threshold = -(1.0 + moduli[0]) / 2.0;
    assert!((threshold - 0.2477).abs() < 1e-4);
    assert!(predicted(threshold - 1e-3) > 1.0 && predicted(threshold + 1e-3) < 1.0);
    for gain in [0.26, 0.28, 0.3] {
        let controller = delay(gain, Sign::Stabilising).resolve(&system()).unwrap();
        let computed = multipliers(&system(), &controller, &fixed).unwrap().unwrap()[0].norm();
        assert!((computed - predicted(gain)).abs() < 1e-6, "g = {gain}: {computed}, {}", predicted(gain));
        let (_, returns) = captured(gain, 4000);
        let distance: Vec<f64> = returns[2000..].iter().map(|met| away(met.section, fixed)).collect();
        let begun = distance.iter().position(|&d| d < 1e-4).unwrap();
        let ended = distance.iter().position(|&d| d < 1e-9).unwrap();
        let measured = (distance[ended] / distance[begun]).powf(1.0 / (ended - begun) as f64);
        assert!((measured - predicted(gain)).abs() < 0.01, "g = {gain}: {measured}, {}", predicted(gain));
    }
    let none = multipliers(&system(), &Controller::None(Stop::A), &fixed).unwrap().unwrap();
    assert!((none[0].re - moduli[0]).abs() < 1e-6, "differences and exact Jacobian disagree");
}

#[test]
fn the_printed_sign_does_not_reach_the_fixed_point() {
    let fixed = fixed_point();
    for gain in [0.1, 0.3, 0.5] {
        let controller = delay(gain, Sign::Printed).resolve(&system()).unwrap();
        let largest = multipliers(&system(), &controller, &fixed).unwrap().unwrap()[0].norm();
        assert!(largest > 1.4954, "g = {gain}: {largest}");
        for start in starts(5) {
            let (outcome, _) = run(&delay(gain, Sign::Printed), 4000, start);
            let there = outcome.period == 1 && away(outcome.section, fixed) < 1e-3;
            assert!(!there, "g = {gain}: {outcome:?}");
        }
    }
}

#[test]
fn corrections_off_the_section_are_left_out_and_counted() {
    // The motion is chaotic: whether a run has an escape depends on its start.
    let mut escapes = 0;
    for start in 0..8 {
        let start = [0.0, 0.0, 1e-3 * f64::from(start), 0.0];
        let (outcome, returns) = run(&delay(0.8, Sign::Stabilising), 2400, start);
        let escaped: Vec<_> = returns.iter().filter(|met| met.escaped).collect();
        assert_eq!(escaped.len() as u32, outcome.escapes);
        assert!(escaped.iter().all(|met| met.arrived == met.section));
        assert!(returns.iter().all(|met| met.section[0] <= 0.0));
        escapes += escaped.len();
    }
    assert!(escapes > 0, "no run has an escape to look at");
}
