//! A plane computed into a store, tile by tile: what is there is not computed again.

use std::sync::Arc;
use std::time::Instant;

use parking_lot::RwLock;
use thiserror::Error;

use super::certify::certify_window;
use super::extents::window_extents;
use super::map::{WORTH_A_LOOK, check, sweep_windows};
use super::{Result, SweepError};
use crate::analysis::Verdict;
use crate::backend::{self, Backend, BackendError, Silent, Watch, in_flight};
use crate::plane::Window;
use crate::plane::fields::{Assembled, Cells};
use crate::store::{Failure, Log, StoreError, ZarrStore};

/// Opens the back end anew, after it failed.
pub type Reopen<'a> = dyn Fn() -> backend::Result<Box<dyn Backend>> + Sync + 'a;

/// What became of the tiles that a run was to compute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StoredRun {
    /// Tiles that were there already.
    pub there: u32,
    /// Tiles computed now.
    pub computed: u32,
    /// Their cells.
    pub cells: u64,
    /// Their impacts.
    pub impacts: u64,
    /// Tiles that failed twice.
    pub failed: Vec<Failure>,
}

impl StoredRun {
    /// This and what became of further tiles.
    fn and(mut self, more: StoredRun) -> Self {
        self.there += more.there;
        self.computed += more.computed;
        self.cells += more.cells;
        self.impacts += more.impacts;
        self.failed.extend(more.failed);
        self
    }
}

/// Computes those of some tiles of a store that are not there, in their order; a few together, as many as keep the back end busy.
///
/// What a device fails at is tried once more, tile by tile on a back end opened anew; a tile that fails then is left out, and
/// the rest is computed. A cell's results are those that it has on the whole plane, certified ones too, whatever the tiles.
///
/// # Errors
/// A plane that cannot be used, a store that cannot be written, what a back end does not have, and the end that the watch
/// asked for; tiles that are there by then stay.
pub fn sweep_stored(
    store: &ZarrStore,
    tiles: &[u32],
    backend: Box<dyn Backend>,
    reopen: &Reopen,
    watch: &dyn Watch,
) -> Result<StoredRun, StoredError> {
    check(store.plane())?;
    let calls = backend.calls();
    let together = together(tiles, backend.tile() as u64 / WORTH_A_LOOK, |tile| cells_of(store, tile));
    let filling = Filling {
        store,
        there: store.tiles_there()?,
        log: Log::begin(store)?,
        backend: RwLock::new(Arc::from(backend)),
        reopen,
        watch,
    };
    let runs = in_flight(calls, together, |tiles| filling.fill(tiles))?;
    store.tidy();
    Ok(runs.into_iter().fold(StoredRun::default(), StoredRun::and))
}

/// How many cells a tile of a store has.
fn cells_of(store: &ZarrStore, tile: u32) -> u64 {
    store.tiling().window(tile).cells() as u64
}

/// Tiles in groups, each of as many as it takes for so many cells.
fn together(tiles: &[u32], least: u64, cells_of: impl Fn(u32) -> u64) -> Vec<&[u32]> {
    let mut cells = 0;
    tiles
        .split_inclusive(|&tile| {
            cells += cells_of(tile);
            let is_enough = cells >= least;
            if is_enough {
                cells = 0;
            }
            is_enough
        })
        .collect()
}

/// A store that is being filled.
struct Filling<'a> {
    store: &'a ZarrStore,
    /// The tiles that were there when it began.
    there: Vec<bool>,
    log: Log,
    backend: RwLock<Arc<dyn Backend>>,
    reopen: &'a Reopen<'a>,
    watch: &'a dyn Watch,
}

