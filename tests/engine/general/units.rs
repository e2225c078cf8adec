//! The unit of length is the user's: labels are the same in metres and in micrometres, on every back end.

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, CpuSingle, Job, Unwatched, decide};
use impact_atlas::model::{StateVector, System};

use crate::common::adapter::open_exact;
use crate::common::general::draw::{Setup, setups};
use crate::common::scaled::scaled;

const SCHEDULE: Schedule = Schedule { transient: 300, observe: 100, max_period: 16, fixed_periods: false };

/// So many units of length are taken for one: a power of two, so that nothing is rounded.
fn job(Setup { plant, start }: &Setup, unit: f64) -> Job {
    let system = System::of_plant(scaled(plant, unit)).unwrap();
    let start: Vec<f64> = start.iter().map(|value| value * unit).collect();
    Job { system, start: StateVector::from_slice(&start).unwrap() }
}

fn decided(backend: &dyn Backend, setups: &[Setup], unit: f64) -> Vec<Verdict> {
    let jobs: Vec<Job> = setups.iter().map(|setup| job(setup, unit)).collect();
    decide(backend, &jobs, &SCHEDULE, &Unwatched).unwrap()
}

/// A verdict in the units that were taken for one, as it is written.
fn in_units(verdict: &Verdict, unit: f64) -> String {
    let mut verdict = *verdict;
    let state: Vec<f64> = verdict.state.iter().map(|value| value / unit + 0.0).collect();
    verdict.state = StateVector::from_slice(&state).unwrap();
    verdict.peak_impact_velocity /= unit as f32;
    verdict.measures.power /= (unit * unit) as f32;
    format!("{verdict:?}")
}

fn label(verdict: &Verdict) -> String {
    format!("{:?} {} {:?} {}", verdict.regime, verdict.n, verdict.counts, verdict.symmetric)
}

/// How many of the first verdicts name a regular motion, and which of the others differ from them in that.
fn told_otherwise(first: &[Verdict], others: &[Verdict]) -> (usize, Vec<String>) {
    let regular = |verdict: &Verdict| verdict.regime.is_periodic() || verdict.regime == Regime::NoImpact;
    let pairs: Vec<_> =
        first.iter().zip(others).enumerate().filter(|(_, (first, _))| regular(first)).collect();
    let otherwise = pairs.iter().filter(|(_, (first, other))| label(first) != label(other));
    let told = otherwise.map(|(i, (first, other))| format!("{i}: {} for {}", label(other), label(first)));
    (pairs.len(), told.collect())
}

#[test]
fn labels_do_not_depend_on_the_unit_of_length() {
    let setups = setups(400, 0x0_11_75);
    let [own, small, smaller] = [0, -20, -50].map(|exponent| {
        let unit = 2f64.powi(exponent);
        let verdicts = decided(&Cpu, &setups, unit);
        (unit, verdicts)
    });
    let (regular, otherwise) = told_otherwise(&own.1, &small.1);
    println!("{regular} regular motions, {} told otherwise: {otherwise:#?}", otherwise.len());
    assert!(regular > 200 && 100 * otherwise.len() <= regular, "{regular}");
    // Below that everything is the same but for the factor.
    // Where nothing says what is large, or a motion grows beyond all bounds, no unit is as good as another.
    let has_size = |i: usize| job(&setups[i], small.0).system.unit() < 1.0;
    let ends = |verdict: &Verdict| verdict.state.iter().all(|value| value.abs() < 1e17);
    let pairs = small.1.iter().zip(&smaller.1).enumerate();
    let bounded = pairs.filter(|(i, (verdict, _))| has_size(*i) && ends(verdict));
    let off = bounded.filter_map(|(i, (a, b))| {
        let (a, b) = (in_units(a, small.0), in_units(b, smaller.0));
        (a != b).then(|| format!("{i}: {a}\n{b}\n{:?}", setups[i]))
    });
    let off: Vec<String> = off.collect();
    assert!(off.is_empty(), "{} differ: {}", off.len(), off[..off.len().min(3)].join("\n"));
}

#[test]
fn nor_do_they_in_single_precision_and_every_adapter_says_the_same() {
    let mut setups = setups(800, 0x0_11_76);
    // One shape, so that one shader is compiled.
    setups.retain(|setup| setup.plant.n == 2 && setup.plant.stops.len() == 1);
    let own = decided(&CpuSingle, &setups, 1.0);
    let unit = 2f64.powi(-16);
    let small = decided(&CpuSingle, &setups, unit);
    let (regular, otherwise) = told_otherwise(&own, &small);
    println!("{regular} regular motions, {} told otherwise: {otherwise:#?}", otherwise.len());
    assert!(regular > 60 && 20 * otherwise.len() <= regular, "{regular}");
    let shown = decided(&open_exact(), &setups, unit);
    for (cpu, gpu) in small.iter().zip(&shown) {
        assert_eq!(in_units(cpu, unit), in_units(gpu, unit));
    }
}
