//! A whole plane on one back end, tile by tile.
//!
//! Jobs are made for one tile at a time, so that memory beyond the verdicts themselves does not grow with the plane; a tile holds
//! cells of as few flows as there can be.
//! A back end's verdict depends on its job and the schedule alone, hence so does a cell's: not on the tiles.

use std::ops::Range;

use parking_lot::Mutex;
use rayon::prelude::*;

use super::order::Order;
use super::prepared::Prepared;
use super::preparing::jobs_of;
use super::swept::Swept;
use super::{Result, SweepError, provenance};
use crate::analysis::Verdict;
use crate::backend::{Backend, Job, Watch, decide, in_flight};
use crate::model::{Flows, System, SystemError};
use crate::plane::{Plane, Reached, RegionMap, Window};

/// A look at what is in doubt is taken once one part in so many of a tile waits for it: few of them would leave most of a back end
/// idle.
const WORTH_A_LOOK: u64 = 4;

/// Does what is asked of every cell of a plane on a back end.
///
/// Under control a cell without impacts to control at (δ = 0), or whose target motion does not exist, is unresolved after 0
/// iterates.
///
/// # Errors
/// A plane, a system or a method that cannot be used, a target that exists in no cell, or what the back end could not do;
/// nothing is kept of a sweep that the watch ended.
pub fn sweep<T: Swept>(plane: &Plane<T>, backend: &dyn Backend, watch: &dyn Watch) -> Result<RegionMap<T>> {
    plane.check()?;
    let (flows, order) = (Flows::default(), Order::by_flow(plane));
    check_border(plane)?;
    let (cells, tile) = (plane.cells(), backend.tile().max(1) as u64);
    let mut verdicts = Vec::new();
    verdicts.try_reserve_exact(cells as usize).map_err(|_| SweepError::Memory(cells))?;
    verdicts.resize(cells as usize, T::Cell::unresolved(plane.parameters.family().n()));
    let (verdicts, doubts) = (Mutex::new(verdicts), plane.task.doubts());
    let settle = |least: u64| -> Result<()> {
        let settled = plane.task.settle(backend, &doubts, least as usize, watch)?;
        let mut verdicts = verdicts.lock();
        settled.into_iter().for_each(|(cell, found)| verdicts[cell as usize] = found);
        Ok(())
    };
    // While a back end is busy with one tile, the processor prepares the next, or puts what came of the last into its place.
    let of_tiles = in_flight((0..cells).step_by(tile as usize), |first| -> Result<_> {
        watch.check()?;
        flows.tidy();
        let places = first..cells.min(first.saturating_add(tile));
        let here: Vec<u64> = order.cells(places.clone()).collect();
        let Prepared { jobs, places: of_jobs, missing } = Prepared::of(plane, &here, &flows)?;
        watch.finished((here.len() - jobs.len()) as u64);
        let numbers = of_jobs.iter().map(|&place| here[place as usize]);
        let found = plane.task.begin(backend, &jobs, numbers, &doubts, watch)?;
        put(&mut verdicts.lock(), &order, places, &of_jobs, &found);
        let any = !jobs.is_empty();
        // By the threads that made them.
        jobs.into_par_iter().for_each(drop);
        settle(tile / WORTH_A_LOOK)?;
        Ok((missing, any))
    })?;
    settle(1)?;
    let any = of_tiles.iter().any(|(_, any)| *any);
    match of_tiles.into_iter().find_map(|(missing, _)| missing) {
        Some(why) if !any => Err(why),
        _ => Ok(RegionMap::new(plane.clone(), provenance(backend), verdicts.into_inner())),
    }
}

