//! The theory held to the paper's numbers, to the simulation, and to itself.

mod jacobians;
mod motions;
mod plants;
mod robustness;
mod spectra;

use impact_atlas::model::{Parameters, System};

/// The paper's system at a frequency and half clearance.
fn at(omega: f64, delta: f64) -> System {
    System::new(Parameters { omega, delta, ..Parameters::default() }).unwrap()
}

#[track_caller]
fn assert_close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{found:?} is not {expected:?} within {tolerance}");
    }
}
