//! The recorded orbit, f64: every impact at its time, with its velocities, and no sample beyond a stop.

use impact_atlas::dynamics::{Recording, Stop, record};
use impact_atlas::model::System;
use rayon::prelude::*;

use crate::common::conditioning::{Case, cases};
use crate::common::oracle;

/// Forcing periods that are recorded.
const PERIODS: usize = 5;

/// Samples per forcing period.
const SAMPLES: u32 = 400;

fn recorded(case: &Case, periods: usize) -> Recording {
    let system = System::new(case.parameters).expect("the cases are physical");
    record(&system, case.start, 0, periods as u32, SAMPLES)
}

#[test]
fn every_impact_is_recorded_at_its_time_with_its_velocities() {
    let counted: usize = cases()
        .par_iter()
        .map(|case| {
            let periods = case.fine.countable.min(PERIODS);
            if periods == 0 {
                return 0;
            }
            let recording = recorded(case, periods);
            let period = std::f64::consts::TAU / case.parameters.omega;
            let exact = (0..periods).flat_map(|i| {
                case.truth[i].impacts.iter().map(move |impact| (i as f64 * period + impact.time, impact))
            });
            let exact: Vec<_> = exact.collect();
            assert_eq!(recording.impacts.len(), exact.len(), "{case:?}");
            for (ours, (time, theirs)) in recording.impacts.iter().zip(&exact) {
                assert_eq!(ours.stop == Stop::A, theirs.stop == oracle::Stop::Plus);
                // An error of x1 shifts a slow impact by as much over its speed.
                let slow = 1.0 / theirs.velocity_before.abs();
                let near = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * (1.0 + b.abs());
                assert!(near(ours.time, *time, 1e-9 * (1.0 + slow)), "{ours:?} {theirs:?} {case:?}");
                assert!(near(ours.velocity_before, theirs.velocity_before, 1e-9 * (1.0 + slow)), "{case:?}");
                assert!(near(ours.velocity_after, theirs.velocity_after, 1e-9 * (1.0 + slow)), "{case:?}");
                assert!(near(ours.state[1], theirs.x2, 1e-9 * (1.0 + slow)), "{ours:?} {theirs:?}");
                assert!(near(ours.state[3], theirs.v2, 1e-9 * (1.0 + slow)), "{ours:?} {theirs:?}");
            }
            exact.len()
        })
        .sum();
    println!("{counted} impacts compared");
    assert!(counted > 3000, "{counted}");
}

#[test]
fn no_sample_lies_beyond_a_stop() {
    cases().par_iter().for_each(|case| {
        let delta = case.parameters.delta;
        for sample in recorded(case, 3).samples {
            assert!(sample.state[0].abs() <= delta + 1e-12 * (1.0 + delta), "{sample:?} {case:?}");
        }
    });
}
