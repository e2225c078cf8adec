//! A whole plane on one back end, tile by tile.
//!
//! Jobs are made tile by tile, and of those before only a few in doubt wait, so that memory beyond the verdicts themselves does not
//! grow with the plane; a tile holds cells of as few flows as there can be.
//! A back end's verdict depends on its job and the schedule alone, hence so does a cell's: not on the tiles.

use parking_lot::Mutex;
use rayon::iter::repeat_n;
use rayon::prelude::*;

use super::begun::{Begun, of_begun};
use super::order::Order;
use super::prepared::Prepared;
use super::preparing::jobs_of;
use super::swept::Swept;
use super::{Result, SweepError, provenance};
use crate::analysis::Verdict;
use crate::backend::{Backend, Job, Watch, decide, in_flight};
use crate::model::{Flows, StateVector, System, SystemError};
use crate::plane::{Plane, Reached, RegionMap, Task, Window};

/// One part in so many of a tile is worth a look: less would leave most of a back end idle.
pub(super) const WORTH_A_LOOK: u64 = 4;

/// Does what is asked of every cell of a plane on a back end.
///
/// Under control a cell without impacts to control at (δ = 0), or whose target motion does not exist or cannot be held, is unresolved
/// after 0 iterates. A cell that would begin beyond a stop is inadmissible, whatever is asked of it.
///
/// # Errors
/// A plane, a system or a method that cannot be used, a target that exists in no cell, or what the back end could not do;
/// nothing is kept of a sweep that the watch ended.
pub fn sweep<T: Swept>(plane: &Plane<T>, backend: &dyn Backend, watch: &dyn Watch) -> Result<RegionMap<T>> {
    check(plane)?;
    let (flows, order) = (Flows::default(), Order::by_flow(plane));
    let (cells, tile) = (plane.cells(), backend.tile().max(1) as u64);
    let mut verdicts = Vec::new();
    verdicts.try_reserve_exact(cells as usize).map_err(|_| SweepError::Memory(cells))?;
    verdicts.par_extend(repeat_n(T::Cell::unresolved(plane.parameters.family().n()), cells as usize));
    let columns = plane.x.count as usize;
    // Whoever holds a row waits for nothing else.
    let rows: Vec<Mutex<&mut [T::Cell]>> = verdicts.chunks_mut(columns).map(Mutex::new).collect();
    let doubts = plane.task.doubts();
    let settle = |least: u64| -> Result<()> {
        for (cell, found) in plane.task.settle(backend, &doubts, least as usize, watch)? {
            rows[cell as usize / columns].lock()[cell as usize % columns] = found;
        }
        Ok(())
    };
    // While a back end is busy with one tile, the processor prepares the next, or puts what came of the last into its place.
    let of_tiles = in_flight(backend.calls(), (0..cells).step_by(tile as usize), |first| -> Result<_> {
        watch.check()?;
        flows.tidy();
        let places = first..cells.min(first.saturating_add(tile));
        let here: Vec<u64> = order.cells(places.clone()).collect();
        let Prepared { jobs, places: of_jobs, inadmissible, missing } = Prepared::of(plane, &here, &flows)?;
        watch.finished((here.len() - jobs.len()) as u64);
        let found = plane.task.begin(backend, &jobs, watch)?;
        put(&rows, |row| order.numbers_in(row, &places), &here, &of_jobs, &found);
        if !inadmissible.is_empty() {
            let (beyond, starts): (Vec<u32>, Vec<StateVector>) = inadmissible.into_iter().unzip();
            let cells: Vec<T::Cell> = starts.into_iter().map(T::Cell::inadmissible).collect();
            put(&rows, |row| order.numbers_in(row, &places), &here, &beyond, &cells);
        }
        // What is in doubt waits only now: as soon as it does, another tile's thread may put what it settles in that place.
        let number = |job: usize| here[of_jobs[job] as usize];
        plane.task.put_off(&jobs, &found, number, &doubts);
        let any = !jobs.is_empty();
        // By the threads that made them.
        jobs.into_par_iter().for_each(drop);
        settle(tile / WORTH_A_LOOK)?;
        Ok((missing, any))
    })?;
    settle(1)?;
    drop(rows);
    let any = of_tiles.iter().any(|(_, any)| *any);
    match of_tiles.into_iter().find_map(|(missing, _)| missing) {
        Some(why) if !any => Err(why),
        _ => Ok(RegionMap::new(plane.clone(), provenance(backend), verdicts)),
    }
}

/// Puts what was found of some cells `here` into the rows of a plane; `numbers_in` has the numbers, among those cells, of the ones in a
/// row. `of_jobs` are the numbers of those that something was found of, ascending.
fn put<C: Clone + Send + Sync, N: Iterator<Item = usize>>(
    rows: &[Mutex<&mut [C]>],
    numbers_in: impl Fn(u64) -> N + Sync,
    here: &[u64],
    of_jobs: &[u32],
    found: &[C],
) {
    let all = of_jobs.len() == here.len();
    let job_of = |number: usize| if all { Ok(number) } else { of_jobs.binary_search(&(number as u32)) };
    rows.par_iter().enumerate().for_each(|(row, cells)| {
        let mut cells = cells.lock();
        for number in numbers_in(row as u64) {
            if let Ok(job) = job_of(number) {
                let column = here[number] as usize % cells.len();
                cells[column] = found[job].clone();
            }
        }
    });
}

/// Refuses what can be seen to be wrong with a plane before anything is computed: whatever [`Plane::check`] refuses, and cells on
/// its border that have no system. Time scales are too far apart there first, and most formulas have no value there first.
///
/// # Errors
/// A plane or a system that cannot be used.
pub fn check<T: Task>(plane: &Plane<T>) -> Result<()> {
    plane.check()?;
    plane.border().try_for_each(|(column, row)| Ok(System::new(plane.parameters_at(column, row)).map(drop)?))
}

/// The jobs of some cells of a plane, window by window and row by row.
pub(super) fn window_jobs(plane: &Plane, windows: &[Window]) -> Result<Vec<Begun>, SystemError> {
    for window in windows {
        assert!(
            window.is_on(plane),
            "{window:?} reaches beyond the plane of {} × {} cells",
            plane.x.count,
            plane.y.count
        );
    }
    let whole = Window::whole(plane);
    let places = windows.iter().flat_map(Window::places);
    jobs_of(plane, &places.map(|place| whole.index(place) as u64).collect::<Vec<_>>())
}

/// Computes some cells of a plane on a back end together, the same as in the whole; of each window row by row.
///
/// # Errors
/// As [`sweep`].
///
/// # Panics
/// If a window reaches beyond the plane.
pub fn sweep_windows(
    plane: &Plane,
    windows: &[Window],
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Vec<Verdict>>> {
    let begun = window_jobs(plane, windows)?;
    let all = begun.len();
    let decided = |jobs: &[Job]| {
        watch.finished((all - jobs.len()) as u64);
        decide(backend, jobs, &plane.task, watch)
    };
    let mut verdicts = of_begun(begun, decided, Verdict::inadmissible)?.into_iter();
    Ok(windows.iter().map(|window| verdicts.by_ref().take(window.cells()).collect()).collect())
}

#[cfg(test)]
mod tests;
