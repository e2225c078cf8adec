//! The cells of a store: its tiles are read as they are looked at, and kept there once all their cells were computed.

use std::collections::HashMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use parking_lot::Mutex;

use super::lattice::{Cell, SIDE, TileKey};
use super::limits::HELD_CELLS;
use super::store::Tiles;
use crate::analysis::Verdict;
use crate::backend::Backend;
use crate::plane::Window;
use crate::plane::fields::{Assembled, Cells, Extras};
use crate::store::{StoreError, ZarrStore};
use crate::sweep::provenance;

/// To read a tile costs about as much as to compute one cell in so many of it: of a plane that is too large to be held,
/// a tile of which fewer are looked at, as from afar, is not read.
const SPARSE: usize = 256;

/// A store, and those of its tiles that are in memory.
#[derive(Debug)]
pub struct Stored {
    store: ZarrStore,
    held: Mutex<Held>,
    /// Whether tiles are kept: until one could not be.
    keeps: AtomicBool,
}

#[derive(Debug)]
struct Held {
    /// Which tiles were there when the store was last looked at.
    there: Vec<bool>,
    /// The cells of some tiles, and when they were last looked at.
    tiles: HashMap<u32, (Arc<Vec<Verdict>>, u64)>,
    cells: u64,
    looked: u64,
}

impl Held {
    fn put(&mut self, tile: u32, verdicts: Vec<Verdict>) {
        self.looked += 1;
        self.cells += verdicts.len() as u64;
        if let Some((before, _)) = self.tiles.insert(tile, (Arc::new(verdicts), self.looked)) {
            self.cells -= before.len() as u64;
        }
        while self.cells > HELD_CELLS && self.tiles.len() > 1 {
            let Some(oldest) = self.tiles.iter().min_by_key(|(_, (_, at))| *at).map(|(tile, _)| *tile) else {
                return;
            };
            let gone = self.tiles.remove(&oldest).map_or(0, |(cells, _)| cells.len() as u64);
            self.cells -= gone;
        }
    }
}

impl Stored {
    /// A store of which nothing is in memory yet.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn new(store: ZarrStore) -> Result<Self, StoreError> {
        let there = store.tiles_there()?;
        let held = Mutex::new(Held { there, tiles: HashMap::new(), cells: 0, looked: 0 });
        Ok(Stored { store, held, keeps: AtomicBool::new(true) })
    }

    /// The tile that holds a cell.
    fn tile(&self, column: u32, row: u32) -> u32 {
        let tiling = self.store.tiling();
        let [across, _] = tiling.shape();
        row / tiling.side * across + column / tiling.side
    }

    /// Whether a tile is there, perhaps since another process put it there.
    fn is_there(&self, tile: u32) -> bool {
        let known = self.held.lock().there[tile as usize];
        let there = known || self.store.is_there(tile);
        if there && !known {
            self.held.lock().there[tile as usize] = true;
        }
        there
    }

    /// Reads the tiles of some cells that are there, and not in memory.
    ///
    /// # Errors
    /// What could not be read, in words.
    pub fn prepare(&self, cells: impl Iterator<Item = (u32, u32)>) -> Result<(), String> {
        let mut wanted: HashMap<u32, usize> = HashMap::new();
        for (column, row) in cells {
            *wanted.entry(self.tile(column, row)).or_default() += 1;
        }
        let small = self.store.plane().cells() <= HELD_CELLS;
        let mut wanted: Vec<(u32, usize)> = wanted.into_iter().collect();
        wanted.sort_unstable();
        for (tile, count) in wanted {
            let window = self.store.tiling().window(tile);
            let worth = small || count * SPARSE >= window.cells();
            if !worth || self.held.lock().tiles.contains_key(&tile) || !self.is_there(tile) {
                continue;
            }
            let map = self.store.map_of(window).map_err(|error| error.to_string())?;
            self.held.lock().put(tile, map.verdicts);
        }
        Ok(())
    }

    /// A cell, if its tile is in memory.
    pub fn at(&self, column: u32, row: u32) -> Option<Verdict> {
        let tile = self.tile(column, row);
        let mut held = self.held.lock();
        held.looked += 1;
        let now = held.looked;
        let (cells, looked) = held.tiles.get_mut(&tile)?;
        *looked = now;
        Some(cells[self.store.tiling().window(tile).index((column, row))])
    }

    /// Whether tiles that a back end computes belong into the store: what the store holds was computed by the same.
    pub fn keeps(&self, backend: &dyn Backend) -> bool {
        self.keeps.load(Ordering::Relaxed)
            && self.store.extras() == Extras::NONE
            && *self.store.provenance() == provenance(backend)
    }

    /// Writes those tiles of the store that some tiles of a scene, just computed by a back end, complete; how many.
    ///
    /// # Errors
    /// What the file system reports; nothing more is kept then.
    pub fn keep(
        &self,
        (scene, backend): (u32, &dyn Backend),
        tiles: &Tiles,
        computed: &[TileKey],
    ) -> Result<usize, StoreError> {
        if !self.keeps(backend) {
            return Ok(0);
        }
        let mut touched: Vec<u32> = computed.iter().flat_map(|key| self.touched(*key)).collect();
        touched.sort_unstable();
        touched.dedup();
        let mut written = 0;
        for tile in touched {
            if self.is_there(tile) {
                continue;
            }
            let Some(verdicts) = whole(scene, tiles, self.store.tiling().window(tile)) else { continue };
            if let Err(error) = self.store.write_tile(tile, &Assembled::from(verdicts.clone())) {
                self.keeps.store(false, Ordering::Relaxed);
                return Err(error);
            }
            let mut held = self.held.lock();
            held.there[tile as usize] = true;
            held.put(tile, verdicts);
            written += 1;
        }
        Ok(written)
    }

    /// The tiles of the store that a tile of the plane's own cells has cells of.
    fn touched(&self, key: TileKey) -> Vec<u32> {
        let plane = self.store.plane();
        let side = i64::from(SIDE);
        let within = |tile: i64, count: u32| {
            let (first, count) = (tile.checked_mul(side)?, i64::from(count));
            let (from, until) = (first.max(0), (first + side).min(count));
            (from < until).then_some((from as u32, (until - from) as u32))
        };
        if key.z != 0 {
            return Vec::new();
        }
        match (within(key.i, plane.x.count), within(key.j, plane.y.count)) {
            (Some((column, columns)), Some((row, rows))) => {
                self.store.tiling().touched(&Window { column, row, columns, rows })
            }
            _ => Vec::new(),
        }
    }
}

/// The cells of a window, row by row, if all tiles of the plane's own cells that it lies on were computed.
fn whole(scene: u32, tiles: &Tiles, window: Window) -> Option<Vec<Verdict>> {
    let mut own = HashMap::new();
    let last = |first: u32, count: u32| i64::from((first + count - 1) / SIDE);
    for j in i64::from(window.row / SIDE)..=last(window.row, window.rows) {
        for i in i64::from(window.column / SIDE)..=last(window.column, window.columns) {
            let key = TileKey { z: 0, i, j };
            own.insert(key, tiles.get(scene, key)?);
        }
    }
    let cell = |(column, row): (u32, u32)| {
        let (key, at) = Cell { z: 0, i: column.into(), j: row.into() }.tile();
        own.get(&key)?[at]
    };
    window.places().map(cell).collect()
}
