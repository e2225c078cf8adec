//! Comparisons of maps made by hand, some of which must fail.

use super::*;
use crate::analysis::{Regime, Schedule, Verdict};
use crate::backend::{self, Backend, Job, Unwatched, Watch};
use crate::plane::{Plane, Provenance, RegionMap, Start};

const COLUMNS: u32 = 20;
const ROWS: u32 = 10;

fn motion(n: u16, symmetric: bool) -> Verdict {
    Verdict {
        lyapunov: -0.25,
        state: [0.05, -0.01, 0.3, 0.02].into(),
        impacts: 400,
        peak_impact_velocity: 0.4,
        periods: 600,
        ..Verdict::of_motion(Regime::Periodic, [n; 3], symmetric)
    }
}

fn of_regime(regime: Regime) -> Verdict {
    Verdict { regime, n: 0, counts: crate::analysis::Counts::default(), lyapunov: 0.125, ..motion(1, false) }
}

/// A map whose left half is 1-1-1 symmetric and whose right half is what is given.
fn halves(right: Verdict) -> RegionMap {
    let schedule = Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false };
    let (x, y) = (format!("omega=1:3:{COLUMNS}"), format!("delta=0.1:0.4:{ROWS}"));
    let plane = Plane::of_paper(&x, &y, Start::Rest, schedule).unwrap();
    let verdict = |index| if index % COLUMNS < COLUMNS / 2 { motion(1, true) } else { right };
    RegionMap::new(plane, Provenance::default(), (0..COLUMNS * ROWS).map(verdict).collect())
}

/// The thresholds that are not met.
fn failing(agreement: &Agreement) -> Vec<&'static str> {
    let thresholds = Thresholds::default();
    let failing: Vec<_> =
        agreement.checks(&thresholds).iter().filter(|check| !check.holds).map(|check| check.name).collect();
    assert_eq!(agreement.holds(&thresholds), failing.is_empty());
    failing
}

fn cell(column: u32, row: u32) -> usize {
    (row * COLUMNS + column) as usize
}

#[test]
fn a_map_agrees_with_itself() {
    let map = halves(of_regime(Regime::Chaotic));
    let agreement = compare(&map, &map);
    assert_eq!(failing(&agreement), [""; 0]);
    // Nine columns of ten are inside on either side of the boundary, the plane's edge being none.
    assert_eq!(agreement.inside, Share { agree: 180, cells: 180 });
    assert_eq!(agreement.boundary, Share { agree: 20, cells: 20 });
    assert_eq!(agreement.non_chaotic, Share { agree: 100, cells: 100 });
    assert_eq!(agreement.end_state, Some(Spread { cells: 100, median: 0.0, p95: 0.0, max: 0.0 }));
    assert_eq!((agreement.confusion[2][2], agreement.confusion[5][5]), (100, 100));
    assert_eq!(agreement.regimes.iter().map(|r| r.regime).collect::<Vec<_>>(), ["periodic", "chaotic"]);
    assert_eq!(agreement.regimes[1].end_state, None);
    assert_eq!(agreement.worst, []);
    // Where nothing was compared, nothing agrees.
    let none = Share { agree: 0, cells: 0 };
    let nothing = Agreement { inside: none, non_chaotic: none, end_state: None, ..agreement };
    assert_eq!(failing(&nothing), ["cells compared"]);
}

/// Where nothing begins there is nothing to agree on, however large a part of the plane that is.
#[test]
fn inadmissible_cells_are_not_compared() {
    let reference = halves(of_regime(Regime::Inadmissible));
    let agreement = compare(&reference, &reference);
    assert_eq!(failing(&agreement), [""; 0]);
    assert_eq!(agreement.inside, Share { agree: 90, cells: 90 });
    assert_eq!(agreement.boundary, Share { agree: 10, cells: 10 });
    assert_eq!(agreement.non_chaotic, Share { agree: 100, cells: 100 });
    assert_eq!(agreement.confusion[8][8], 100);
    assert_eq!(agreement.regimes.iter().map(|r| r.regime).collect::<Vec<_>>(), ["periodic"]);
    assert!(agreement.layers.iter().all(|layer| layer.defined.cells == 100));
    // A back end that lets begin what may not is found.
    let mut candidate = reference.clone();
    candidate.verdicts[cell(15, 3)] = motion(1, true);
    let agreement = compare(&reference, &candidate);
    assert_eq!(agreement.inside, Share { agree: 90, cells: 91 });
    assert_eq!(failing(&agreement), ["agreement inside regions"]);
}

