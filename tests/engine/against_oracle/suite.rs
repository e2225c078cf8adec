//! The suite that every back end passes.

use std::collections::BTreeSet;
use std::sync::OnceLock;

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule, Verdict};
use impact_atlas::backend::Job;
use impact_atlas::model::Parameters;
use impact_atlas::theory::confirmed;

use crate::common::cases::Family;
use crate::common::comparison::{Compared, Run, Standard, compare, job, quantile};
use crate::common::conditioning::{cases, deviation};
use crate::common::oracle::settle::{Count, Motion};
use crate::common::settled::{BUDGET, SettledCase, settled_cases};

/// A back end with what it is held to, and what it made of the cases.
#[derive(Debug)]
pub struct Subject {
    /// Follows jobs.
    pub run: Run,
    /// What is demanded.
    pub standard: Standard,
    /// The largest penetration of a stop.
    pub penetration: f64,
    /// A change of r that must not go unnoticed.
    pub defect: f64,
    /// The comparison, made once.
    pub compared: OnceLock<Vec<Compared<'static>>>,
}

/// One test per property for a back end.
macro_rules! instantiate {
    ($name:ident, $run:path, $standard:ident, penetration: $penetration:literal, defect: $defect:literal) => {
        mod $name {
            use std::sync::OnceLock;

            use crate::against_oracle::suite::{self, Subject};
            use crate::common::comparison;

            static SUBJECT: Subject = Subject {
                run: $run,
                standard: comparison::$standard,
                penetration: $penetration,
                defect: $defect,
                compared: OnceLock::new(),
            };

            #[test]
            fn strobe_states_agree() {
                suite::strobe_states_agree(&SUBJECT);
            }

            #[test]
            fn impacts_are_all_found_and_none_twice() {
                suite::impacts_agree(&SUBJECT);
            }

            #[test]
            fn peak_velocities_agree() {
                suite::peak_velocities_agree(&SUBJECT);
            }

            #[test]
            fn narrow_clearances_have_their_peak_velocities() {
                suite::narrow_peaks_agree(&SUBJECT);
            }

            #[test]
            fn no_stop_is_penetrated_and_no_cell_fails() {
                suite::no_stop_is_penetrated(&SUBJECT);
            }

            #[test]
            fn settled_motions_get_their_label() {
                suite::labels_agree(&SUBJECT);
            }

            #[test]
            fn a_wrong_restitution_is_noticed() {
                suite::a_wrong_restitution_is_noticed(&SUBJECT);
            }
        }
    };
}
pub(super) use instantiate;

