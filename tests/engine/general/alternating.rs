//! Motions of several forcing periods that hardly differ from one to the next: by as little as counts as a return.

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule};
use impact_atlas::backend::{Backend, Cpu, CpuSingle, Job, Unwatched, decide};
use impact_atlas::model::{StateVector, System};
use impact_atlas::system::{Family, Setting};

use crate::common::general::Follower;

/// Four masses in a row, each with a stop. Rebounds at the second go on for 37 or 38 impacts, by turns of two periods, and what
/// that changes of the state a period later is a ten-thousandth.
const FAMILY: &str = r#"
name = "four masses in a row"
[parameters]
omega = { default = 0.66, above = 0 }
g1 = 0.25
[system]
frequency = "omega"
mass = [["1.418", "0", "0", "0"], ["0", "1.433", "0", "0"], ["0", "0", "0.542", "0"], ["0", "0", "0", "0.318"]]
damping = [
  ["0.30138", "-0.13151", "0", "0"], ["-0.13151", "0.4673", "-0.33578", "0"],
  ["0", "-0.33578", "0.62601", "-0.29022"], ["0", "0", "-0.29022", "0.54645"],
]
stiffness = [
  ["2.216", "-0.967", "0", "0"], ["-0.967", "3.436", "-2.469", "0"],
  ["0", "-2.469", "4.603", "-2.134"], ["0", "0", "-2.134", "4.018"],
]
force_cos = ["-0.601", "0.638", "0.596", "0.838"]
force_sin = ["0", "0", "0.979", "0"]
[[stop]]
name = "first"
direction = ["-1", "0", "0", "0"]
gap = "g1"
restitution = "0.8"
[[stop]]
name = "second"
direction = ["0", "1", "0", "0"]
gap = "0.05"
restitution = "0.9"
[[stop]]
name = "third"
direction = ["0", "0", "-1", "0"]
gap = "0"
restitution = "0.5"
[[stop]]
name = "fourth"
direction = ["0", "0", "0", "1"]
gap = "0"
restitution = "0.8"
"#;

/// How far states of the oracle are from where it began, after each of some periods.
fn returns(system: &System, start: &StateVector, periods: usize) -> Vec<f64> {
    let mut oracle = Follower::new(system.plant().clone(), start);
    let away = |strobe: &[f64]| {
        strobe.iter().zip(start.iter()).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    (0..periods).map(|_| away(&oracle.next_period().strobe)).collect()
}

#[test]
fn an_alternation_as_small_as_a_return_is_a_period() {
    let setting = Setting::defaults(Family::kept(FAMILY, "row.toml").unwrap());
    let system = System::new(setting).unwrap();
    let schedule = Schedule { transient: 150, observe: 100, max_period: 32, fixed_periods: false };
    let job = Job { system: system.clone(), start: StateVector::zeros(4) };
    for backend in [&Cpu as &dyn Backend, &CpuSingle] {
        let verdict = decide(backend, std::slice::from_ref(&job), &schedule, &Unwatched).unwrap().remove(0);
        let name = backend.name();
        assert_eq!((verdict.regime, verdict.n), (Regime::PeriodicSticking, 4), "{name}: {verdict:?}");
        assert_eq!(verdict.counts[..], [0, 150, INFINITELY_MANY, INFINITELY_MANY], "{name}");
        let away = returns(&system, &verdict.state, 4);
        let rounding = if name == Cpu.name() { 1e-9 } else { 1e-5 };
        assert!(away[3] < rounding, "{name}: {away:?}");
        // What a period may end with: a shorter one would be taken for the motion's own.
        assert!(away[..3].iter().all(|&away| away > 3e-5 && away < 3e-4), "{name}: {away:?}");
    }
}
