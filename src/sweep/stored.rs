//! A plane computed into a store, tile by tile: what is there is not computed again.

use std::time::Instant;

use thiserror::Error;

use super::certify::certify_window;
use super::extents::window_extents;
use super::map::{check_border, sweep_window};
use super::{Result, SweepError};
use crate::backend::{self, Backend, BackendError, Silent, Watch};
use crate::plane::fields::{Assembled, Cells};
use crate::store::{Failure, Log, StoreError, ZarrStore};

/// Opens the back end anew, after it failed.
pub type Reopen<'a> = dyn Fn() -> backend::Result<Box<dyn Backend>> + 'a;

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

/// Computes those of some tiles of a store that are not there, in their order.
///
/// A tile that fails is tried once more, on a back end opened anew, and then left out; the rest is computed. A cell's results
/// are those that it has on the whole plane, certified ones too, whatever the tiles.
///
/// # Errors
/// A plane that cannot be used, a store that cannot be written, and the end that the watch asked for; tiles that are there
/// by then stay.
pub fn sweep_stored(
    store: &ZarrStore,
    tiles: &[u32],
    backend: Box<dyn Backend>,
    reopen: &Reopen,
    watch: &dyn Watch,
) -> Result<StoredRun, StoredError> {
    store.plane().check().map_err(SweepError::from)?;
    check_border(store.plane()).map_err(SweepError::from)?;
    let there = store.tiles_there()?;
    let log = Log::begin(store)?;
    let mut run = StoredRun::default();
    let mut backend = backend;
    for &tile in tiles {
        let cells = store.tiling().window(tile).cells() as u64;
        // Another process may have been here since.
        if there[tile as usize] || store.is_there(tile) {
            run.there += 1;
            watch.finished(cells);
            continue;
        }
        let began = Instant::now();
        match computed(store, tile, &mut backend, reopen, watch)? {
            Ok(results) => {
                store.write_tile(tile, &results)?;
                let verdicts = &results.verdicts;
                log.done(tile, cells, began.elapsed().as_secs_f64());
                run.computed += 1;
                run.cells += cells;
                run.impacts += verdicts.iter().map(|verdict| u64::from(verdict.impacts_total)).sum::<u64>();
            }
            Err(message) => {
                log.failed(tile, message.clone());
                run.failed.push(Failure { tile, message });
            }
        }
    }
    store.tidy();
    Ok(run)
}

