//! Small kicks hold a motion that is too unstable for delayed feedback, whatever its gain.

use impact_atlas::backend::{Backend, Cpu, Unwatched};
use impact_atlas::control::methods::{OgySetting, Sign};
use impact_atlas::control::{
    ControlSchedule, Controller, Outcome, Return, Scheme, SectionValues, Target, control, multipliers,
};
use impact_atlas::dynamics::Stop;
use impact_atlas::model::{Parameters, Real, System};
use impact_atlas::plane::Start;
use impact_atlas::sweep::sweep;
use impact_atlas::theory::impact_map;
use impact_atlas::validate::Thresholds;

use super::maps::{agreement, beside, map, plane};
use super::{Returns, TARGET, away, delay, gpu};
use crate::common::scaled::scaled;

/// Where the 1-2-1 motion has the multiplier −3.9.
const OMEGA: f64 = 2.5;

/// Near its fixed point (v1+, x2, v2, τ).
const NEAR: [f64; 4] = [-0.4198, -0.024, 0.055, 1.7];

fn kicks(window: f64, near: [f64; 4]) -> Scheme {
    let given = SectionValues::new(near.map(Some));
    Scheme::Ogy(OgySetting { stop: Stop::A, window, target: Target { given, ..TARGET } })
}

fn unstable() -> System {
    system_at(OMEGA)
}

fn system_at(omega: f64) -> System {
    System::new(Parameters { omega, ..Parameters::default() }).unwrap()
}

fn held_point(system: &System, near: [f64; 4]) -> [f64; 4] {
    let Controller::Ogy(law) = kicks(0.05, near).resolve(system).unwrap() else { panic!("kicks") };
    law.point[..].try_into().unwrap()
}

