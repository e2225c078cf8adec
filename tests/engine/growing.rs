//! Motions that grow without bounds: a result of its own, whatever their exponent.

use impact_atlas::analysis::{Probe, Reading, Regime, Schedule, Section, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, follow};
use impact_atlas::diagram::{DiagramSpec, ExponentUnit};
use impact_atlas::dynamics::{GivenUp, record};
use impact_atlas::model::{Setting, StateVector, System};
use impact_atlas::plane::{Axis, Start};
use impact_atlas::sweep::diagram;
use impact_atlas::system::Family;
use impact_atlas::theory::Spectrum;

use crate::common::adapter;

/// One mass before a stop, with damping that may be negative.
fn driven() -> &'static Family {
    let file = r#"
name = "driven"
[parameters]
c = 0.1
[system]
frequency = "1.3"
mass = [["1"]]
damping = [["c"]]
stiffness = [["1"]]
force_sin = ["1"]
[[stop]]
name = "A"
direction = ["1"]
gap = "0.5"
restitution = "0.8"
"#;
    Family::kept(file, "driven.toml").unwrap()
}

/// The same with so much damping, from rest.
fn damped(damping: f64) -> Job {
    let system = System::new(Setting::defaults(driven()).with_named("c", damping)).unwrap();
    Job { system, start: StateVector::zeros(1) }
}

/// The verdict on so many forcing periods, half of them observed.
fn followed(backend: &dyn Backend, damping: f64, periods: u32) -> Verdict {
    let half = periods / 2;
    let schedule = Schedule { transient: half, observe: half, max_period: 32, fixed_periods: true };
    backend.run(&[damped(damping)], &schedule, &Unwatched).unwrap()[0]
}

#[test]
fn growth_without_bounds_is_no_chaos() {
    let gpu = adapter::gpu();
    for backend in [&Cpu as &dyn Backend, gpu] {
        // Given up where a square would be no number of single precision, long before one of double precision.
        let mut given_up = Vec::new();
        for periods in [90, 120, 180] {
            let verdict = followed(backend, -0.5, periods);
            assert_eq!(verdict.regime, Regime::Failed, "{}: {verdict:?}", backend.name());
            assert!(!verdict.state.is_bounded(), "{verdict:?}");
            given_up.push(verdict.periods);
        }
        // At the first phase 0 beyond the bounds, whether it is observed by then or not.
        assert!(given_up[0] < 60 && given_up.iter().all(|periods| *periods == given_up[0]), "{given_up:?}");
        let verdict = followed(backend, 0.5, 200);
        assert_ne!(verdict.regime, Regime::Failed);
        assert!(verdict.state.is_bounded());
    }
}

#[test]
fn a_recording_ends_where_the_motion_grows_without_bounds() {
    let recorded = |damping: f64| {
        let Job { system, start } = damped(damping);
        [0, 100].map(|transient| record(&system, &start[..], transient, 300, 10))
    };
    for recording in recorded(-0.5) {
        let Some(GivenUp::Growth(period)) = recording.given_up else { panic!("{:?}", recording.given_up) };
        assert!((20..60).contains(&period), "{period}");
        let values = recording.samples.iter().flat_map(|sample| sample.state.to_vec());
        assert!(values.into_iter().all(f64::is_finite));
    }
    for recording in recorded(0.5) {
        assert_eq!(recording.given_up, None);
    }
}

#[test]
fn lanes_give_up_at_the_strobe_at_which_one_trajectory_does() {
    let jobs: Vec<Job> = (0..40).map(|i| damped(-0.5 + 0.02 * f64::from(i))).collect();
    for fixed_periods in [true, false] {
        let schedule = Schedule { transient: 150, observe: 50, max_period: 16, fixed_periods };
        let verdicts = Cpu.run(&jobs, &schedule, &Unwatched).unwrap();
        for (job, verdict) in jobs.iter().zip(&verdicts) {
            let alone = follow::<f64>(job, &schedule);
            let told = |verdict: &Verdict| (verdict.regime, verdict.periods, verdict.state);
            assert_eq!(told(verdict), told(&alone), "{:?}", job.system.plant().damping);
        }
        let failed = verdicts.iter().filter(|verdict| verdict.regime == Regime::Failed).count();
        assert!((8..32).contains(&failed), "{failed}");
    }
}

#[test]
fn nothing_is_measured_of_growth_without_bounds() {
    for backend in [&Cpu as &dyn Backend, adapter::gpu()] {
        let jobs = [-0.5, 0.5].map(damped);
        let extents = backend.extents(&jobs, &[100, 100], &Unwatched).unwrap();
        assert!(extents[0].peak[0].is_nan() && extents[0].rms[0].is_nan(), "{:?}", extents[0]);
        assert!(extents[1].peak[0] > 0.1 && extents[1].rms[0] > 0.1, "{:?}", extents[1]);
    }
    let spectrum = |damping: f64| {
        let Job { system, start } = damped(damping);
        Spectrum::of(&system, &start[..], 100, 100)
    };
    assert!(spectrum(-0.5).unwrap_err().to_string().contains("without bounds"));
    assert!(spectrum(0.5).is_ok());
}

#[test]
fn a_carried_diagram_goes_on_beyond_columns_that_grow_without_bounds() {
    let family = driven();
    let spec = DiagramSpec {
        x: Axis::of_family("c=-0.5:0.5:6", family).unwrap(),
        parameters: Setting::defaults(family),
        sweep: "up".parse().unwrap(),
        start: Start::Rest,
        probe: Probe::new(Section::A, Reading::VBefore).unwrap(),
        schedule: DiagramSpec::schedule(200, 40, 16),
        capacity: 400,
        spectrum: Some(ExponentUnit::Period),
    };
    let branch = &diagram(&spec, &Cpu, &Unwatched).unwrap().branches[0];
    let spectrum = branch.spectrum.as_ref().unwrap();
    for (i, (trace, exponents)) in branch.traces.iter().zip(spectrum).enumerate() {
        // Where impacts take less than damping below 0 gives.
        assert_eq!(trace.verdict.regime == Regime::Failed, i < 2, "column {i}: {:?}", trace.verdict);
        assert_eq!(exponents[0].is_nan(), i < 2, "column {i}: {exponents:?}");
    }
}