#[test]
fn another_label_inside_a_region_fails() {
    let reference = halves(of_regime(Regime::Chaotic));
    let mut candidate = reference.clone();
    candidate.verdicts[cell(3, 3)] = motion(2, true);
    let agreement = compare(&reference, &candidate);
    assert_eq!(failing(&agreement), ["agreement inside regions"]);
    assert_eq!(agreement.inside, Share { agree: 179, cells: 180 });
    assert_eq!(agreement.confusion[2][2], 100, "the regime is the same");
    assert_eq!(agreement.worst.len(), 1);
    let worst = &agreement.worst[0];
    assert_eq!((worst.column, worst.row, worst.fault), (3, 3, Fault::LabelInside));
    assert_eq!((worst.reference.n, worst.candidate.n), (1, 2));
}

#[test]
fn a_boundary_may_move_by_a_cell_but_not_everywhere() {
    let reference = halves(of_regime(Regime::Chaotic));
    let mut candidate = reference.clone();
    for row in 0..3 {
        candidate.verdicts[cell(9, row)] = of_regime(Regime::Chaotic);
    }
    let agreement = compare(&reference, &candidate);
    assert_eq!(failing(&agreement), [""; 0]);
    assert_eq!(agreement.boundary, Share { agree: 17, cells: 20 });
    assert_eq!(agreement.confusion[2][5], 3);
    // Of a hundred cells chance accounts for six.
    for row in 3..7 {
        candidate.verdicts[cell(9, row)] = of_regime(Regime::QuasiPeriodic);
    }
    assert_eq!(failing(&compare(&reference, &candidate)), ["agreement of non-chaotic cells"]);
}

#[test]
fn a_failed_cell_fails_even_where_both_failed() {
    let mut reference = halves(of_regime(Regime::Chaotic));
    reference.verdicts[cell(0, 0)] = of_regime(Regime::Failed);
    let agreement = compare(&reference, &reference);
    assert_eq!(failing(&agreement), ["failed cells"]);
    assert_eq!(agreement.failed, FailedCells { reference: 1, candidate: 1 });
    assert_eq!(agreement.worst[0].fault, Fault::Failed);
}

#[test]
fn end_states_that_are_off_fail() {
    let reference = halves(of_regime(Regime::Chaotic));
    let shifted = |cells: u32, by: f64| {
        let mut candidate = reference.clone();
        for verdict in (0..cells).map(|i| cell(i % 10, i / 10)) {
            candidate.verdicts[verdict].state[3] -= by;
        }
        compare(&reference, &candidate)
    };
    assert_eq!(failing(&shifted(100, 1e-5)), [""; 0]);
    assert_eq!(failing(&shifted(51, 5e-5)), ["end state, median difference"]);
    assert_eq!(failing(&shifted(6, 5e-4)), ["end state, 95th percentile"]);
    assert_eq!(failing(&shifted(5, 5e-4)), [""; 0]);
    let agreement = shifted(1, 0.5);
    assert!((agreement.end_state.unwrap().max - 0.5).abs() < 1e-12, "a symmetric 1-1-1 is never a stray");
    assert_eq!((agreement.worst[0].fault, agreement.worst[0].column), (Fault::EndState, 0));
    assert_eq!(failing(&shifted(6, f64::NAN)), ["end state, 95th percentile"]);
}

#[test]
fn exponents_and_symmetry_are_reported() {
    let reference = halves(of_regime(Regime::Chaotic));
    let mut candidate = reference.clone();
    candidate.verdicts[cell(15, 5)].lyapunov = 0.375;
    candidate.verdicts[cell(2, 5)].symmetric = false;
    let agreement = compare(&reference, &candidate);
    assert_eq!(agreement.regimes[1].lyapunov, Some(Spread { cells: 100, median: 0.0, p95: 0.0, max: 0.25 }));
    assert_eq!(agreement.symmetry, Share { agree: 99, cells: 100 });
}

#[test]
fn infinite_exponents_that_are_equal_do_not_differ() {
    let mut reference = halves(of_regime(Regime::Chaotic));
    for verdict in &mut reference.verdicts {
        verdict.lyapunov = f32::NEG_INFINITY;
    }
    assert_eq!(compare(&reference, &reference).regimes[0].lyapunov.unwrap().max, 0.0);
}

