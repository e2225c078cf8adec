//! The validation against back ends that are right, rounded, and wrong on purpose.

use impact_atlas::analysis::{Counts, Schedule, Verdict};
use impact_atlas::backend::{Backend, BackendError, Cpu, Job, Unwatched, Watch, follow};
use impact_atlas::model::{Parameters, System};
use impact_atlas::plane::{Plane, Start};
use impact_atlas::sweep::sweep;
use impact_atlas::validate::{Agreement, Thresholds, compare_continued, continue_strays, tipped};

/// The reference with something done to its jobs or in its arithmetic.
#[derive(Debug)]
struct Altered(fn(&Job, &Schedule) -> Verdict);

impl Backend for Altered {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        "altered".to_owned()
    }

    fn tile(&self) -> usize {
        100
    }

    fn run(&self, jobs: &[Job], schedule: &Schedule, _: &dyn Watch) -> Result<Vec<Verdict>, BackendError> {
        Ok(jobs.iter().map(|job| (self.0)(job, schedule)).collect())
    }
}

fn single_precision(job: &Job, schedule: &Schedule) -> Verdict {
    follow::<f32>(job, schedule)
}

fn restitution_a_little_low(job: &Job, schedule: &Schedule) -> Verdict {
    let parameters = job.system.parameters();
    let system = System::new(Parameters { r: parameters.r - 1e-3, ..parameters }).unwrap();
    follow::<f64>(&Job { system, start: job.start }, schedule)
}

fn exponent_too_low(job: &Job, schedule: &Schedule) -> Verdict {
    let mut verdict = follow::<f64>(job, schedule);
    verdict.lyapunov -= 0.1;
    verdict
}

fn one_label_for_another(job: &Job, schedule: &Schedule) -> Verdict {
    let mut verdict = follow::<f64>(job, schedule);
    verdict.counts = Counts::new(&[verdict.p() + u16::from(verdict.regime.is_periodic()), verdict.q()]);
    verdict
}

fn validate(candidate: &dyn Backend) -> Agreement {
    let plane = Plane {
        x: "omega=2.4:4.4:40".parse().unwrap(),
        y: "delta=0.05:0.3:25".parse().unwrap(),
        parameters: Parameters::default().into(),
        start: Start::Symmetric,
        task: Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false },
    };
    let ours = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let theirs = sweep(&plane, candidate, &Unwatched).unwrap();
    let continued = continue_strays(&ours, &theirs, &Cpu, &Unwatched).unwrap();
    compare_continued(&ours, &theirs, &continued)
}

#[test]
fn single_precision_agrees() {
    let agreement = validate(&Altered(single_precision));
    assert!(agreement.holds(&Thresholds::default()), "{:#?}", agreement.checks(&Thresholds::default()));
}

/// Where chaos leaves the choice among motions to chance, many cells of a coarse plane are decided by rounding.
fn ragged() -> Plane {
    Plane {
        x: "mu_m=0.1:0.9:10".parse().unwrap(),
        y: "zeta=0.01:0.3:10".parse().unwrap(),
        parameters: Parameters { omega: 2.4, ..Parameters::default() }.into(),
        start: Start::Symmetric,
        task: Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false },
    }
}

#[test]
fn cells_that_the_reference_is_not_sure_of_do_not_count() {
    let held = |candidate: &dyn Backend| {
        let ours = sweep(&ragged(), &Cpu, &Unwatched).unwrap();
        let theirs = sweep(&ragged(), candidate, &Unwatched).unwrap();
        let continued = continue_strays(&ours, &theirs, &Cpu, &Unwatched).unwrap();
        let agreement = compare_continued(&ours, &theirs, &continued);
        let examined = tipped(&ours, &theirs, &Cpu, &Unwatched).unwrap();
        // The share of many cells, whatever chance allows so few.
        let label_checks = |agreement: &Agreement| {
            let checks = agreement.checks(&Thresholds::default());
            let labels = checks.iter().filter(|check| check.name.starts_with("agreement"));
            let many = [Thresholds::default().inside, Thresholds::default().non_chaotic];
            labels.zip(many).all(|(check, many)| check.value.is_none_or(|value| value >= many))
        };
        (label_checks(&agreement), label_checks(&agreement.leaving_out(&ours, &examined)))
    };
    assert_eq!(held(&Altered(single_precision)), (false, true));
    // Labels that are wrong where the reference is sure stay wrong.
    assert_eq!(held(&Altered(one_label_for_another)), (false, false));
}

#[test]
fn a_wrong_constant_is_found() {
    let agreement = validate(&Altered(restitution_a_little_low));
    assert!(!agreement.holds(&Thresholds::default()));
    let failing: Vec<_> = agreement.checks(&Thresholds::default()).into_iter().filter(|c| !c.holds).collect();
    assert!(failing.iter().any(|check| check.name.starts_with("end state")), "{failing:?}");
    assert!(!agreement.worst.is_empty());
}

#[test]
fn wrong_exponents_are_seen_in_the_report() {
    let agreement = validate(&Altered(exponent_too_low));
    let periodic = agreement.regimes.iter().find(|regime| regime.regime == "periodic").unwrap();
    assert!(periodic.lyapunov.unwrap().median > 1e-2);
}
