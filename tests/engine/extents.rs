//! Root mean square and peak of every coordinate, held to closed forms, to dense samples, and one back end to the other.

use std::f64::consts::{PI, TAU};

use impact_atlas::analysis::{Extent, Regime, Schedule};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide, extent, extents};
use impact_atlas::dynamics::record;
use impact_atlas::model::{Parameter, Setting, StateVector, System};
use impact_atlas::plane::{Plane, Start};
use impact_atlas::sweep::{measure_extents, sweep};
use impact_atlas::system::Family;
use nalgebra::{Complex, DMatrix, DVector};

use crate::common::adapter::gpu;

/// What the documentation promises, relative.
const ACCURACY: f64 = 1e-4;
/// What single precision adds.
const SINGLE: f64 = 1e-4;

fn system(family: &str, values: &[(&str, f64)]) -> System {
    let family = Family::builtin(family);
    let setting = values.iter().fold(Setting::defaults(family), |setting, (name, value)| {
        setting.with(Parameter::of(family, name).unwrap(), *value)
    });
    System::new(setting).unwrap()
}

/// The largest relative deviation of an extent from what it should be.
fn off(found: &Extent, rms: &[f64], peak: &[f64]) -> f64 {
    let relative = |found: &[f32], expected: &[f64]| {
        found.iter().zip(expected).map(|(f, e)| (f64::from(*f) - e).abs() / e.abs()).fold(0.0, f64::max)
    };
    relative(&found.rms, rms).max(relative(&found.peak, peak))
}

/// The state of the forced response at phase 0, and the amplitudes of its coordinates: M x″ + C x′ + K x = s sin ωt + c cos ωt.
fn response(system: &System) -> (StateVector, Vec<f64>) {
    let plant = system.plant();
    let i = Complex::i();
    let complex = |m: &DMatrix<f64>| m.map(|value| Complex::new(value, 0.0));
    let w = plant.omega;
    let matrix = complex(&plant.stiffness) - complex(&plant.mass) * Complex::new(w * w, 0.0)
        + complex(&plant.damping) * (i * w);
    // x = Re(z e^{iωt}): sin ωt is the real part of −i e^{iωt}.
    let force = DVector::from_fn(plant.n, |k, _| Complex::new(plant.force_cos[k], -plant.force_sin[k]));
    let z = matrix.lu().solve(&force).unwrap();
    let places = z.iter().map(|z| z.re);
    let speeds = z.iter().map(|z| (i * w * z).re);
    let state: Vec<f64> = places.chain(speeds).collect();
    (StateVector::from_slice(&state).unwrap(), z.iter().map(|z| z.norm()).collect())
}

#[test]
fn the_forced_response_goes_as_far_as_its_amplitude() {
    let cases = [
        system("luo-ma-lv", &[("omega", 2.3), ("delta", 50.0)]),
        system("luo-ma-lv", &[("omega", 0.31), ("delta", 50.0), ("f20", 0.0)]),
        system("shaw-holmes", &[("omega", 1.7), ("sigma", 50.0)]),
        system("three-mass-chain", &[("omega", 1.1), ("delta", 50.0)]),
    ];
    let mut tested = 0;
    for system in cases {
        let (start, amplitudes) = response(&system);
        let reaches = record(&system, start, 0, 1, 1);
        if !reaches.impacts.is_empty() {
            continue;
        }
        tested += 1;
        let rms: Vec<f64> = amplitudes.iter().map(|a| a / 2_f64.sqrt()).collect();
        let job = Job { system, start };
        let double = off(&extent::<f64>(&job, 3), &rms, &amplitudes);
        let single = off(&extent::<f32>(&job, 3), &rms, &amplitudes);
        assert!(double < ACCURACY && single < ACCURACY + SINGLE, "{double:e} {single:e}");
        // The check can fail: another frequency, another amplitude.
        let other = amplitudes.iter().map(|a| a * 1.001).collect::<Vec<_>>();
        assert!(off(&extent::<f64>(&job, 3), &rms, &other) > 5e-4);
    }
    assert_eq!(tested, 4);
}

