//! Cells that were computed before: those of a file, or of a store.

use super::lattice::Cell;
use super::limits::HELD_CELLS;
use super::stored::Stored;
use crate::analysis::Verdict;
use crate::plane::fields::Cells as _;
use crate::plane::{Plane, RegionMap};
use crate::store::ZarrStore;

/// The cells of a plane, as far as they were computed.
#[derive(Debug)]
pub struct Known {
    plane: Plane,
    /// Whether its periodic cells were certified.
    certified: bool,
    cells: Cells,
}

#[derive(Debug)]
enum Cells {
    /// All of them, row by row.
    All(Vec<Verdict>),
    /// Those of a store.
    Stored(Box<Stored>),
}

impl Known {
    /// The most cells that are held in memory.
    pub const MOST: u64 = HELD_CELLS;

    /// The cells of a store, which are read as they are looked at.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn of_store(store: ZarrStore) -> Result<Self, crate::store::StoreError> {
        let (plane, certified) = (store.plane().clone(), store.extras().certified);
        Ok(Known { plane, certified, cells: Cells::Stored(Box::new(Stored::new(store)?)) })
    }

    /// The plane.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Whether its periodic cells were certified.
    pub fn is_certified(&self) -> bool {
        self.certified
    }

    /// The store that the cells are in, if they are in one.
    pub fn stored(&self) -> Option<&Stored> {
        match &self.cells {
            Cells::All(_) => None,
            Cells::Stored(stored) => Some(stored),
        }
    }

    /// Makes ready what is known of some cells, as far as that is sooner done than computing them.
    ///
    /// # Errors
    /// What could not be read, in words.
    pub fn prepare(&self, cells: impl Iterator<Item = Cell>) -> Result<(), String> {
        match &self.cells {
            Cells::All(_) => Ok(()),
            Cells::Stored(stored) => stored.prepare(cells.filter_map(|cell| cell.of_plane(&self.plane))),
        }
    }

    /// What is known of a cell, of those that were made ready.
    pub fn at(&self, column: u32, row: u32) -> Option<Verdict> {
        match &self.cells {
            Cells::All(verdicts) => {
                verdicts.get(row as usize * self.plane.x.count as usize + column as usize).copied()
            }
            Cells::Stored(stored) => stored.at(column, row),
        }
    }
}

impl From<RegionMap> for Known {
    fn from(map: RegionMap) -> Self {
        Known { certified: map.extras().certified, plane: map.plane, cells: Cells::All(map.verdicts) }
    }
}
