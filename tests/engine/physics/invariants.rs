//! What never changes: energy without loss, and the mirror image of a motion.

use std::f64::consts::PI;

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Job, follow};
use impact_atlas::dynamics::{Event, Stop, Trajectory};
use impact_atlas::model::{Flight, Parameters, State, System};
use rayon::prelude::*;

use crate::physics::{at, flight, hits, values};

/// Kinetic and elastic energy of both masses.
fn energy(p: &Parameters, [x1, x2, v1, v2]: [f64; 4]) -> f64 {
    let mass = p.mu_m / (1.0 - p.mu_m);
    let ground = p.mu_k / (1.0 - p.mu_k);
    0.5 * (v1 * v1 + mass * v2 * v2 + (x1 - x2) * (x1 - x2) + ground * x2 * x2)
}

/// The largest relative change of the energy at any move until 100,000 impacts have happened.
fn energy_drift(parameters: Parameters, start: [f64; 4]) -> f64 {
    let flight = Flight::<f64, 2>::new(&System::new(parameters).unwrap().unforced());
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
    let initial = energy(&parameters, start);
    let mut impacts = 0;
    let mut drift = 0.0_f64;
    while impacts < 100_000 {
        match trajectory.advance(&flight, &mut []).event {
            Event::Impact(_) => impacts += 1,
            Event::Caught { .. } => panic!("nothing sticks without loss: {parameters:?}"),
            _ => {}
        }
        drift = drift.max((energy(&parameters, values(&trajectory.point.state)) / initial - 1.0).abs());
    }
    drift
}

#[test]
fn elastic_impacts_conserve_energy() {
    let lossless = Parameters { zeta: 0.0, r: 1.0, ..at(1.0, 0.3) };
    let systems = [
        lossless,
        Parameters { delta: 0.05, mu_m: 0.2, mu_k: 0.7, ..lossless },
        Parameters { delta: 1.0, mu_m: 0.85, mu_k: 0.3, omega: 0.4, ..lossless },
    ];
    let starts = [[0.0, 0.0, 2.0, 0.0], [0.04, -1.5, 0.3, 0.6], [-0.05, 2.0, -1.0, 1.0]];
    let cases: Vec<_> = systems.iter().flat_map(|p| starts.map(|start| (*p, start))).collect();
    cases.into_par_iter().for_each(|(parameters, start)| {
        let drift = energy_drift(parameters, start);
        assert!(drift < 1e-9, "{drift:e} from {start:?} with {parameters:?}");
    });
}

/// A loss that is as small as the tolerance of the test above is seen by it.
#[test]
fn a_hardly_inelastic_impact_loses_energy() {
    let parameters = Parameters { zeta: 0.0, r: 1.0 - 1e-12, ..at(1.0, 0.3) };
    assert!(energy_drift(parameters, [0.0, 0.0, 2.0, 0.0]) > 1e-9);
}

/// The equations are odd in (x, force): x → −x, half a forcing period later, is a motion again.
#[test]
fn the_mirrored_start_gives_the_mirrored_orbit() {
    let regular = [
        at(3.7, 0.1),
        at(3.5, 0.1),
        at(2.95, 0.1),
        at(1.72, 0.1),
        at(1.63, 0.1),
        Parameters { mu_c: 0.8, f20: 0.4, mu_m: 0.3, ..at(1.9, 0.2) },
        Parameters { r: 0.5, ..at(0.3, 0.2) },
        Parameters { r: 0.7, ..at(0.45, 0.1) },
    ];
    let irregular = [at(2.83, 0.1), at(0.65, 0.1), at(2.7, 0.05)];
    let starts = [[0.0; 4], [0.03, 0.1, -0.4, 0.2], [-0.05, -0.7, 1.5, 0.4]];
    for start in starts {
        for parameters in regular.into_iter().chain(irregular) {
            mirrors(parameters, start, 15);
        }
        // What leads to a regular motion can be chaotic; on the motion itself differences die out.
        for parameters in regular {
            let job = Job { system: System::new(parameters).unwrap(), start: start.into() };
            let schedule = Schedule { transient: 1000, observe: 64, max_period: 32, fixed_periods: true };
            mirrors(parameters, follow::<f64>(&job, &schedule).state.into(), 400);
        }
    }
}

fn mirrors(parameters: Parameters, start: [f64; 4], count: usize) {
    let flight = flight::<f64>(parameters);
    let original = hits(Trajectory::new(&flight, State::from_slice(&start)), &flight, count, 2000.0);
    let opposite = Trajectory::at_phase(&flight, State::from_slice(&start).map(|value: f64| -value), PI);
    let mirrored = hits(opposite, &flight, count, 2000.0);
    assert_eq!((original.len(), mirrored.len()), (count, count), "{parameters:?}");
    for (i, (a, b)) in original.iter().zip(&mirrored).enumerate() {
        let stops = (a.stop == Stop::A) != (b.stop == Stop::A);
        let apart = (a.time - b.time).abs().max((a.before + b.before).abs()).max((a.after + b.after).abs());
        assert!(stops && apart < 1e-9, "impact {i} of {start:?} with {parameters:?}: {a:?} and {b:?}");
    }
}