/// The results of a tile, at the second attempt if need be; within, why that failed too.
fn computed(
    store: &ZarrStore,
    tile: u32,
    backend: &mut Box<dyn Backend>,
    reopen: &Reopen,
    watch: &dyn Watch,
) -> Result<Result<Assembled, String>, StoredError> {
    let mut message = String::new();
    for attempt in 0..2 {
        if attempt > 0 {
            match reopen() {
                Ok(again) => *backend = again,
                Err(error) => return Ok(Err(error.to_string())),
            }
        }
        match once(store, tile, &**backend, watch) {
            Ok(computed) => return Ok(Ok(computed)),
            Err(SweepError::Backend(error @ (BackendError::Device(_) | BackendError::NoAdapter(_)))) => {
                message = error.to_string();
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(Err(message))
}

fn once(store: &ZarrStore, tile: u32, backend: &dyn Backend, watch: &dyn Watch) -> Result<Assembled> {
    let (plane, window) = (store.plane(), store.tiling().window(tile));
    let mut verdicts = sweep_window(plane, window, backend, watch)?;
    let (extras, silent) = (store.extras(), Silent(watch));
    let certified = extras
        .certified
        .then(|| certify_window(plane, window, &mut verdicts, backend, &silent))
        .transpose()?;
    let extents =
        extras.extents.then(|| window_extents(plane, window, &verdicts, backend, &silent)).transpose()?;
    Ok(Assembled { verdicts, multipliers: certified.map(|(multipliers, _)| multipliers), extents })
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
mod tests {
    use std::sync::atomic::{AtomicU32, Ordering};

    use tempfile::tempdir;

    use super::*;
    use crate::analysis::{Schedule, Verdict};
    use crate::backend::{Cpu, Job, Unwatched};
    use crate::plane::fields::Extras;
    use crate::plane::{Part, Plane, Start, Window};
    use crate::store::Wanted;
    use crate::sweep::{provenance, sweep};

    fn plane() -> Plane {
        let schedule = Schedule { transient: 40, observe: 40, max_period: 8, fixed_periods: false };
        Plane::of_paper("omega=2:4:11", "delta=0.05:0.3:7", Start::Symmetric, schedule).unwrap()
    }

    fn store(folder: &tempfile::TempDir) -> ZarrStore {
        let (plane, provenance) = (plane(), provenance(&Cpu));
        let wanted = Wanted { plane: &plane, provenance: &provenance, extras: Extras::NONE, tile: Some(4) };
        ZarrStore::of(&folder.path().join("plane.zarr"), &wanted).unwrap()
    }

    fn cpu() -> backend::Result<Box<dyn Backend>> {
        Ok(Box::new(Cpu))
    }

    #[test]
    fn a_store_holds_what_a_map_holds() {
        let folder = tempdir().unwrap();
        let store = store(&folder);
        let tiles = Part::WHOLE.tiles(store.plane(), &store.tiling());
        let run = sweep_stored(&store, &tiles, Box::new(Cpu), &cpu, &Unwatched).unwrap();
        assert_eq!((run.there, run.computed, run.cells), (0, 6, 77));
        let mut map = sweep(&plane(), &Cpu, &Unwatched).unwrap();
        map.verdicts.iter_mut().for_each(|verdict| (verdict.impacts_total, verdict.returning) = (0, 0));
        let read = store.map_of(Window::whole(&plane())).unwrap();
        assert_eq!(format!("{:?}", read.verdicts), format!("{:?}", map.verdicts));
        assert_eq!(store.configuration(), Cells::configuration(&map));
        // Again, nothing is computed.
        let run = sweep_stored(&store, &tiles, Box::new(Cpu), &cpu, &Unwatched).unwrap();
        assert_eq!((run.there, run.computed), (6, 0));
    }

    /// A device that is lost once it has run so many tiles, and found again or not when it is opened anew.
    #[derive(Debug)]
    struct Lost<'a> {
        left: &'a AtomicU32,
    }

    impl Backend for Lost<'_> {
        fn name(&self) -> &'static str {
            "cpu"
        }

        fn adapter(&self) -> String {
            Cpu.adapter()
        }

        fn tile(&self) -> usize {
            1 << 14
        }

        fn run(&self, jobs: &[Job], schedule: &Schedule, watch: &dyn Watch) -> backend::Result<Vec<Verdict>> {
            let left =
                self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
            match left {
                Ok(_) => Cpu.run(jobs, schedule, watch),
                Err(_) => Err(BackendError::Device("the device was lost".to_owned())),
            }
        }
    }

    #[test]
    fn a_device_that_is_lost_is_opened_anew_and_what_fails_twice_is_left_out() {
        static SOME: AtomicU32 = AtomicU32::new(5);
        static NONE: AtomicU32 = AtomicU32::new(0);
        let folder = tempdir().unwrap();
        let store = store(&folder);
        let tiles = Part::WHOLE.tiles(store.plane(), &store.tiling());
        let lost = || -> backend::Result<Box<dyn Backend>> { Ok(Box::new(Lost { left: &NONE })) };
        let run = sweep_stored(&store, &tiles, Box::new(Lost { left: &SOME }), &lost, &Unwatched).unwrap();
        assert!(run.computed > 0 && !run.failed.is_empty(), "{run:?}");
        assert_eq!(run.computed as usize + run.failed.len(), 6);
        let status = store.status().unwrap();
        assert_eq!((status.done, status.missing), (run.computed, run.failed.len() as u32));
        assert_eq!(status.failed.len(), run.failed.len());
        assert!(status.failed[0].message.contains("the device was lost"));
        // A device that is found again finishes everything, and nothing has failed any more.
        let run = sweep_stored(&store, &tiles, Box::new(Lost { left: &NONE }), &cpu, &Unwatched).unwrap();
        assert_eq!((run.failed.len(), store.status().unwrap().missing), (0, 0));
        assert!(store.status().unwrap().failed.is_empty());
    }
}