impl Subject {
    fn compared(&'static self) -> &'static [Compared<'static>] {
        let unchanged = |parameters| parameters;
        self.compared.get_or_init(|| compare(cases(), self.run, &self.standard, &unchanged))
    }
}

/// Fails with the worst cases that offend, each at its first offence.
fn none_of(what: &str, compared: &[Compared<'_>], offends: impl Fn(&Compared<'_>) -> bool) {
    let mut first: Vec<&Compared<'_>> = Vec::new();
    for offence in compared.iter().filter(|c| offends(c)) {
        if first.iter().all(|earlier| !std::ptr::eq(earlier.case, offence.case)) {
            first.push(offence);
        }
    }
    first.sort_by(|a, b| (b.deviation / b.tolerance).total_cmp(&(a.deviation / a.tolerance)));
    let shown: Vec<String> = first.iter().take(10).map(|offence| offence.describe()).collect();
    assert!(first.is_empty(), "{what} in {} cases\n{}", first.len(), shown.join("\n"));
}

/// Strobe states after every checkpoint.
pub fn strobe_states_agree(subject: &'static Subject) {
    let compared = subject.compared();
    let sound = compared.iter().filter(|c| c.tolerance <= subject.standard.tolerance);
    let deviations: Vec<f64> = sound.map(|c| c.deviation).collect();
    for share in [0.5, 0.95, 0.99, 0.999, 1.0] {
        println!(
            "{} states, quantile {share}: {:e}",
            deviations.len(),
            quantile(deviations.iter().copied(), share)
        );
    }
    none_of("strobe states off", compared, |c| !c.agrees());
}

/// Impacts up to every checkpoint, where they can be counted.
pub fn impacts_agree(subject: &'static Subject) {
    let compared = subject.compared();
    let counted: Vec<u32> = compared.iter().filter(|c| c.countable).map(Compared::impacts).collect();
    println!("{} counts of {} impacts", counted.len(), counted.iter().sum::<u32>());
    none_of("impacts miscounted", compared, |c| c.countable && c.verdict.impacts != c.impacts());
}

/// The largest |v1−| up to every checkpoint.
pub fn peak_velocities_agree(subject: &'static Subject) {
    let allowed = |c: &Compared<'_>| (10.0 * c.tolerance).max(1e-6) * (1.0 + c.peak());
    none_of("peak velocities off", subject.compared(), |c| {
        let off = (f64::from(c.verdict.peak_impact_velocity) - c.peak()).abs();
        c.countable && (off.is_nan() || off > allowed(c))
    });
}

/// The largest |v1−| across narrow clearances, whose impacts are too weak to be missed by anything else.
pub fn narrow_peaks_agree(subject: &'static Subject) {
    let off = narrow_peaks_off(subject.compared());
    for share in [0.5, 0.9, 1.0] {
        println!("{} peaks, quantile {share}: {:e}", off.len(), quantile(off.iter().copied(), share));
    }
    assert!(off.len() > 100 && off.iter().all(|&off| off < 1e-4), "{off:?}");
    // The negative control: with a clearance wider by a hundredth most peaks are off.
    let narrow: Vec<_> = cases().iter().filter(|case| case.family == Family::Narrow).cloned().collect();
    let wider = |parameters: Parameters| Parameters { delta: 1.01 * parameters.delta, ..parameters };
    let off = narrow_peaks_off(&compare(&narrow, subject.run, &subject.standard, &wider));
    let noticed = off.iter().filter(|&&off| off >= 1e-4).count();
    assert!(2 * noticed > off.len(), "only {noticed} of {} noticed", off.len());
}

/// By how much of itself the largest |v1−| is off, in every comparison of a narrow clearance that has impacts.
fn narrow_peaks_off(compared: &[Compared<'_>]) -> Vec<f64> {
    let narrow = compared.iter().filter(|c| c.case.family == Family::Narrow && c.impacts() > 0);
    narrow.map(|c| (f64::from(c.verdict.peak_impact_velocity) / c.peak() - 1.0).abs()).collect()
}

/// Strobe states stay between the stops, and the effort within bounds.
pub fn no_stop_is_penetrated(subject: &'static Subject) {
    none_of("stops penetrated", subject.compared(), |c| {
        let reach = c.case.parameters.delta + subject.penetration * (1.0 + c.case.parameters.delta);
        let x1 = c.verdict.state[0].abs();
        x1.is_nan() || x1 > reach
    });
    none_of("failed cells", subject.compared(), |c| c.verdict.regime == Regime::Failed);
}

/// Regime, N-p-q, symmetry and end state of every motion that settles beyond doubt.
pub fn labels_agree(subject: &'static Subject) {
    let schedule =
        Schedule { transient: 2 * BUDGET as u32, observe: 256, max_period: 32, fixed_periods: false };
    let settled: Vec<&SettledCase> =
        settled_cases().iter().filter(|case| case.tame || subject.standard.every_motion).collect();
    let jobs: Vec<Job> = settled.iter().map(|case| job(case.parameters, case.start)).collect();
    // What comes back without having settled is confirmed by its exact motion, as in every map.
    let confirmed = |(job, verdict): (&Job, Verdict)| confirmed(&job.system, &verdict).unwrap_or(verdict);
    let verdicts: Vec<Verdict> = jobs.iter().zip((subject.run)(&jobs, &schedule)).map(confirmed).collect();
    let wrong: Vec<String> = settled
        .iter()
        .zip(&verdicts)
        .filter(|(case, verdict)| {
            !matches_motion(&case.settled.motion, verdict)
                || !ends_on(case, verdict, subject.standard.settled)
        })
        .map(|(case, verdict)| format!("{case:?}\n  {} {verdict:?}", verdict.label()))
        .collect();
    let labels: BTreeSet<String> = verdicts.iter().map(Verdict::label).collect();
    println!("{} settled cases with {} labels", settled.len(), labels.len());
    assert!(settled.len() > 300 && labels.len() > 15, "{} cases, {} labels", settled.len(), labels.len());
    let shown = wrong[..wrong.len().min(8)].join("\n");
    assert!(wrong.is_empty(), "{} of {} labels wrong:\n{shown}", wrong.len(), settled.len());
}

fn matches_motion(motion: &Motion, verdict: &Verdict) -> bool {
    let none = motion.p == Count::Finite(0) && motion.q == Count::Finite(0) && !motion.sticks;
    if none {
        return verdict.regime == Regime::NoImpact;
    }
    let regime = if motion.sticks { Regime::PeriodicSticking } else { Regime::Periodic };
    verdict.regime == regime
        && u32::from(verdict.n) == motion.n
        && count(verdict.p()) == motion.p
        && count(verdict.q()) == motion.q
        && verdict.symmetric == motion.symmetric
}

fn count(impacts: u16) -> Count {
    if impacts == INFINITELY_MANY { Count::Infinite } else { Count::Finite(u32::from(impacts)) }
}

/// Whether the end state is a strobe state of the motion; a motion without impacts may end on the way to it.
fn ends_on(case: &SettledCase, verdict: &Verdict, tolerance: f64) -> bool {
    verdict.regime == Regime::NoImpact
        || case.settled.strobes.iter().any(|strobe| deviation(&verdict.state, strobe) < tolerance)
}

/// The negative control: with r wrong by a little, most trajectories that impact are off.
pub fn a_wrong_restitution_is_noticed(subject: &'static Subject) {
    // Across a narrow clearance impacts are weak, and little depends on them.
    let strong = cases().iter().filter(|case| case.family != Family::Narrow);
    let some: Vec<_> = strong.step_by(5).cloned().collect();
    let compared = compare(&some, subject.run, &subject.standard, &|mut parameters| {
        parameters.r += if parameters.r < 0.5 { subject.defect } else { -subject.defect };
        parameters
    });
    let impacting: Vec<_> = compared.iter().filter(|c| c.impacts() > 0).collect();
    let noticed = impacting.iter().filter(|c| !c.agrees()).count();
    println!("{noticed} of {} noticed", impacting.len());
    assert!(2 * noticed > impacting.len(), "only {noticed} of {} noticed", impacting.len());
    let quiet = compared.iter().filter(|c| c.impacts() == 0 && c.countable);
    assert!(quiet.into_iter().all(Compared::agrees), "without impacts r has no effect");
}
