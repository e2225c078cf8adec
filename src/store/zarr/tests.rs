//! Stores: made, refused, damaged, written by two at once.

use std::fs;

use tempfile::tempdir;

use super::*;
use crate::analysis::{Regime, Schedule, Verdict};
use crate::plane::fields::{CELL_FIELDS, Cells, CellsError, Extras, NOT_COMPUTED, Values};
use crate::plane::{Start, Window};

fn plane() -> Plane {
    let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
    Plane::of_paper("omega=1:3:10", "delta=0.1:0.4:7", Start::Rest, schedule).unwrap()
}

fn provenance() -> Provenance {
    Provenance { version: "0.1.0".into(), backend: "cpu".into(), adapter: "test bench".into() }
}

fn of(path: &Path, plane: &Plane, tile: Option<u32>) -> Result<ZarrStore, StoreError> {
    ZarrStore::of(path, &Wanted { plane, provenance: &provenance(), extras: Extras::NONE, tile })
}

fn verdicts(window: Window) -> Vec<Verdict> {
    let of = |(column, row): (u32, u32)| {
        let mut verdict = Verdict::of_motion(Regime::Periodic, [1, 1, 2], false);
        verdict.state = [f64::from(column), f64::from(row), 0.0, -1.0].into();
        verdict.periods = 100 * column + row;
        verdict
    };
    window.places().map(of).collect()
}

fn fill(store: &ZarrStore, tile: u32) {
    store.write_tile(tile, &verdicts(store.tiling().window(tile)).into()).unwrap();
}

fn regimes(store: &ZarrStore) -> Vec<u8> {
    match store.read(&CELL_FIELDS[0], Window::whole(store.plane())).unwrap() {
        Values::U8(values) => values,
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_store_is_not_made_with_tiles_that_none_has() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("a.zarr");
    for side in [0, Tiling::LARGEST + 1] {
        assert!(matches!(of(&path, &plane(), Some(side)), Err(StoreError::Tile(refused)) if refused == side));
        assert!(!path.exists());
    }
    assert!(of(&path, &plane(), Some(Tiling::LARGEST)).is_ok());
}

#[test]
fn tiles_are_there_or_not_and_hold_what_was_written() {
    let folder = tempdir().unwrap();
    let store = of(&folder.path().join("plane.zarr"), &plane(), Some(4)).unwrap();
    assert!(regimes(&store).iter().all(|&code| code == NOT_COMPUTED));
    assert!(store.map_of(Window::whole(store.plane())).is_err());
    for tile in [5, 0, 1, 2, 3, 4] {
        assert!(!store.is_there(tile));
        fill(&store, tile);
        assert!(store.is_there(tile));
        let there = store.tiles_there().unwrap();
        assert!((0..6).all(|tile| there[tile as usize] == store.is_there(tile)));
    }
    let window = Window { column: 3, row: 2, columns: 6, rows: 4 };
    assert_eq!(store.map_of(window).unwrap().verdicts, verdicts(window));
}

#[test]
fn a_tile_without_one_of_its_shards_is_not_there() {
    let folder = tempdir().unwrap();
    let store = of(&folder.path().join("plane.zarr"), &plane(), Some(4)).unwrap();
    fill(&store, 1);
    fs::remove_file(folder.path().join("plane.zarr/state/c/0/1/0")).unwrap();
    assert!(!store.is_there(1) && !store.tiles_there().unwrap()[1]);
}

#[test]
fn another_plane_into_the_same_store_is_refused_with_what_differs() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("plane.zarr");
    fill(&of(&path, &plane(), Some(4)).unwrap(), 1);
    of(&path, &plane(), None).unwrap();
    let mut other = plane();
    other.y = "delta=0.1:0.5:7".parse().unwrap();
    other.task.transient = 5;
    let message = of(&path, &other, Some(8)).unwrap_err().to_string();
    for part in ["y.last is 0.4 there and 0.5 here", "schedule.transient is 4 there and 5 here", "tile is 4"]
    {
        assert!(message.contains(part), "{message}");
    }
    assert!(of(&path, &plane(), None).unwrap().is_there(1), "it was left as it is");
}

