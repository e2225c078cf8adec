//! Cells in their places, whatever the tiles, and sweeps that end early.

use std::sync::atomic::{AtomicU64, Ordering};

use super::*;
use crate::analysis::{Regime, Schedule};
use crate::backend::{self, BackendError, Unwatched};
use crate::plane::Start;

/// Gives back each job's parameters and start in the verdict's state.
#[derive(Debug)]
struct Echo {
    tile: usize,
}

impl Backend for Echo {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        "echo".to_owned()
    }

    fn tile(&self) -> usize {
        self.tile
    }

    fn run(&self, jobs: &[Job], _schedule: &Schedule, watch: &dyn Watch) -> backend::Result<Vec<Verdict>> {
        assert!(jobs.len() <= self.tile.max(1), "a tile of {} jobs", jobs.len());
        watch.finished(jobs.len() as u64);
        Ok(jobs.iter().map(echo).collect())
    }
}

fn echo(job: &Job) -> Verdict {
    let parameters = job.system.parameters();
    let state = [parameters.omega, parameters.delta, job.start[0], job.start[2]].into();
    Verdict { state, ..Verdict::of_motion(Regime::NoImpact, [0; 3], false) }
}

fn plane(x: &str, y: &str, start: Start) -> Plane {
    let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
    Plane::of_paper(x, y, start, schedule).unwrap()
}

#[test]
fn every_cell_is_in_its_place_for_any_tile() {
    let plane = plane("omega=1:3:5", "delta=0.1:0.4:4", Start::State([0.05, 0.0, -1.0, 0.0].into()));
    for tile in [0, 1, 3, 5, 7, 20, 1000] {
        let map = sweep(&plane, &Echo { tile }, &Unwatched).unwrap();
        assert_eq!(map.verdicts.len(), 20);
        for row in 0..4 {
            for column in 0..5 {
                let expected = [plane.x.value(column), plane.y.value(row), 0.05, -1.0];
                assert_eq!(map.at(column, row).state, expected.into(), "column {column}, row {row}");
            }
        }
    }
}

#[test]
fn cells_without_a_job_stay_as_they_are() {
    for (x, y) in [("omega=1:3:5", "delta=0.1:0.4:4"), ("delta=0.1:0.4:5", "omega=1:3:4")] {
        let order = Order::by_flow(&plane(x, y, Start::Rest));
        let has_job = |cell: u64| cell % 3 != 1;
        for tile in [1, 3, 7, 20] {
            let mut verdicts = vec![None; 20];
            let rows: Vec<_> = verdicts.chunks_mut(5).map(Mutex::new).collect();
            for first in (0..20).step_by(tile) {
                let places = first as u64..20.min((first + tile) as u64);
                let cells: Vec<u64> = order.cells(places.clone()).collect();
                let with_jobs = || (0..).zip(&cells).filter(|&(_, &cell)| has_job(cell));
                let (of_jobs, found): (Vec<u32>, Vec<_>) =
                    with_jobs().map(|(place, &cell)| (place, Some(cell))).unzip();
                put(&rows, |row| order.numbers_in(row, &places), &cells, &of_jobs, &found);
            }
            drop(rows);
            let expected: Vec<_> = (0..20).map(|cell| has_job(cell).then_some(cell)).collect();
            assert_eq!(verdicts, expected, "{x}, {y}, {tile}");
        }
    }
}

#[test]
fn windows_hold_the_cells_of_the_whole() {
    let plane = plane("omega=1:3:5", "delta=0.1:0.4:4", Start::Rest);
    let map = sweep(&plane, &Echo { tile: 7 }, &Unwatched).unwrap();
    let windows = [(1, 2, 3, 2), (4, 0, 1, 3), (0, 0, 5, 1)].map(|(column, row, columns, rows)| Window {
        column,
        row,
        columns,
        rows,
    });
    let parts = sweep_windows(&plane, &windows, &Echo { tile: 4 }, &Unwatched).unwrap();
    assert_eq!(parts.len(), windows.len());
    for (window, part) in windows.iter().zip(&parts) {
        assert_eq!(part.len(), window.cells());
        for (place, verdict) in window.places().zip(part) {
            assert_eq!(verdict, map.at(place.0, place.1), "{place:?}");
        }
    }
}

/// Whatever the tiles, and however many cells of one begin beyond a stop.
#[test]
fn cells_that_begin_beyond_a_stop_are_in_their_places() {
    for (x, y) in [("x1=-0.75:0.75:7", "delta=0.1:0.5:5"), ("delta=0.1:0.5:5", "x1=-0.75:0.75:7")] {
        let plane = plane(x, y, Start::Rest);
        for tile in [1, 3, 8, 35] {
            let watch = Limit { limit: 1000, finished: AtomicU64::new(0) };
            let map = sweep(&plane, &Echo { tile }, &watch).unwrap();
            assert_eq!(watch.finished.into_inner(), 35, "every cell is told of once");
            let mut inadmissible = 0;
            for (column, row) in Window::whole(&plane).places() {
                let Start::State(start) = plane.start_at(column, row) else { panic!("the start varies") };
                let gap = plane.parameters_at(column, row).plant().unwrap().stops[0].gap;
                let verdict = map.at(column, row);
                if start[0].abs() > gap {
                    inadmissible += 1;
                    assert_eq!((verdict.regime, verdict.state), (Regime::Inadmissible, start));
                } else {
                    assert_eq!(verdict.state, [3.7, gap, start[0], 0.0].into(), "{column}, {row}");
                }
            }
            assert_eq!(inadmissible, 22, "{x}, {y}");
        }
    }
}