#[test]
fn exponents_that_were_not_measured_are_not_counted() {
    let mut reference = halves(of_regime(Regime::Chaotic));
    for verdict in &mut reference.verdicts {
        verdict.lyapunov = f32::NAN;
    }
    assert!(compare(&reference, &reference).regimes.iter().all(|regime| regime.lyapunov.is_none()));
    // One that only one of the two measured is as wrong as can be.
    let mut candidate = reference.clone();
    candidate.verdicts[cell(15, 5)].lyapunov = 0.125;
    let regimes = compare(&reference, &candidate).regimes;
    let counted: Vec<_> = regimes.iter().filter_map(|regime| regime.lyapunov).collect();
    assert_eq!((counted.len(), counted[0].cells, counted[0].max), (1, 1, f64::INFINITY));
}

/// Knows a right end state: continues to it from near by, otherwise loses the motion.
#[derive(Debug)]
struct Attractor {
    state: [f64; 4],
}

impl Backend for Attractor {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        String::new()
    }

    fn tile(&self) -> usize {
        7
    }

    fn run(&self, jobs: &[Job], schedule: &Schedule, _: &dyn Watch) -> backend::Result<Vec<Verdict>> {
        assert!(jobs.len() <= self.tile());
        assert_eq!((schedule.transient, schedule.observe % 2, schedule.fixed_periods), (0, 0, true));
        Ok(jobs.iter().map(|job| self.follow(job)).collect())
    }
}

impl Attractor {
    fn follow(&self, job: &Job) -> Verdict {
        let near = job.start.iter().zip(self.state.iter()).all(|(a, b)| (a - b).abs() < 0.01);
        if near {
            Verdict { state: self.state.into(), ..motion(2, false) }
        } else {
            of_regime(Regime::Chaotic)
        }
    }
}

#[test]
fn another_phase_is_right_only_if_the_reference_stays_there() {
    let reference = halves(motion(2, false));
    let other_phase = [-0.04, 0.02, -0.2, 0.01];
    let mut candidate = reference.clone();
    for row in 0..ROWS {
        candidate.verdicts[cell(14, row)].state = other_phase.map(|x| x + 1e-6).into();
    }
    assert_eq!(strays(&reference, &candidate).len(), 10);
    assert_eq!(failing(&compare(&reference, &candidate)), [""; 0], "ten of 200 are not the 95th percentile");
    assert!(compare(&reference, &candidate).end_state.unwrap().max > 0.1, "but they count");

    let backend = Attractor { state: other_phase };
    let continued = continue_strays(&reference, &candidate, &backend, &Unwatched).unwrap();
    let agreement = compare_continued(&reference, &candidate, &continued);
    assert_eq!(agreement.continued, 10);
    assert!((agreement.end_state.unwrap().max - 1e-6).abs() < 1e-12);

    let elsewhere = Attractor { state: [0.0, 0.5, 0.0, 0.5] };
    let continued = continue_strays(&reference, &candidate, &elsewhere, &Unwatched).unwrap();
    let agreement = compare_continued(&reference, &candidate, &continued);
    assert_eq!(agreement.continued, 0);
    assert!(agreement.end_state.unwrap().max > 0.1, "a state the reference does not stay near is an error");
}

#[test]
fn layers_that_differ_are_told() {
    let reference = halves(of_regime(Regime::Chaotic));
    let row = |candidate: &RegionMap, name: &str| {
        let agreement = compare(&reference, candidate);
        agreement.layers.into_iter().find(|row| row.layer == name).unwrap()
    };
    let same = row(&reference, "peak_impact_velocity");
    assert_eq!(same.difference, Some(Spread { cells: 200, median: 0.0, p95: 0.0, max: 0.0 }));
    assert_eq!((same.relative, same.defined), (false, Share { agree: 200, cells: 200 }));
    let mut candidate = reference.clone();
    candidate.verdicts[cell(3, 3)].peak_impact_velocity = 0.5;
    candidate.verdicts[cell(4, 3)].peak_impact_velocity = 0.0;
    candidate.verdicts[cell(5, 3)].n = 2;
    let other = row(&candidate, "peak_impact_velocity");
    assert!((other.difference.unwrap().max - 0.1).abs() < 1e-6);
    assert_eq!(other.defined, Share { agree: 198, cells: 199 }, "a cell of another label does not count");
}
