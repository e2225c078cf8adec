//! The points that the paper names, on the CPU path, in its single precision, and on an adapter.

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, follow};
use impact_atlas::dynamics::{Stop, record};
use impact_atlas::model::System;
use impact_atlas::plane::Start;
use impact_atlas::theory::{confirmed, symmetric_motions};

use crate::common::adapter::gpu;
use crate::physics::at;

const REST: [f64; 4] = [0.0; 4];

fn job(omega: f64, delta: f64, start: Start) -> Job {
    let system = System::new(at(omega, delta)).unwrap();
    let start = start.state(&system);
    Job { system, start }
}

/// What the command line's `classify` does by default, with a transient of so many forcing periods.
fn schedule(transient: u32) -> Schedule {
    Schedule { transient, observe: 500, max_period: 32, fixed_periods: false }
}

/// ω, δ, and the label with "symmetric" where the motion is.
const FROM_REST: [(f64, f64, &str); 14] = [
    (3.7, 0.1, "1-1-1 symmetric"),
    (3.5, 0.1, "1-1-1"),
    (3.03, 0.1, "quasi-periodic"),
    (2.95, 0.1, "2-2-2"),
    (2.93193, 0.1, "2-2-2"),
    (2.83, 0.1, "chaotic"),
    (1.72, 0.1, "1-2-2 symmetric"),
    (1.65, 0.1, "1-2-2"),
    (1.63, 0.1, "2-4-4"),
    (1.628, 0.1, "2-4-4"),
    (1.626, 0.1, "4-8-8"),
    (0.35, 0.545, "1-5-5 symmetric"),
    (0.3, 0.545, "1-10-10 symmetric"),
    (0.25, 0.545, "1-∞-∞ symmetric"),
];

/// Where near-critical decay needs a long transient, from the symmetric motion.
const FROM_SYMMETRIC: [(f64, f64, &str); 2] =
    [(2.582, 0.6, "1-1-1 symmetric"), (2.57, 0.6, "quasi-periodic")];

fn told(verdict: &Verdict) -> String {
    let symmetric = if verdict.symmetric { " symmetric" } else { "" };
    format!("{}{symmetric}", verdict.label())
}

fn check(run: impl Fn(&[Job], &Schedule) -> Vec<Verdict>) {
    let tables = [(&FROM_REST[..], Start::Rest, 1000), (&FROM_SYMMETRIC[..], Start::Symmetric, 8000)];
    for (table, start, transient) in tables {
        let jobs: Vec<Job> = table.iter().map(|&(omega, delta, _)| job(omega, delta, start)).collect();
        let found: Vec<_> = table
            .iter()
            .zip(run(&jobs, &schedule(transient)))
            .zip(&jobs)
            .map(|((&(omega, delta, _), once), job)| {
                (omega, delta, told(&confirmed(&job.system, &once).unwrap_or(once)))
            })
            .collect();
        let expected: Vec<_> =
            table.iter().map(|&(omega, delta, label)| (omega, delta, label.to_owned())).collect();
        assert_eq!(found, expected);
    }
}

#[test]
fn the_papers_points_have_their_labels() {
    check(|jobs, schedule| Cpu.run(jobs, schedule, &Unwatched).unwrap());
}

#[test]
fn the_papers_points_have_their_labels_in_single_precision() {
    check(|jobs, schedule| jobs.iter().map(|job| follow::<f32>(job, schedule)).collect());
}

#[test]
fn the_papers_points_have_their_labels_on_an_adapter() {
    check(|jobs, schedule| gpu().run(jobs, schedule, &Unwatched).unwrap());
}

/// Impacts that accumulate without dying out, between ω = 0.65 and 0.57: no period, and no rest on a stop.
#[test]
fn incomplete_chatter_neither_repeats_nor_sticks() {
    for omega in [0.65, 0.6, 0.57] {
        let all = Schedule { fixed_periods: true, ..schedule(1000) };
        let verdict = follow::<f64>(&job(omega, 0.1, Start::Rest), &all);
        assert_eq!(verdict.regime, Regime::Chaotic, "{omega}");
        assert!(verdict.impacts > 15 * 500, "{omega}: {verdict:?}");
    }
    // At 0.57 the number of impacts repeats all the same; only their fine structure does not.
    let system = System::new(at(0.57, 0.1)).unwrap();
    let recording = record(&system, REST, 1000, 100, 0);
    assert!(recording.sticks.is_empty());
    for period in 1000..1100 {
        let within = |time: f64| (time / system.period()) as u32 == period;
        for stop in [Stop::A, Stop::B] {
            let impacts = recording.impacts.iter().filter(|i| i.stop == stop && within(i.time));
            assert_eq!(impacts.count(), 15, "period {period}, stop {stop}");
        }
    }
}

/// X* = (x1'+, x2, x2', τ) just after the impact at A: simulated, solved in closed form, and printed.
#[test]
fn the_printed_fixed_point_is_met() {
    let system = System::new(at(3.7, 0.1)).unwrap();
    let recording = record(&system, REST, 2000, 1, 0);
    let impact = recording.impacts.iter().find(|impact| impact.stop == Stop::A).unwrap();
    let simulated = [impact.velocity_after, impact.state[1], impact.state[3], impact.phase];
    let printed = [-0.345457, -0.006341, 0.021160, 1.802134];
    for (ours, theirs) in simulated.iter().zip(printed) {
        assert!((ours - theirs).abs() < 1e-6, "{simulated:?}");
    }
    let solved = symmetric_motions(&system)
        .expect("the motion exists")
        .into_iter()
        .find(|solution| solution.at_phase_zero.is_ok())
        .expect("the motion is physical")
        .motion
        .section();
    for (ours, exact) in simulated.iter().zip(&solved) {
        assert!((ours - exact).abs() < 1e-10, "{simulated:?}, {solved:?}");
    }
}

/// Largest exponents per unit time: positive in chaos, zero on the invariant circle, negative where stable.
#[test]
fn exponents_tell_chaos_from_order() {
    let exponent = |omega: f64| {
        let job = job(omega, 0.1, Start::Rest);
        let schedule = Schedule { transient: 1000, observe: 100_000, max_period: 32, fixed_periods: true };
        f64::from(follow::<f64>(&job, &schedule).lyapunov) / job.system.period()
    };
    let chaotic = exponent(2.83);
    assert!((chaotic - 0.156).abs() < 0.01, "{chaotic}");
    let neutral = exponent(3.03);
    assert!(neutral.abs() < 1e-3, "{neutral}");
    let stable = exponent(3.7);
    assert!(stable < -0.01, "{stable}");
}
