//! A mass that is released and thrown across a narrow clearance, f64: the impact at the other stop is found where it is.

use impact_atlas::dynamics::{Stop, record};
use impact_atlas::model::System;

use crate::common::cases::Family;
use crate::common::cases::{Setup, thrown};
use crate::common::conditioning::cases;
use crate::common::oracle::follow::Period;
use crate::common::oracle::{self, Follower, Plant};

/// An impact: time since the start, whether it is at A, v1−.
type Hit = (f64, bool, f64);

/// The impacts of the oracle in some forcing periods after some others. Those slower than `slow` are left out: they are
/// the chatter's, which the engine closes sooner than the oracle.
fn exact(setup: &Setup, transient: usize, periods: usize, slow: f64) -> Vec<Hit> {
    let mut follower = Follower::<f64>::new(Plant::new(setup.parameters), setup.start);
    let followed: Vec<Period> = (0..transient + periods).map(|_| follower.next_period()).collect();
    let period = std::f64::consts::TAU / setup.parameters.omega;
    let hits = followed.iter().enumerate().skip(transient).flat_map(|(i, followed)| {
        let began = i as f64 * period;
        followed
            .impacts
            .iter()
            .map(move |hit| (began + hit.time, hit.stop == oracle::Stop::Plus, hit.velocity_before))
    });
    hits.filter(|hit| hit.2.abs() > slow).collect()
}

fn recorded(setup: &Setup, transient: u32, periods: u32, slow: f64) -> Vec<Hit> {
    let system = System::new(setup.parameters).unwrap();
    let recording = record(&system, setup.start, transient, periods, 2000);
    let delta = setup.parameters.delta;
    assert!(
        recording.samples.iter().all(|sample| sample.state[0].abs() <= delta * (1.0 + 1e-9)),
        "{setup:?}"
    );
    let hits = recording.impacts.iter().map(|hit| (hit.time, hit.stop == Stop::A, hit.velocity_before));
    hits.filter(|hit| hit.2.abs() > slow).collect()
}

fn assert_same(ours: &[Hit], theirs: &[Hit]) {
    for (ours, theirs) in ours.iter().zip(theirs) {
        let slow = 1.0 / theirs.2.abs();
        assert_eq!(ours.1, theirs.1, "{ours:?} {theirs:?}");
        assert!((ours.0 - theirs.0).abs() <= 1e-9 * slow, "{ours:?} {theirs:?}");
        assert!((ours.2 - theirs.2).abs() <= 1e-9 * slow, "{ours:?} {theirs:?}");
    }
    assert_eq!(ours.len(), theirs.len());
}

#[test]
fn a_mass_thrown_across_hits_the_other_stop() {
    let [setup, ..] = thrown();
    let (ours, theirs) = (recorded(&setup, 0, 2, 1e-3), exact(&setup, 0, 2, 1e-3));
    for hits in [&ours, &theirs] {
        let thrown = hits.iter().find(|hit| (hit.0 - 3.23865).abs() < 1e-5);
        let Some(&(_, at_a, velocity)) = thrown else { panic!("no impact at 3.23865: {hits:?}") };
        assert!(at_a && (velocity - 0.00717).abs() < 1e-5, "{velocity}");
    }
    assert_same(&ours, &theirs);
}

#[test]
fn the_settled_motion_has_the_exact_impacts() {
    let [_, setup, _] = thrown();
    let (ours, theirs) = (recorded(&setup, 300, 2, 1e-3), exact(&setup, 300, 2, 1e-3));
    for hits in [&ours, &theirs] {
        let peak = hits.iter().map(|hit| hit.2.abs()).fold(0.0, f64::max);
        assert!((peak - 0.00708).abs() < 5e-6, "{peak}");
    }
    assert_same(&ours, &theirs);
}

#[test]
fn the_resonant_motion_has_the_exact_impacts() {
    let [_, _, setup] = thrown();
    let (ours, theirs) = (recorded(&setup, 0, 20, 0.02), exact(&setup, 0, 20, 0.02));
    assert_same(&ours, &theirs);
    assert!(theirs.len() > 50, "{}", theirs.len());
}

/// That they are drawn does not mean that they are compared.
#[test]
fn narrow_clearances_are_compared_in_either_precision() {
    let narrow: Vec<_> = cases().iter().filter(|case| case.family == Family::Narrow).collect();
    let fine: usize = narrow.iter().map(|case| case.fine.periods).sum();
    let coarse: usize = narrow.iter().map(|case| case.coarse.periods).sum();
    let counted: usize = narrow.iter().map(|case| case.fine.countable).sum();
    println!("{} cases, {fine} periods in f64, {counted} of them counted, {coarse} in f32", narrow.len());
    assert!(narrow.len() > 55 && fine > 1000 && coarse > 200, "{} {fine} {coarse}", narrow.len());
}