impl Filling<'_> {
    /// Computes those of some tiles that are not there.
    fn fill(&self, tiles: &[u32]) -> Result<StoredRun, StoredError> {
        let began = Instant::now();
        // Another process may have been here since.
        let is_there = |&tile: &u32| self.there[tile as usize] || self.store.is_there(tile);
        let (there, missing): (Vec<u32>, Vec<u32>) = tiles.iter().partition(|tile| is_there(tile));
        self.watch.finished(there.iter().map(|&tile| cells_of(self.store, tile)).sum());
        let mut run = StoredRun { there: there.len() as u32, ..StoredRun::default() };
        if missing.is_empty() {
            return Ok(run);
        }
        let backend = self.backend.read().clone();
        if let Ok(results) = self.computed(&missing, &*backend)? {
            return Ok(run.and(self.kept(&missing, &results, began)?));
        }
        let mut backend = self.opened_anew();
        for tile in missing {
            let began = Instant::now();
            let alone = match &backend {
                Ok(backend) => self.computed(&[tile], &**backend)?,
                Err(message) => Err(message.clone()),
            };
            match alone {
                Ok(results) => run = run.and(self.kept(&[tile], &results, began)?),
                Err(message) => {
                    self.log.failed(tile, message.clone());
                    run.failed.push(Failure { tile, message });
                    backend = self.opened_anew();
                }
            }
        }
        Ok(run)
    }

    /// The back end opened anew, for all tiles from now on; or why that failed.
    fn opened_anew(&self) -> Result<Arc<dyn Backend>, String> {
        let again: Arc<dyn Backend> = (self.reopen)().map_err(|error| error.to_string())?.into();
        *self.backend.write() = Arc::clone(&again);
        Ok(again)
    }

    /// The results of tiles; within, how the back end failed.
    fn computed(
        &self,
        tiles: &[u32],
        backend: &dyn Backend,
    ) -> Result<Result<Vec<Assembled>, String>, StoredError> {
        let windows: Vec<Window> = tiles.iter().map(|&tile| self.store.tiling().window(tile)).collect();
        let results = sweep_windows(self.store.plane(), &windows, backend, self.watch).and_then(|verdicts| {
            windows
                .iter()
                .zip(verdicts)
                .map(|(&window, verdicts)| self.assembled(window, verdicts, backend))
                .collect()
        });
        match results {
            Ok(results) => Ok(Ok(results)),
            Err(SweepError::Backend(error @ (BackendError::Device(_) | BackendError::NoAdapter(_)))) => {
                Ok(Err(error.to_string()))
            }
            Err(error) => Err(error.into()),
        }
    }

    /// Verdicts on the cells of a window, with what the store holds beyond them.
    fn assembled(
        &self,
        window: Window,
        mut verdicts: Vec<Verdict>,
        backend: &dyn Backend,
    ) -> Result<Assembled> {
        let (plane, extras, silent) = (self.store.plane(), self.store.extras(), Silent(self.watch));
        let certified = extras
            .certified
            .then(|| certify_window(plane, window, &mut verdicts, backend, &silent))
            .transpose()?;
        let extents =
            extras.extents.then(|| window_extents(plane, window, &verdicts, backend, &silent)).transpose()?;
        Ok(Assembled { verdicts, multipliers: certified.map(|(multipliers, _)| multipliers), extents })
    }

    /// Writes tiles that were begun together.
    fn kept(&self, tiles: &[u32], results: &[Assembled], began: Instant) -> Result<StoredRun, StoredError> {
        let mut run = StoredRun::default();
        let each = began.elapsed().as_secs_f64() / tiles.len() as f64;
        for (&tile, results) in tiles.iter().zip(results) {
            self.store.write_tile(tile, results)?;
            let cells = cells_of(self.store, tile);
            self.log.done(tile, cells, each);
            let impacts = results.verdicts.iter().map(|verdict| u64::from(verdict.impacts_total)).sum();
            run = run.and(StoredRun { computed: 1, cells, impacts, ..StoredRun::default() });
        }
        Ok(run)
    }
}

/// Why a plane was not computed into a store.
#[derive(Debug, Error)]
pub enum StoredError {
    /// The plane, or what computes it.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// The store.
    #[error(transparent)]
    Store(#[from] StoreError),
}

#[cfg(test)]
mod tests;
