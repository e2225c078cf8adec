//! Period pulses, Eqs. (26) to (29).

use impact_atlas::control::Scheme;
use impact_atlas::control::methods::PulseSetting;
use impact_atlas::dynamics::Stop;

use super::{TARGET, away, run};

const X0: [f64; 4] = [-0.345457, -0.006341, 0.021160, 1.802134];

fn pulse(period: u32, noise: f64) -> Scheme {
    Scheme::Pulse(PulseSetting { stop: Stop::A, period, target: TARGET, noise, seed: 5 })
}

#[test]
fn every_pulse_brings_the_point_to_the_target() {
    for period in [1, 2, 3] {
        let (outcome, returns) = run(&pulse(period, 0.0), 3000, [0.0; 4]);
        assert_eq!((outcome.period, outcome.verdict.n), (period, period as u16));
        let pulsed = returns[2000..].iter().step_by(period as usize);
        assert!(pulsed.clone().count() > 300);
        pulsed.for_each(|met| assert!(away(met.section, X0) < 1e-6, "{met:?}"));
        let away_again = returns[2000..].iter().filter(|met| away(met.section, X0) > 1e-3);
        assert_eq!(away_again.count(), 1000 - 1000_usize.div_ceil(period as usize));
    }
}

#[test]
fn the_pulses_do_not_vanish() {
    let (outcome, returns) = run(&pulse(1, 0.0), 3000, [0.0; 4]);
    // The target is no fixed point at this frequency: it is left again each time by the same way.
    let last = returns.last().unwrap();
    assert!((last.signal - 0.1646).abs() < 1e-3 && (outcome.effort - 0.1646).abs() < 2e-3, "{last:?}");
}

#[test]
fn errors_of_measurement_stay_errors_of_the_point() {
    let (_, returns) = run(&pulse(1, 1e-3), 4000, [0.0; 4]);
    let errors: Vec<f64> = returns[2000..].iter().map(|met| away(met.section, X0)).collect();
    assert!(errors.iter().all(|&error| error <= 1e-3 + 1e-6));
    assert!(errors.iter().any(|&error| error > 5e-4));
    assert_eq!(run(&pulse(1, 1e-3), 4000, [0.0; 4]).1, returns, "the same seed gives other errors");
}