#[test]
fn stores_of_others_and_of_other_formats_are_refused() {
    let folder = tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let says = |name: &str| ZarrStore::open(&path(name)).unwrap_err().to_string();
    assert!(says("none.zarr").contains("there is no store"));
    fs::create_dir(path("empty.zarr")).unwrap();
    assert!(says("empty.zarr").contains("no Zarr group"));
    fs::write(path("file.zarr"), "text").unwrap();
    assert!(says("file.zarr").contains("it is a file"));
    fs::create_dir(path("other.zarr")).unwrap();
    fs::write(path("other.zarr/zarr.json"), r#"{"zarr_format":3,"node_type":"group"}"#).unwrap();
    assert!(says("other.zarr").contains("another program wrote it"));
    of(&path("ours.zarr"), &plane(), None).unwrap();
    let about = fs::read_to_string(path("ours.zarr/zarr.json")).unwrap();
    let change = |from: &str, to: &str| {
        assert!(about.contains(from), "{about}");
        fs::write(path("ours.zarr/zarr.json"), about.replace(from, to)).unwrap();
    };
    change("\"impact_atlas_format\": 1", "\"impact_atlas_format\": 7");
    assert!(says("ours.zarr").contains("format 7"));
    change("\"tile\": 16", "\"tile\": 0");
    assert!(says("ours.zarr").contains("how large its tiles are"));
}

#[test]
fn a_damaged_shard_is_named() {
    let folder = tempdir().unwrap();
    let store = of(&folder.path().join("plane.zarr"), &plane(), Some(4)).unwrap();
    (0..6).for_each(|tile| fill(&store, tile));
    let shard = folder.path().join("plane.zarr/periods/c/1/2");
    let bytes = fs::read(&shard).unwrap();
    let periods = crate::plane::fields::CellField::named("periods").unwrap();
    let read = || store.read(periods, Window::whole(store.plane()));
    for bad in
        [&bytes[..bytes.len() / 2], &bytes[..3], &[&bytes[..5], &[!bytes[5]], &bytes[6..]].concat(), b""]
    {
        fs::write(&shard, bad).unwrap();
        let CellsError(message) = read().unwrap_err();
        assert!(message.contains("periods/c/1/2") && message.contains("delete it"), "{message}");
        // What was cut off counts as missing; what was changed within is found when it is read.
        let there = store.tiles_there().unwrap();
        assert_eq!(
            (there[5], store.is_there(5)),
            (bad.len() == bytes.len(), there[5]),
            "{} bytes",
            bad.len()
        );
        assert_eq!(there.iter().filter(|there| **there).count(), if there[5] { 6 } else { 5 });
    }
    fs::write(&shard, &bytes).unwrap();
    assert!(read().is_ok() && store.tiles_there().unwrap() == [true; 6]);
}

#[test]
fn the_same_tile_twice_is_the_same_bytes() {
    let folder = tempdir().unwrap();
    let store = of(&folder.path().join("plane.zarr"), &plane(), Some(4)).unwrap();
    let files = || {
        let names = ["regime/c/0/1", "state/c/0/1/0", "lyapunov/c/0/1"];
        names.map(|name| fs::read(folder.path().join("plane.zarr").join(name)).unwrap())
    };
    fill(&store, 1);
    let first = files();
    rayon::scope(|scope| (0..8).for_each(|_| scope.spawn(|_| fill(&store, 1))));
    assert_eq!(files(), first);
    let hidden: Vec<_> = fs::read_dir(folder.path().join("plane.zarr").join(HIDDEN)).unwrap().collect();
    assert!(hidden.is_empty(), "{hidden:?}");
}