#[test]
fn axes_over_the_start_vary_the_start() {
    let plane = plane("x1=-0.1:0.1:3", "v1=-2:2:2", Start::Rest);
    let map = sweep(&plane, &Echo { tile: 4 }, &Unwatched).unwrap();
    assert_eq!(map.at(2, 0).state, [3.7, 0.1, 0.1, -2.0].into());
    assert_eq!(map.at(0, 1).state, [3.7, 0.1, -0.1, 2.0].into());
}

#[test]
fn a_plane_that_cannot_be_used_is_refused() {
    let same = plane("omega=1:3:5", "omega=1:3:5", Start::Rest);
    assert!(matches!(sweep(&same, &Echo { tile: 4 }, &Unwatched), Err(SweepError::Plane(_))));
}

#[test]
fn systems_that_cannot_be_followed_are_refused_before_anything_runs() {
    let too_slow = plane("delta=0.1:0.4:4", "omega=1e-12:3:4", Start::Rest);
    let watch = Limit { limit: u64::MAX, finished: AtomicU64::new(0) };
    assert!(matches!(sweep(&too_slow, &Echo { tile: 1 }, &watch), Err(SweepError::System(_))));
    assert_eq!(watch.finished.into_inner(), 0);
    let last_row = plane("omega=1:3:4", "zeta=0:1e9:4", Start::Rest);
    let watch = Limit { limit: u64::MAX, finished: AtomicU64::new(0) };
    assert!(matches!(sweep(&last_row, &Echo { tile: 1 }, &watch), Err(SweepError::System(_))));
    assert_eq!(watch.finished.into_inner(), 0);
}

/// Asks to stop once `limit` cells are finished.
struct Limit {
    limit: u64,
    finished: AtomicU64,
}

impl Watch for Limit {
    fn finished(&self, cells: u64) {
        self.finished.fetch_add(cells, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.finished.load(Ordering::Relaxed) >= self.limit
    }
}

/// Leaves a cell in doubt for none, one or two looks, and counts in x1 how often it was followed.
#[derive(Debug)]
struct Doubting {
    tile: usize,
    /// Whether it is lost at the first look.
    is_lost: bool,
}

impl Doubting {
    /// How often a cell is followed until it is not in doubt.
    fn times(omega: f64, delta: f64) -> f64 {
        1.0 + (10.0 * omega + 100.0 * delta).round() % 3.0
    }
}

impl Backend for Doubting {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        "doubting".to_owned()
    }

    fn tile(&self) -> usize {
        self.tile
    }

    fn run(&self, jobs: &[Job], _: &Schedule, _: &dyn Watch) -> backend::Result<Vec<Verdict>> {
        let follow = |job: &Job| {
            let parameters = job.system.parameters();
            let mut state = job.start;
            state[0] += 1.0;
            let is_open = state[0] < Doubting::times(parameters.omega, parameters.delta);
            let regime = if is_open { Regime::Unresolved } else { Regime::NoImpact };
            Verdict { state, ..Verdict::of_motion(regime, [0; 3], false) }
        };
        if self.is_lost && jobs.iter().any(|job| job.start[0] > 0.0) {
            return Err(BackendError::Device("lost".to_owned()));
        }
        Ok(jobs.iter().map(follow).collect())
    }
}

#[test]
fn cells_in_doubt_are_looked_at_until_none_is_left() {
    let plane = Plane {
        task: Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false },
        ..plane("omega=1:3:5", "delta=0.1:0.4:4", Start::State([0.0; 4].into()))
    };
    for tile in [1, 3, 8, 20] {
        let map = sweep(&plane, &Doubting { tile, is_lost: false }, &Unwatched).unwrap();
        let mut found = [0; 3];
        for (row, column) in (0..4).flat_map(|row| (0..5).map(move |column| (row, column))) {
            let times = Doubting::times(plane.x.value(column), plane.y.value(row));
            assert_eq!(map.at(column, row).state[0], times, "column {column}, row {row}, tile {tile}");
            assert_eq!(map.at(column, row).regime, Regime::NoImpact);
            found[times as usize - 1] += 1;
        }
        assert!(found.iter().all(|&cells| cells > 3), "{found:?}");
        let lost = sweep(&plane, &Doubting { tile, is_lost: true }, &Unwatched);
        assert!(matches!(lost, Err(SweepError::Backend(BackendError::Device(_)))), "{tile}");
    }
}

#[test]
fn a_sweep_stops_between_tiles() {
    let plane = plane("omega=1:3:5", "delta=0.1:0.4:4", Start::Rest);
    let watch = Limit { limit: 6, finished: AtomicU64::new(0) };
    let stopped = sweep(&plane, &Echo { tile: 3 }, &watch);
    assert!(matches!(stopped, Err(SweepError::Backend(BackendError::Cancelled))));
    // What was under way goes on to its end.
    let finished = watch.finished.into_inner();
    assert!((6..=9).contains(&finished), "{finished}");
}
