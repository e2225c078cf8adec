//! The tiles that were computed, as long as there is room for them.

use std::collections::HashMap;
use std::sync::Arc;

use parking_lot::Mutex;

use super::lattice::{Cell, TileKey};
use super::limits;
use super::tile::{Cells, Extents};
use crate::analysis::{Extent, Verdict};

/// One tile of one plane.
type Key = (u32, TileKey);

/// The tiles that were computed; those that were not asked for in a long time make room.
#[derive(Debug, Default)]
pub struct Tiles {
    kept: Mutex<Kept>,
}

#[derive(Debug, Default)]
struct Kept {
    tiles: HashMap<Key, Tile>,
    asked: u64,
}

#[derive(Debug)]
struct Tile {
    cells: Arc<Cells>,
    /// How far its motions go, where that was measured.
    extents: Option<Arc<Extents>>,
    /// When it was asked for last.
    last: u64,
}

impl Tiles {
    /// A tile, if it is there.
    pub fn get(&self, scene: u32, key: TileKey) -> Option<Arc<Cells>> {
        let mut kept = self.kept.lock();
        kept.asked += 1;
        let now = kept.asked;
        let tile = kept.tiles.get_mut(&(scene, key))?;
        tile.last = now;
        Some(tile.cells.clone())
    }

    /// How far the motions of a tile go, if it is there and that was measured.
    pub fn extents(&self, scene: u32, key: TileKey) -> Option<Arc<Extents>> {
        let kept = self.kept.lock();
        kept.tiles.get(&(scene, key))?.extents.clone()
    }

    /// Keeps with a tile how far its motions go.
    pub fn put_extents(&self, scene: u32, key: TileKey, extents: Arc<Extents>) {
        let mut kept = self.kept.lock();
        if let Some(tile) = kept.tiles.get_mut(&(scene, key)) {
            tile.extents = Some(extents);
        }
    }

    /// How far the motion of a cell goes, where that was measured at its own level or at a coarser one that has it too.
    pub fn extent(&self, scene: u32, cell: Cell) -> Option<Extent> {
        cell.levels().find_map(|(key, at)| Some(self.extents(scene, key)?[at]))
    }

    /// What is known of a cell: of its own level, or of a coarser one that has it too. `Some(None)` where there is no such
    /// system.
    pub fn cell(&self, scene: u32, cell: Cell) -> Option<Option<Verdict>> {
        cell.levels().find_map(|(key, at)| Some(self.get(scene, key)?[at]))
    }

    /// Keeps a tile.
    pub fn put(&self, scene: u32, key: TileKey, cells: Arc<Cells>) {
        let mut kept = self.kept.lock();
        kept.asked += 1;
        let now = kept.asked;
        kept.tiles.insert((scene, key), Tile { cells, extents: None, last: now });
        if kept.tiles.len() > limits::TILES {
            let mut ages: Vec<u64> = kept.tiles.values().map(|tile| tile.last).collect();
            ages.sort_unstable();
            let oldest = ages[ages.len() / 4];
            kept.tiles.retain(|_, tile| tile.last > oldest);
        }
    }

    /// Forgets the tiles of a plane.
    pub fn forget(&self, scene: u32) {
        let mut kept = self.kept.lock();
        kept.tiles.retain(|(of, _), _| *of != scene);
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.kept.lock().tiles.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn old_tiles_make_room_and_those_in_use_stay() {
        let tiles = Tiles::default();
        let key = |i: i64| TileKey { z: 0, i, j: 0 };
        for i in 0..=limits::TILES as i64 {
            tiles.get(1, key(0));
            tiles.put(1, key(i), Arc::new(vec![None; 256]));
        }
        assert!(tiles.count() <= limits::TILES && tiles.count() > limits::TILES / 2);
        assert!(tiles.get(1, key(0)).is_some(), "the tile that was asked for all the time is gone");
        assert!(tiles.get(1, key(1)).is_none(), "the oldest tile is still there");
        tiles.forget(1);
        assert_eq!(tiles.count(), 0);
    }

    #[test]
    fn a_coarser_tile_knows_some_cells_of_a_finer_one() {
        let tiles = Tiles::default();
        tiles.put(1, TileKey { z: -1, i: 0, j: 0 }, Arc::new(vec![None; 256]));
        assert!(tiles.cell(1, Cell { z: 0, i: 4, j: 30 }).is_some());
        assert!(tiles.cell(1, Cell { z: 2, i: 16, j: 8 }).is_some());
        assert!(tiles.cell(1, Cell { z: 0, i: 5, j: 30 }).is_none());
        assert!(tiles.cell(2, Cell { z: 0, i: 4, j: 30 }).is_none());
    }
}
