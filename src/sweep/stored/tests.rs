//! What becomes of tiles, and of those that a device is lost with.

use std::sync::atomic::{AtomicU32, Ordering};

use tempfile::tempdir;

use super::*;
use crate::analysis::Schedule;
use crate::backend::{Cpu, Job, Unwatched};
use crate::plane::fields::Extras;
use crate::plane::{Part, Plane, Start};
use crate::store::Wanted;
use crate::sweep::{provenance, sweep};

fn plane() -> Plane {
    let schedule = Schedule { transient: 40, observe: 40, max_period: 8, fixed_periods: false };
    Plane::of_paper("omega=2:4:11", "delta=0.05:0.3:7", Start::Symmetric, schedule).unwrap()
}

/// The same, where every cell is followed once.
fn plane_without_doubts() -> Plane {
    let plane = plane();
    Plane { task: Schedule { fixed_periods: true, ..plane.task }, ..plane }
}

fn store(folder: &tempfile::TempDir, plane: &Plane) -> ZarrStore {
    let provenance = provenance(&Cpu);
    let wanted = Wanted { plane, provenance: &provenance, extras: Extras::NONE, tile: Some(4) };
    ZarrStore::of(&folder.path().join("plane.zarr"), &wanted).unwrap()
}

fn cpu() -> backend::Result<Box<dyn Backend>> {
    Ok(Box::new(Cpu))
}

/// Holds a finished store to the map of its plane.
fn is_whole(store: &ZarrStore) {
    let mut map = sweep(store.plane(), &Cpu, &Unwatched).unwrap();
    map.verdicts.iter_mut().for_each(|verdict| (verdict.impacts_total, verdict.returning) = (0, 0));
    let read = store.map_of(Window::whole(store.plane())).unwrap();
    assert_eq!(format!("{:?}", read.verdicts), format!("{:?}", map.verdicts));
    assert_eq!(store.configuration(), Cells::configuration(&map));
}

#[test]
fn a_store_holds_what_a_map_holds() {
    static ENOUGH: AtomicU32 = AtomicU32::new(u32::MAX);
    // Tiles by themselves, some together, and all of them.
    for tile in [1, 36, 140, 1 << 14] {
        let folder = tempdir().unwrap();
        let store = store(&folder, &plane());
        let tiles = Part::WHOLE.tiles(store.plane(), &store.tiling());
        let back_end = || Box::new(Lost { left: &ENOUGH, tile });
        let run = sweep_stored(&store, &tiles, back_end(), &cpu, &Unwatched).unwrap();
        assert_eq!((run.there, run.computed, run.cells), (0, 6, 77));
        is_whole(&store);
        // Again, nothing is computed.
        let run = sweep_stored(&store, &tiles, back_end(), &cpu, &Unwatched).unwrap();
        assert_eq!((run.there, run.computed), (6, 0));
    }
}

#[test]
fn tiles_come_together_up_to_so_many_cells() {
    let tiles = [3, 5, 2, 1, 9, 4];
    let of = |least: u64| together(&tiles, least, u64::from);
    assert_eq!(of(0), [[3], [5], [2], [1], [9], [4]]);
    assert_eq!(of(3), [&[3][..], &[5], &[2, 1], &[9], &[4]]);
    assert_eq!(of(8), [&[3, 5][..], &[2, 1, 9], &[4]]);
    assert_eq!(of(100), [&tiles[..]]);
    assert!(together(&[], 3, u64::from).is_empty());
}

/// A device that is lost once it has run so often, and found again or not when it is opened anew.
#[derive(Debug)]
struct Lost<'a> {
    left: &'a AtomicU32,
    tile: usize,
}

impl Backend for Lost<'_> {
    fn name(&self) -> &'static str {
        "cpu"
    }

    fn adapter(&self) -> String {
        Cpu.adapter()
    }

    fn tile(&self) -> usize {
        self.tile
    }

    fn run(&self, jobs: &[Job], schedule: &Schedule, watch: &dyn Watch) -> backend::Result<Vec<Verdict>> {
        let left = self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| left.checked_sub(1));
        match left {
            Ok(_) => Cpu.run(jobs, schedule, watch),
            Err(_) => Err(BackendError::Device("the device was lost".to_owned())),
        }
    }
}

#[test]
fn a_device_that_is_lost_is_opened_anew_and_what_fails_twice_is_left_out() {
    static NONE: AtomicU32 = AtomicU32::new(0);
    // Tiles by themselves, of which some are computed before it is lost; and all together, of which none is, but some by themselves
    // before it is lost again.
    for (tile, first, again) in [(36, 3, 0), (1 << 14, 0, 3)] {
        let (first, again) =
            (&*Box::leak(Box::new(AtomicU32::new(first))), &*Box::leak(Box::new(AtomicU32::new(again))));
        let folder = tempdir().unwrap();
        let store = store(&folder, &plane_without_doubts());
        let tiles = Part::WHOLE.tiles(store.plane(), &store.tiling());
        let lost = || -> backend::Result<Box<dyn Backend>> { Ok(Box::new(Lost { left: again, tile })) };
        let run =
            sweep_stored(&store, &tiles, Box::new(Lost { left: first, tile }), &lost, &Unwatched).unwrap();
        assert_eq!((run.computed, run.failed.len()), (3, 3), "{run:?}");
        let status = store.status().unwrap();
        assert_eq!((status.done, status.missing), (3, 3));
        assert_eq!(status.failed.len(), 3);
        assert!(status.failed[0].message.contains("the device was lost"));
        // A device that is found again finishes everything, and nothing has failed any more.
        let run =
            sweep_stored(&store, &tiles, Box::new(Lost { left: &NONE, tile }), &cpu, &Unwatched).unwrap();
        assert_eq!((run.there, run.computed, run.failed.len()), (3, 3, 0));
        assert_eq!(store.status().unwrap().missing, 0);
        assert!(store.status().unwrap().failed.is_empty());
        is_whole(&store);
    }
}