/// Puts what was found into the plane's order; row by row, so that it goes through memory in few strides. It was found at some
/// places of an order, `of_jobs` counted from the first of them; what is still in doubt comes later.
fn put<C: Clone>(
    verdicts: &mut [C],
    order: &Order,
    places: Range<u64>,
    of_jobs: &[u32],
    found: &[Option<C>],
) {
    let mut results = vec![None; (places.end - places.start) as usize];
    for (&place, found) in of_jobs.iter().zip(found) {
        results[place as usize] = found.as_ref();
    }
    for (place, cell) in order.row_by_row(places) {
        if let Some(found) = results[place] {
            verdicts[cell as usize] = found.clone();
        }
    }
}

/// Refuses time scales that are too far apart before anything is computed: they are so on the border first.
pub(super) fn check_border<T>(plane: &Plane<T>) -> Result<(), SystemError> {
    let (columns, rows) = (plane.x.count, plane.y.count);
    let horizontal = (0..columns).flat_map(|column| [(column, 0), (column, rows - 1)]);
    let vertical = (0..rows).flat_map(|row| [(0, row), (columns - 1, row)]);
    horizontal
        .chain(vertical)
        .try_for_each(|(column, row)| System::new(plane.parameters_at(column, row)).map(drop))
}

/// The jobs of some cells of a plane, row by row.
pub(super) fn window_jobs(plane: &Plane, window: Window) -> Result<Vec<Job>, SystemError> {
    let whole = Window::whole(plane);
    jobs_of(plane, &window.places().map(|place| whole.index(place) as u64).collect::<Vec<_>>())
}

/// Computes some cells of a plane on a back end, the same as in the whole; row by row.
///
/// # Errors
/// As [`sweep`].
pub fn sweep_window(
    plane: &Plane,
    window: Window,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>> {
    let jobs = window_jobs(plane, window)?;
    let mut verdicts = Vec::with_capacity(jobs.len());
    for jobs in jobs.chunks(backend.tile().max(1)) {
        watch.check()?;
        verdicts.extend(decide(backend, jobs, &plane.task, watch)?);
    }
    Ok(verdicts)
}

#[cfg(test)]
mod tests {
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

        fn run(
            &self,
            jobs: &[Job],
            _schedule: &Schedule,
            watch: &dyn Watch,
        ) -> backend::Result<Vec<Verdict>> {
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
                for first in (0..20).step_by(tile) {
                    let places = first as u64..20.min((first + tile) as u64);
                    let cells: Vec<u64> = order.cells(places.clone()).collect();
                    let with_jobs = || (0..).zip(&cells).filter(|&(_, &cell)| has_job(cell));
                    let (of_jobs, found): (Vec<u32>, Vec<_>) =
                        with_jobs().map(|(place, &cell)| (place, Some(Some(cell)))).unzip();
                    put(&mut verdicts, &order, places, &of_jobs, &found);
                }
                let expected: Vec<_> = (0..20).map(|cell| has_job(cell).then_some(cell)).collect();
                assert_eq!(verdicts, expected, "{x}, {y}, {tile}");
            }
        }
    }

    #[test]
    fn a_window_holds_the_cells_of_the_whole() {
        let plane = plane("omega=1:3:5", "delta=0.1:0.4:4", Start::Rest);
        let map = sweep(&plane, &Echo { tile: 7 }, &Unwatched).unwrap();
        let window = Window { column: 1, row: 2, columns: 3, rows: 2 };
        let part = sweep_window(&plane, window, &Echo { tile: 4 }, &Unwatched).unwrap();
        for (place, verdict) in window.places().zip(&part) {
            assert_eq!(verdict, map.at(place.0, place.1), "{place:?}");
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

    #[test]
    fn a_sweep_stops_between_tiles() {
        let plane = plane("omega=1:3:5", "delta=0.1:0.4:4", Start::Rest);
        let watch = Limit { limit: 6, finished: AtomicU64::new(0) };
        let stopped = sweep(&plane, &Echo { tile: 3 }, &watch);
        assert!(matches!(stopped, Err(SweepError::Backend(BackendError::Cancelled))));
        assert_eq!(watch.finished.into_inner(), 6);
    }
}
