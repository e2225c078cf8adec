//! The exponents of settled motions against the multipliers of their exact orbits.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, follow};
use impact_atlas::plane::{Plane, RegionMap, Start};
use impact_atlas::sweep::{certify, sweep};

use super::{at, job, schedule};
use crate::common::adapter;

/// Periods that a tangent vector does not align in within an observation.
const LONG: u16 = 7;

/// A plane with many long periods.
fn map() -> RegionMap {
    let plane =
        Plane::of_paper("omega=0.9:2.7:80", "delta=0.05:0.25:60", Start::Symmetric, schedule(300)).unwrap();
    sweep(&plane, &Cpu, &Unwatched).unwrap()
}

/// What was found of every long motion that came to rest before its transient was over, and its exact exponent.
fn long_motions() -> Vec<(Job, Verdict, f32)> {
    let before = map();
    let mut after = before.clone();
    certify(&mut after, &Cpu, &Unwatched).unwrap();
    let cells = before.verdicts.iter().zip(&after.verdicts).enumerate();
    let found = cells.filter_map(|(cell, (verdict, exact))| {
        let same = verdict.label() == exact.label() && verdict.regime.is_periodic();
        let long = verdict.n >= LONG && verdict.periods < 300 + verdict.measures.observed;
        let (column, row) = (cell as u32 % before.plane.x.count, cell as u32 / before.plane.x.count);
        let job = job(at(before.plane.x.value(column), before.plane.y.value(row)));
        (same && long && exact.lyapunov.is_finite()).then_some((job, *verdict, exact.lyapunov))
    });
    found.collect()
}

#[test]
fn exponents_of_long_periods_are_those_of_their_exact_orbits() {
    let motions = long_motions();
    assert!(motions.len() >= 20, "{}", motions.len());
    for (_, verdict, exact) in &motions {
        let Verdict { lyapunov, .. } = verdict;
        assert!((lyapunov - exact).abs() < 1e-3, "{}: {lyapunov} for {exact}", verdict.label());
    }
    // A tangent vector that is carried along for as long is not aligned: the bound is not for want of difference.
    let fixed = Schedule { observe: 48, fixed_periods: true, ..schedule(300) };
    let by_tangent =
        |(job, _, exact): &(Job, Verdict, f32)| (follow::<f64>(job, &fixed).lyapunov - exact).abs();
    let worst = motions.iter().map(by_tangent).fold(0.0, f32::max);
    assert!(worst > 1e-2, "{worst}");
}

#[test]
fn kernels_measure_long_periods_turn_by_turn_too() {
    let motions = long_motions();
    let jobs: Vec<Job> = motions.iter().map(|(job, ..)| job.clone()).collect();
    let verdicts = adapter::gpu().run(&jobs, &schedule(300), &Unwatched).unwrap();
    // Some settle later than in double precision, or not within the transient.
    let settled = |found: &Verdict| found.measures.observed < schedule(300).observe;
    let compared = verdicts
        .iter()
        .zip(&motions)
        .filter(|(found, (_, verdict, _))| found.label() == verdict.label() && settled(found));
    let mut apart: Vec<f32> = compared.map(|(found, (.., exact))| (found.lyapunov - exact).abs()).collect();
    apart.sort_by(f32::total_cmp);
    assert!(apart.len() >= motions.len() / 3, "{} of {}", apart.len(), motions.len());
    // As far as single precision tells one turn from the next.
    assert!(apart[apart.len() / 2] < 5e-4 && apart[apart.len() - 1] < 1e-2, "{apart:?}");
}
