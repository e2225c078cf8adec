//! Cells that were computed before: those of a file.

use crate::analysis::Verdict;
use crate::plane::{Plane, RegionMap, Window};

/// The cells of a plane, as far as they were computed.
#[derive(Clone, Debug)]
pub struct Known {
    plane: Plane,
    verdicts: Vec<Option<Verdict>>,
}

impl Known {
    /// The most cells that are held.
    pub const MOST: u64 = 8_000_000;

    /// A plane of which nothing is known.
    pub fn nothing_of(plane: Plane) -> Self {
        let verdicts = vec![None; plane.cells() as usize];
        Known { plane, verdicts }
    }

    /// The plane.
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Adds the cells of a window, row by row.
    ///
    /// # Panics
    /// If there are not as many, or they are not on the plane.
    pub fn add(&mut self, window: Window, verdicts: &[Verdict]) {
        assert_eq!(window.cells(), verdicts.len(), "one verdict per cell");
        for ((column, row), verdict) in window.places().zip(verdicts) {
            self.verdicts[row as usize * self.plane.x.count as usize + column as usize] = Some(*verdict);
        }
    }

    /// What is known of a cell.
    pub fn at(&self, column: u32, row: u32) -> Option<Verdict> {
        self.verdicts[row as usize * self.plane.x.count as usize + column as usize]
    }
}

impl From<RegionMap> for Known {
    fn from(map: RegionMap) -> Self {
        Known { verdicts: map.verdicts.into_iter().map(Some).collect(), plane: map.plane }
    }
}