/// The ball's motion of one impact in each period: the phase of the impact, the speed after it, and its height above the
/// table a time after the impact, y″ = −1 + Γ sin t with y = 0 at both ends.
fn bounce(gamma: f64, r: f64) -> (f64, f64, impl Fn(f64) -> f64) {
    let speed = TAU * r / (1.0 + r);
    // y(2π) = 0 where π = v + Γ cos φ. Of the two phases the one on which sin φ > 0 is stable.
    let phase = ((PI - speed) / gamma).acos();
    let height =
        move |s: f64| speed * s - s * s / 2.0 + gamma * (s * phase.cos() - (phase + s).sin() + phase.sin());
    (phase, speed, height)
}

#[test]
fn the_ball_goes_as_far_as_its_flight() {
    let (gamma, r) = (1.2, 0.5);
    let (phase, speed, height) = bounce(gamma, r);
    assert!(height(TAU).abs() < 1e-12);
    let steps = 200_000;
    let at = |k: usize| height(TAU * k as f64 / steps as f64);
    let mean = (0..steps).map(|k| at(k) * at(k)).sum::<f64>() / steps as f64;
    let peak = (0..steps).map(|k| at(k).abs()).fold(0.0, f64::max);
    // At phase 0 the ball has been in the air since the impact before.
    let s = TAU - phase;
    let rate = speed - s + gamma * (phase.cos() - (phase + s).cos());
    let start = StateVector::from_slice(&[height(s), rate]).unwrap();
    let job = Job { system: system("bouncing-ball", &[("Gamma", gamma), ("r", r)]), start };
    for (found, allowed) in [
        (extent::<f64>(&job, 4), ACCURACY),
        (extent::<f32>(&job, 4), ACCURACY + SINGLE),
        (extents_of(&Cpu, &job, 4), ACCURACY),
    ] {
        let off = off(&found, &[mean.sqrt()], &[peak]);
        assert!(off < allowed, "{off:e}: {found:?}, not {} {peak}", mean.sqrt());
    }
    // Of the samples at the ends of steps alone the peak would be missed.
    let coarse = (0..10).map(|k| height(TAU * (k as f64 + 0.5) / 10.0).abs()).fold(0.0, f64::max);
    assert!((peak - coarse) / peak > 2.0 * ACCURACY, "{}", (peak - coarse) / peak);
}

fn extents_of(backend: &dyn Backend, job: &Job, periods: u32) -> Extent {
    backend.extents(std::slice::from_ref(job), &[periods], &Unwatched).unwrap()[0]
}

fn schedule() -> Schedule {
    Schedule { transient: 120, observe: 60, max_period: 16, fixed_periods: false }
}

fn plane(family: &'static str, x: &str, y: &str) -> Plane {
    let family = Family::builtin(family);
    Plane {
        x: impact_atlas::plane::Axis::of_family(x, family).unwrap(),
        y: impact_atlas::plane::Axis::of_family(y, family).unwrap(),
        parameters: Setting::defaults(family),
        start: Start::Rest,
        task: schedule(),
    }
}

#[test]
fn motions_that_impact_and_stick_go_as_far_as_dense_samples_of_them() {
    let mut regimes = std::collections::BTreeSet::new();
    for plane in [
        plane("luo-ma-lv", "omega=0.3:4:7", "delta=0.03:0.6:5"),
        plane("impact-damper", "delta=1:6:4", "r=0.4:0.9:3"),
        plane("bouncing-ball", "Gamma=0.5:3:5", "r=0.1:0.8:3"),
    ] {
        let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
        for (k, verdict) in map.verdicts.iter().enumerate().filter(|(_, v)| v.regime.is_periodic()) {
            let (column, row) = (k as u32 % plane.x.count, k as u32 / plane.x.count);
            let system = System::new(plane.parameters_at(column, row)).unwrap();
            let n = u32::from(verdict.n);
            let samples = record(&system, verdict.state, 0, n, 20_000 / n).samples;
            let job = Job { system, start: verdict.state };
            let found = extent::<f64>(&job, n);
            for i in 0..plane.parameters.family().n() {
                let values = || samples[1..].iter().map(move |sample| sample.state[i]);
                let rms = (values().map(|x| x * x).sum::<f64>() / values().count() as f64).sqrt();
                let peak = values().map(f64::abs).fold(0.0, f64::max);
                if peak == 0.0 {
                    // At rest on a stop at 0.
                    assert_eq!((found.rms[i], found.peak[i]), (0.0, 0.0), "{verdict:?}");
                    continue;
                }
                let (by_rms, by_peak) = (f64::from(found.rms[i]) / rms, f64::from(found.peak[i]) / peak);
                assert!((by_rms - 1.0).abs() < 5e-4, "{verdict:?}: {by_rms}");
                assert!((by_peak - 1.0).abs() < 5e-4, "{verdict:?}: {by_peak}");
            }
            regimes.insert(verdict.regime.code());
        }
    }
    let both = [Regime::Periodic, Regime::PeriodicSticking].map(Regime::code);
    assert!(both.iter().all(|code| regimes.contains(code)), "{regimes:?}");
}

