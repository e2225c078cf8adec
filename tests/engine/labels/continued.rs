//! The labels of a plane against the oracle, which goes on from where each cell ended.

use impact_atlas::analysis::{Counts, INFINITELY_MANY, Verdict};
use impact_atlas::backend::{Cpu, Job, Unwatched, decide, follow};
use impact_atlas::model::Parameters;
use rayon::prelude::*;

use super::{at, beside, job, schedule};
use crate::common::oracle::follow::Period;
use crate::common::oracle::{Follower, Plant};

/// How closely a strobe state must return, and how far from itself it must be after a divisor of N.
const SAME: f64 = 2e-6;
/// Forcing periods for which the oracle goes on, at least.
const PERIODS: u32 = 200;

/// What is wrong with a label: the oracle goes on from the end state.
fn fault(job: &Job, verdict: &Verdict) -> Option<String> {
    let plant = Plant::new(job.system.parameters());
    let delta = job.system.parameters().delta;
    let [x1, x2, v1, v2] = verdict.state.into();
    let begins = [x1.clamp(-delta, delta), x2, v1, v2];
    let mut follower = Follower::<f64>::new(plant, begins);
    let n = u32::from(verdict.n);
    let turns = PERIODS.div_ceil(n).max(3);
    let periods: Vec<Period> = (0..turns * n).map(|_| follower.next_period()).collect();
    let strobe = |i: u32| periods[i as usize - 1].strobe;
    let away = |a: [f64; 4], b: [f64; 4]| {
        a.iter().zip(b).map(|(a, b)| (a - b).abs() / (1.0 + b.abs())).fold(0.0, f64::max)
    };
    if let Some(turn) = (1..=turns).find(|turn| away(strobe(turn * n), begins) > SAME) {
        return Some(format!("turn {turn} ends {:e} off", away(strobe(turn * n), begins)));
    }
    let last = (turns - 1) * n;
    if let Some(m) = (1..n).find(|m| n.is_multiple_of(*m) && away(strobe(last + m), strobe(last)) <= SAME) {
        return Some(format!("the period is {m}"));
    }
    let turn = &periods[last as usize..];
    for (side, labelled) in [verdict.p(), verdict.q()].into_iter().enumerate() {
        let endless = turn.iter().any(|period| period.chatters[side] > 0);
        let counted: u32 = turn.iter().map(|period| period.counts()[side]).sum();
        if endless != (labelled == INFINITELY_MANY) || (!endless && counted != u32::from(labelled)) {
            return Some(format!("{counted} impacts at stop {side}, complete chatter {endless}"));
        }
    }
    None
}

#[test]
fn every_label_of_a_plane_is_what_the_oracle_continues() {
    let cells = (0..30).flat_map(|i| (0..24).map(move |j| (i, j)));
    let jobs: Vec<Job> =
        cells.map(|(i, j)| job(at(0.3 + f64::from(i) * 0.15, 0.03 + f64::from(j) * 0.03))).collect();
    let verdicts = decide(&Cpu, &jobs, &schedule(300), &Unwatched).unwrap();
    let periodic: Vec<_> =
        jobs.iter().zip(&verdicts).filter(|(_, verdict)| verdict.regime.is_periodic()).collect();
    assert!(periodic.len() > 400, "{}", periodic.len());
    assert!(periodic.iter().filter(|(_, verdict)| verdict.n > 1).count() > 20);
    let faults: Vec<String> = periodic
        .par_iter()
        .filter_map(|(job, verdict)| {
            let Parameters { omega, delta, .. } = job.system.parameters();
            fault(job, verdict).map(|fault| format!("{} at ({omega}, {delta}): {fault}", verdict.label()))
        })
        .collect();
    assert!(faults.is_empty(), "{} of {}: {faults:#?}", faults.len(), periodic.len());
}

#[test]
fn wrong_labels_are_seen_to_be_wrong() {
    // Taken for what its returns within a ten-thousandth say, a decaying alternation fails.
    let alternating = job(at(1.338_983_050_847_457_6, 0.14));
    let once = follow::<f64>(&beside(&alternating), &schedule(10));
    let right = decide(&Cpu, std::slice::from_ref(&alternating), &schedule(300), &Unwatched).unwrap()[0];
    let naive = Verdict { n: once.returning, counts: Counts::new(&[2 * right.p(), 2 * right.q()]), ..once };
    assert!(fault(&alternating, &naive).unwrap().contains("off"));
    // So do a multiple of the period and a wrong count.
    assert_eq!(fault(&alternating, &right), None);
    assert!(
        fault(&alternating, &Verdict { state: right.state, ..naive }).unwrap().contains("the period is 1")
    );
    assert!(
        fault(&alternating, &Verdict { counts: Counts::new(&[right.p(), right.q() + 1]), ..right })
            .unwrap()
            .contains("impacts at stop 1")
    );
}
