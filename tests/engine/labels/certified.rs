//! Certified maps: what the exact orbits confirm, and what they do not.

use std::ops::Range;

use impact_atlas::analysis::{Counts, Regime, Verdict};
use impact_atlas::backend::{Cpu, Unwatched};
use impact_atlas::model::{Parameters, Setting, StateVector, System};
use impact_atlas::plane::{Axis, Plane, RegionMap, Start, Window};
use impact_atlas::sweep::{Certification, certify, certify_window, sweep};
use impact_atlas::system::Family;
use impact_atlas::theory::SettledMotion;

use super::schedule;

const COLUMNS: usize = 12;

fn map() -> RegionMap {
    let plane = Plane {
        x: "omega=2.6:4:12".parse().unwrap(),
        y: "delta=0.06:0.3:8".parse().unwrap(),
        parameters: Parameters::default().into(),
        start: Start::Symmetric,
        task: schedule(300),
    };
    sweep(&plane, &Cpu, &Unwatched).unwrap()
}

fn system(map: &RegionMap, cell: usize) -> System {
    let (column, row) = ((cell % COLUMNS) as u32, (cell / COLUMNS) as u32);
    System::new(map.plane.parameters_at(column, row)).unwrap()
}

fn periodic(map: &RegionMap) -> Vec<usize> {
    (0..map.verdicts.len()).filter(|&cell| map.verdicts[cell].regime.is_periodic()).collect()
}

fn certified(mut map: RegionMap) -> (RegionMap, Certification) {
    let counts = certify(&mut map, &Cpu, &Unwatched).unwrap();
    (map, counts)
}

fn label(verdict: &Verdict) -> (String, bool) {
    (verdict.label(), verdict.symmetric)
}

#[test]
fn every_periodic_cell_gets_the_multipliers_of_its_orbit() {
    let before = map();
    let (after, counts) = certified(before.clone());
    let cells = periodic(&before);
    assert!(cells.len() > 40 && cells.len() < before.verdicts.len());
    assert_eq!(counts.periodic, cells.len() as u64);
    assert_eq!((counts.confirmed, counts.relabelled, counts.unresolved), (counts.periodic, 0, 0));
    let multipliers = after.multipliers.as_ref().unwrap();
    for (cell, found) in multipliers.iter().enumerate() {
        assert_eq!(found.is_some(), cells.contains(&cell));
        let Some(found) = found else { continue };
        let verdict = &after.verdicts[cell];
        let [re, im] = found[0];
        let exponent = re.hypot(im).ln() / f64::from(verdict.n);
        assert!(exponent < 0.0 && (f64::from(verdict.lyapunov) - exponent).abs() < 1e-6);
        // The other way to solve a motion, by its impacts, has the same multipliers.
        let system = system(&after, cell);
        let Ok(SettledMotion::Impacts(motion)) = SettledMotion::of(&system, verdict) else { continue };
        let largest = motion.multipliers(&system).unwrap()[0];
        assert!((largest.norm() - re.hypot(im)).abs() < 1e-6, "{largest} at cell {cell}");
    }
}

/// Certifies the map with something planted in its first few cells of a label; those cells, before and after.
fn planted(
    count: Range<usize>,
    wanted: &str,
    plant: impl Fn(&mut Verdict),
) -> (Vec<[Verdict; 2]>, Certification) {
    let truth = map();
    let cells: Vec<usize> =
        periodic(&truth).into_iter().filter(|&cell| truth.verdicts[cell].label() == wanted).collect();
    let cells = &cells[count];
    let mut wrong = truth.clone();
    for &cell in cells {
        plant(&mut wrong.verdicts[cell]);
    }
    let (after, counts) = certified(wrong);
    (cells.iter().map(|&cell| [truth.verdicts[cell], after.verdicts[cell]]).collect(), counts)
}