#[test]
fn the_gpu_measures_what_the_cpu_does() {
    let gpu = gpu();
    for plane in [
        plane("luo-ma-lv", "omega=0.4:4:9", "delta=0.03:0.6:6"),
        plane("bouncing-ball", "Gamma=0.5:3:6", "r=0.1:0.8:4"),
        plane("three-mass-chain", "omega=0.6:2:5", "delta=0.2:1:4"),
    ] {
        let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
        let jobs: Vec<Job> = (0..plane.cells() as u32)
            .map(|k| {
                let parameters = plane.parameters_at(k % plane.x.count, k / plane.x.count);
                let start = map.verdicts[k as usize].state;
                Job { system: System::new(parameters).unwrap(), start }
            })
            .collect();
        let periods = vec![6; jobs.len()];
        let theirs = gpu.extents(&jobs, &periods, &Unwatched).unwrap();
        let n = plane.parameters.family().n();
        let mut compared = 0;
        for ((job, theirs), verdict) in jobs.iter().zip(&theirs).zip(&map.verdicts) {
            // Of what is chaotic six periods amplify rounding.
            let ours = extent::<f64>(job, 6);
            if !verdict.regime.is_periodic() || ours.peak[0] < 1e-6 {
                continue;
            }
            let off = off(
                theirs,
                &ours.rms[..n].iter().map(|&v| v.into()).collect::<Vec<_>>(),
                &ours.peak[..n].iter().map(|&v| v.into()).collect::<Vec<_>>(),
            );
            assert!(off < 2e-3, "{off:e}: {theirs:?} and {ours:?} of {verdict:?}");
            let shifted: Vec<f64> = ours.rms[..n].iter().map(|&v| 1.01 * f64::from(v)).collect();
            assert!(self::off(theirs, &shifted, &shifted) > 2e-3, "the check can fail");
            compared += 1;
        }
        assert!(compared > 4, "{compared}");
    }
}

#[test]
fn whatever_a_verdict_is_it_has_an_extent_unless_it_is_a_failure() {
    let plane = plane("luo-ma-lv", "omega=0.4:4:9", "delta=0.03:3:6");
    let mut map = sweep(&plane, &Cpu, &Unwatched).unwrap();
    measure_extents(&mut map, &Cpu, &Unwatched).unwrap();
    let measured = map.extents.as_ref().unwrap();
    assert!(
        measured.iter().all(|e| e.rms[..2].iter().zip(&e.peak).all(|(rms, peak)| rms <= peak && *rms > 0.0))
    );
    assert!(measured.iter().all(|e| e.rms[2..] == [0.0; 2]));
    let job = Job { system: System::new(plane.parameters_at(0, 0)).unwrap(), start: StateVector::zeros(2) };
    let mut verdicts = decide(&Cpu, std::slice::from_ref(&job), &schedule(), &Unwatched).unwrap();
    verdicts[0].regime = Regime::Failed;
    let failed = extents(&Cpu, &[job], &verdicts, &schedule(), &Unwatched).unwrap();
    assert!(failed[0].rms[0].is_nan() && failed[0].peak[1].is_nan());
}
