//! What a mass forgets: every deviation, where it is alone and rests on a stop; and its impacts, once it never impacts again.

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{self, Backend, Choice, Cpu, Job, Unwatched};
use impact_atlas::model::{Parameters, StateVector, System};
use impact_atlas::plane::Start;
use impact_atlas::system::{Plant, PlantStop};
use nalgebra::{DMatrix, DVector};

const SCHEDULE: Schedule = Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false };

/// One mass between unequal stops, pressed towards one of them by a load.
fn pressed(omega: f64, load: f64) -> Job {
    let matrix = |value: f64| DMatrix::from_element(1, 1, value);
    let vector = |value: f64| DVector::from_element(1, value);
    let stop = |direction: f64, gap: f64, restitution: f64| PlantStop {
        direction: vector(direction),
        gap,
        restitution,
    };
    let plant = Plant {
        n: 1,
        mass: matrix(1.0),
        damping: matrix(0.1),
        stiffness: matrix(0.3),
        force_sin: vector(3.0),
        force_cos: vector(0.0),
        load: vector(-load),
        omega,
        stops: vec![stop(-1.0, 0.5, 0.75), stop(1.0, 2.0, 0.4)],
    };
    let start = StateVector::from_slice(&[0.0; 2]).unwrap();
    Job { system: System::of_plant(plant).unwrap(), start }
}

/// The verdicts of both back ends.
fn followed(jobs: &[Job]) -> Vec<Vec<Verdict>> {
    let Ok(gpu) = backend::open(Choice::Gpu, None) else { panic!("these tests need an adapter") };
    let on = |backend: &dyn Backend| backend.run(jobs, &SCHEDULE, &Unwatched).unwrap();
    vec![on(&Cpu), on(&*gpu)]
}

#[test]
fn one_mass_that_rests_has_no_exponent_but_minus_infinity() {
    let places =
        (0..12).flat_map(|i| (0..12).map(move |j| (1.0 + 0.03 * f64::from(i), 2.2 + 0.03 * f64::from(j))));
    let jobs: Vec<Job> = places.map(|(omega, load)| pressed(omega, load)).collect();
    for verdicts in followed(&jobs) {
        let aperiodic = verdicts.iter().filter(|verdict| verdict.regime == Regime::AperiodicSticking);
        let exponents: Vec<f32> = aperiodic.map(|verdict| verdict.lyapunov).collect();
        assert!(exponents.len() >= 5, "{} stick and do not return", exponents.len());
        assert!(exponents.iter().all(|&exponent| exponent == f32::NEG_INFINITY), "{exponents:?}");
        // Without rest it is finite.
        assert!(verdicts.iter().any(|verdict| verdict.lyapunov.is_finite()));
    }
}

#[test]
fn impacts_before_a_motion_came_to_impact_no_more_are_not_of_what_was_observed() {
    let job = |i: u32| {
        let system = System::new(Parameters {
            omega: 2.0 + 0.01 * f64::from(i),
            delta: 0.74,
            ..Parameters::default()
        })
        .unwrap();
        let start = Start::Symmetric.state(&system);
        Job { system, start }
    };
    let jobs: Vec<Job> = (0..60).map(job).collect();
    for verdicts in followed(&jobs) {
        let quiet = verdicts.iter().filter(|verdict| verdict.measures.observed == 0);
        let before = quiet.clone().filter(|verdict| verdict.impacts_total > 0).count();
        assert!(before > 3, "{before} impacted before");
        for verdict in quiet {
            assert_eq!(verdict.regime, Regime::NoImpact);
            assert_eq!((verdict.impacts, verdict.peak_impact_velocity), (0, 0.0));
        }
    }
}