#[test]
fn a_multiple_of_the_period_is_relabelled() {
    let (cells, counts) = planted(0..3, "1-1-1", |verdict| {
        (verdict.n, verdict.counts) = (2 * verdict.n, Counts::new(&[2 * verdict.p(), 2 * verdict.q()]));
    });
    assert_eq!((counts.relabelled, counts.unresolved), (3, 0));
    assert!(cells.iter().all(|[truth, after]| label(truth) == label(after)));
}

#[test]
fn a_label_far_from_any_orbit_is_looked_at_again() {
    let (cells, counts) = planted(0..2, "1-1-1", |verdict| {
        let [x1, x2, v1, v2] = verdict.state.into();
        verdict.state = [0.5 * x1, x2 + 0.4, v1 - 1.0, v2].into();
    });
    assert!(counts.reexamined >= 2, "{counts:?}");
    for [_, after] in cells {
        assert!(after.regime.is_periodic() || after.n == 0, "{after:?}");
    }
}

#[test]
fn a_cell_is_certified_alike_in_every_window() {
    // Beyond the second period doubling of the ball.
    let ball = Family::builtin("bouncing-ball");
    let plane = Plane {
        x: Axis::of_family("Gamma=1.6728:1.6734:12", ball).unwrap(),
        y: Axis::of_family("r=0.4999:0.5001:8", ball).unwrap(),
        parameters: Setting::defaults(ball),
        start: Start::State(StateVector::from_slice(&[1.5, 1.5]).unwrap()),
        task: schedule(300),
    };
    let truth = sweep(&plane, &Cpu, &Unwatched).unwrap();
    let columns = COLUMNS as u32;
    let (mut compared, mut by_neighbours) = (0, 0);
    for cell in periodic(&truth).into_iter().filter(|&cell| truth.verdicts[cell].n == 4) {
        // Of a quarter and half of its period no stable motion is found, so that the neighbours' orbits are tried.
        let mut planted = truth.verdicts[cell];
        planted.n = 1;
        let mut whole = truth.clone();
        whole.verdicts[cell] = planted;
        let whole = certified(whole).0;
        let window = |plane: &Plane, window: Window| {
            let mut verdicts = vec![planted];
            let found = certify_window(plane, window, &mut verdicts, &Cpu, &Unwatched).unwrap().0;
            (verdicts[0], found[0].clone())
        };
        let (column, row) = (cell as u32 % columns, cell as u32 / columns);
        let own = Window { column, row, columns: 1, rows: 1 };
        let (verdict, multipliers) = window(&truth.plane, own);
        assert_eq!(verdict.state, whole.verdicts[cell].state, "cell {cell}");
        assert_eq!(label(&verdict), label(&whole.verdicts[cell]), "cell {cell}");
        assert_eq!(multipliers, whole.multipliers.as_ref().unwrap()[cell], "cell {cell}");
        // On a plane of this cell alone nothing is around it.
        let alone = own.plane(&truth.plane);
        by_neighbours += u32::from(window(&alone, Window::whole(&alone)).0.periods != verdict.periods);
        compared += 1;
    }
    assert!(compared > 10 && by_neighbours > 5, "{compared} {by_neighbours}");
}

#[test]
fn what_no_orbit_confirms_is_unresolved() {
    // A periodic label in the midst of chaos, looked at again for too short a time to find out: it must not stand.
    let mut map = map();
    map.plane.task.transient = 1;
    map.plane.task.observe = 1;
    map.plane.task.max_period = 1;
    let chaotic: Vec<usize> =
        (0..map.verdicts.len()).filter(|&cell| map.verdicts[cell].regime == Regime::Chaotic).collect();
    assert!(!chaotic.is_empty());
    for &cell in &chaotic {
        let verdict = &mut map.verdicts[cell];
        (verdict.regime, verdict.n, verdict.counts) = (Regime::Periodic, 1, Counts::new(&[1, 1]));
    }
    let (after, counts) = certified(map);
    assert_eq!(counts.reexamined, chaotic.len() as u64, "{counts:?}");
    for cell in chaotic {
        assert!(!after.verdicts[cell].regime.is_periodic(), "{:?}", after.verdicts[cell]);
        assert_eq!(after.multipliers.as_ref().unwrap()[cell], None);
    }
}