/// From beside the motion, under control at once.
fn followed(scheme: &Scheme) -> (Outcome, Vec<Return<f64>>) {
    let system = unstable();
    let controller = scheme.resolve(&system).unwrap();
    let schedule =
        ControlSchedule { from: 2, iterates: 600, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let start = beside(&system, held_point(&system, NEAR));
    let mut returns = Returns::default();
    let outcome = control::<f64, _>(&system, &start, &controller, &schedule, &mut returns).unwrap();
    (outcome, returns.0)
}

#[test]
fn kicks_hold_what_delayed_feedback_cannot() {
    let system = unstable();
    let point = held_point(&system, NEAR);
    let jacobian = impact_map(&system, point).unwrap().jacobian.unwrap();
    let moduli = jacobian.complex_eigenvalues().map(|multiplier| multiplier.norm());
    assert!((moduli.max() - 3.89).abs() < 0.05, "{moduli}");

    let (outcome, returns) = followed(&kicks(0.05, NEAR));
    assert_eq!((outcome.verdict.label().as_str(), outcome.period, outcome.escapes), ("1-2-1", 1, 0));
    assert!(away(outcome.section, point) < 1e-9, "{outcome:?}");
    assert!(returns.last().unwrap().signal < 1e-10, "the control does not vanish");
    let held = kicks(0.05, NEAR).resolve(&system).unwrap();
    let under_kicks = multipliers(&system, &held, &point).unwrap().unwrap();
    assert!(under_kicks[0].norm() < 0.6, "{under_kicks:?}");

    for gain in [0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0] {
        let feedback = delay(gain, Sign::Stabilising);
        let largest = multipliers(&system, &feedback.resolve(&system).unwrap(), &point).unwrap().unwrap()[0];
        assert!(largest.norm() > 1.2, "g = {gain}: {largest}");
        let (outcome, _) = followed(&feedback);
        let there = outcome.period == 1 && away(outcome.section, point) < 1e-3;
        assert!(!there, "g = {gain}: {outcome:?}");
    }
}

/// At ω = 2.6 the chaotic motion comes near the unstable one by itself, and is caught there by kicks that are never larger
/// than the window.
#[test]
fn a_chaotic_motion_is_caught_where_it_comes_near() {
    let system = System::new(Parameters { omega: 2.6, ..Parameters::default() }).unwrap();
    let near = [-0.418, -0.031, 0.027, 1.71];
    let schedule =
        ControlSchedule { from: 1000, iterates: 8000, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let reached = |window: f64| {
        let controller = kicks(window, near).resolve(&system).unwrap();
        let mut returns = Returns::default();
        let outcome = control::<f64, _>(&system, &[0.0; 4], &controller, &schedule, &mut returns).unwrap();
        (outcome, returns.0)
    };
    let (outcome, returns) = reached(0.05);
    assert_eq!((outcome.verdict.label().as_str(), outcome.period), ("1-2-1", 1));
    assert!(away(outcome.section, held_point(&system, near)) < 1e-9, "{outcome:?}");
    assert!(returns.iter().all(|met| met.signal <= 0.05));
    assert_eq!(reached(1e-9).0.verdict.label(), "chaotic");
}

/// The same in a unit of length a million times as large, and one that is as much smaller: what comes near, settles
/// and runs away is told by the motion's own size.
#[test]
fn it_is_caught_in_any_unit_of_length() {
    for exponent in [-20, 20] {
        is_caught_with::<f64>(2f64.powi(exponent), 1e-9);
        is_caught_with::<f32>(2f64.powi(exponent), 1e-4);
    }
}

fn is_caught_with<T: Real>(unit: f64, accuracy: f64) {
    let system = System::of_plant(scaled(system_at(2.6).plant(), unit)).unwrap();
    let near = [-0.418 * unit, -0.031 * unit, 0.027 * unit, 1.71];
    let schedule =
        ControlSchedule { from: 1000, iterates: 8000, fixed: true, max_period: ControlSchedule::MAX_PERIOD };
    let reached = |window: f64| {
        let controller = kicks(window * unit, near).resolve(&system).unwrap();
        control::<T, _>(&system, &[0.0; 4], &controller, &schedule, &mut ()).unwrap()
    };
    let (held, free) = (reached(0.05), reached(1e-9));
    assert_eq!((held.period, held.verdict.n), (1, 1), "{held:?}");
    let point = held_point(&system_at(2.6), [-0.418, -0.031, 0.027, 1.71]);
    let scaled = [held.section[0] / unit, held.section[1] / unit, held.section[2] / unit, held.section[3]];
    assert!(away(scaled, point) < accuracy, "{held:?}");
    assert_eq!((free.period, free.verdict.label().as_str()), (0, "chaotic"), "{free:?}");
}

#[test]
fn motions_that_cannot_be_held_are_refused() {
    let refused = |omega: f64, near: [f64; 4]| {
        let system = System::new(Parameters { omega, ..Parameters::default() }).unwrap();
        kicks(0.05, near).resolve(&system).unwrap_err().to_string()
    };
    assert!(refused(OMEGA, [-3.0, 0.0, 0.0, 0.1]).contains("--target"));
    let system = System::new(Parameters { omega: 3.7, ..Parameters::default() }).unwrap();
    let target = Scheme::Ogy(OgySetting { stop: Stop::A, window: 0.1, target: TARGET });
    let Controller::Ogy(stable) = target.resolve(&system).unwrap() else { panic!("kicks") };
    assert_eq!(stable.gains, SectionValues::new([0.0; 4]), "a stable motion needs no kicks");
    let Err(error) = kicks(-1.0, NEAR).resolve(&unstable()) else { panic!("a window below 0") };
    assert!(error.to_string().contains("window = -1"), "{error}");
}

/// Where the motion ends, or is unstable in two directions, its cells are left undecided, and the others are what they are.
#[test]
fn a_cell_that_cannot_be_held_is_no_error_of_the_plane() {
    let mut plane = plane(kicks(0.05, NEAR), "omega=1.3:2.5:7", "window=0.1:0.2:2");
    let held = held_point(&unstable(), NEAR);
    plane.start = Start::State(beside(&unstable(), held).into());
    plane.task.schedule =
        ControlSchedule { from: 2, iterates: 100, fixed: false, max_period: ControlSchedule::MAX_PERIOD };
    let verdicts = map(&plane, &Cpu).verdicts;
    let undecided = verdicts.iter().filter(|told| told.iterates == 0).count();
    let held = verdicts.last().map(|told| told.verdict.label());
    assert_eq!(held.as_deref(), Some("1-2-1"));
    assert!(undecided >= 2 && undecided < verdicts.len(), "{undecided} of {}", verdicts.len());
    plane.x = "omega=1:1.3:3".parse().unwrap();
    let refused = sweep(&plane, &Cpu, &Unwatched).map(drop).unwrap_err().to_string();
    assert!(refused.contains("--target") || refused.contains("choose another"), "{refused}");
}

/// The GPU computes the same law: it holds the same motions where a kick is large enough, and none where it is not.
#[test]
fn both_back_ends_hold_the_same_cells() {
    let start = beside(&unstable(), held_point(&unstable(), NEAR));
    let of = |windows: &str| {
        let mut plane = plane(kicks(0.05, NEAR), "omega=2.46:2.54:7", windows);
        plane.start = Start::State(start.into());
        plane.task.schedule =
            ControlSchedule { from: 2, iterates: 100, fixed: false, max_period: ControlSchedule::MAX_PERIOD };
        plane
    };
    let held = |plane, backend: &dyn Backend| {
        map(plane, backend).verdicts.iter().filter(|told| told.verdict.label() == "1-2-1").count()
    };
    let (enough, too_small) = (of("window=0.1:0.2:4"), of("window=1e-7:1e-5:4"));
    assert_eq!([held(&enough, &Cpu), held(&enough, gpu())], [28, 28]);
    assert_eq!([held(&too_small, &Cpu), held(&too_small, gpu())], [0, 0]);
    let agreement = agreement(&enough, gpu());
    assert!(agreement.holds(&Thresholds::default()), "{agreement:?}");
}
