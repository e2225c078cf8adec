//! The cells of a plane that goes on in every direction, and at every fineness.
//!
//! The plane that was asked for has level 0. A cell of level z, counted from the plane's first cell, stands at i·2^−z
//! cells of level 0; every other cell of a level is one of the level below, so that a finer look keeps what is known.

use serde::Deserialize;

use super::limits;
use crate::plane::{Axis, AxisError, Plane};

/// Cells along either side of a tile.
pub const SIDE: u32 = 16;

/// Which tile: its level, and its column and row in tiles of that level; pages write the three as a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Deserialize)]
pub struct TileKey {
    /// The level.
    pub z: i32,
    /// The column.
    pub i: i64,
    /// The row.
    pub j: i64,
}

impl TileKey {
    /// Whether the tile is where tiles are computed.
    pub fn is_near(self) -> bool {
        let far = limits::FARTHEST / i64::from(SIDE);
        let near = |i: i64| (-far..=far).contains(&i);
        (limits::COARSEST..=limits::FINEST).contains(&self.z) && near(self.i) && near(self.j)
    }

    /// The cell in column `column` of row `row` of the tile.
    pub fn cell(self, column: u32, row: u32) -> Cell {
        let at = |tile: i64, i: u32| tile * i64::from(SIDE) + i64::from(i);
        Cell { z: self.z, i: at(self.i, column), j: at(self.j, row) }
    }
}

/// A cell: its level, and its column and row among the cells of that level; pages write the three as a list.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
pub struct Cell {
    /// The level.
    pub z: i32,
    /// The column.
    pub i: i64,
    /// The row.
    pub j: i64,
}

impl Cell {
    /// Whether the cell is where cells are computed.
    pub fn is_near(self) -> bool {
        let near = |i: i64| (-limits::FARTHEST..=limits::FARTHEST).contains(&i);
        (limits::COARSEST..=limits::FINEST).contains(&self.z) && near(self.i) && near(self.j)
    }

    /// The tile that holds the cell, and the cell's place in it, row by row.
    pub fn tile(self) -> (TileKey, usize) {
        let side = i64::from(SIDE);
        let key = TileKey { z: self.z, i: self.i.div_euclid(side), j: self.j.div_euclid(side) };
        (key, (self.j.rem_euclid(side) * side + self.i.rem_euclid(side)) as usize)
    }

    /// The same place as a cell of the level below, if it is one.
    pub fn coarser(self) -> Option<Cell> {
        let even = self.i % 2 == 0 && self.j % 2 == 0 && self.z > limits::COARSEST;
        even.then_some(Cell { z: self.z - 1, i: self.i / 2, j: self.j / 2 })
    }

    /// The tiles that hold this place as a cell of theirs, its own level's first, each with the cell's place in it.
    pub fn levels(self) -> impl Iterator<Item = (TileKey, usize)> {
        std::iter::successors(Some(self), |cell| cell.coarser()).map(Cell::tile)
    }

    /// The cell of the plane that was asked for at this place, if there is one: its column and its row.
    pub fn of_plane(self, plane: &Plane) -> Option<(u32, u32)> {
        Some((whole(self.z, self.i, &plane.x)?, whole(self.z, self.j, &plane.y)?))
    }
}

/// The place of a cell along an axis, in cells of level 0.
pub fn place(z: i32, i: i64) -> f64 {
    i as f64 * 2_f64.powi(-z)
}

/// The value of an axis at a cell. On the plane that was asked for it is that of its map to the bit.
pub fn value(axis: &Axis, z: i32, i: i64) -> f64 {
    whole(z, i, axis).map_or_else(|| axis.at(place(z, i)), |i| axis.value(i))
}

/// The index on the axis of a cell of a level, if it has one.
fn whole(z: i32, i: i64, axis: &Axis) -> Option<u32> {
    let at = place(z, i);
    (at.fract() == 0.0 && (0.0..f64::from(axis.count)).contains(&at)).then_some(at as u32)
}

/// Some of the cells of a level: columns and rows, both ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub struct Window {
    /// The level.
    pub z: i32,
    /// The first and the last column.
    pub columns: [i64; 2],
    /// The first and the last row.
    pub rows: [i64; 2],
}

impl Window {
    /// Whether the window lies where cells are computed, and is not empty.
    pub fn is_near(&self) -> bool {
        let ends = [(self.columns[0], self.rows[0]), (self.columns[1], self.rows[1])];
        ends.iter().all(|&(i, j)| Cell { z: self.z, i, j }.is_near())
            && self.columns[0] <= self.columns[1]
            && self.rows[0] <= self.rows[1]
    }

    /// How many columns and rows it has.
    pub fn size(&self) -> [u64; 2] {
        [self.columns, self.rows].map(|[first, last]| last.abs_diff(first).saturating_add(1))
    }

    /// How many cells it has.
    pub fn cells(&self) -> u64 {
        let [columns, rows] = self.size();
        columns.saturating_mul(rows)
    }

    /// The plane of the window's cells.
    ///
    /// # Errors
    /// Axes that leave the range of their quantity.
    pub fn plane(&self, plane: &Plane) -> Result<Plane, AxisError> {
        let axis = |axis: &Axis, [first, last]: [i64; 2]| {
            let whole_axis = (whole(self.z, first, axis), whole(self.z, last, axis));
            if self.z == 0 && whole_axis == (Some(0), Some(axis.count - 1)) {
                return Ok(*axis);
            }
            let count = u32::try_from(last.abs_diff(first).saturating_add(1)).unwrap_or(u32::MAX);
            let ends = [first, last].map(|i| value(axis, self.z, i));
            Axis::spaced(axis.quantity, ends[0], ends[1], count, axis.spacing)
        };
        Ok(Plane { x: axis(&plane.x, self.columns)?, y: axis(&plane.y, self.rows)?, ..plane.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::plane::Start;

    fn axis(text: &str) -> Axis {
        text.parse().unwrap()
    }

    #[test]
    fn the_cells_of_level_0_are_those_of_the_plane() {
        for text in ["omega=0.2:5:800", "omega=5:0.2:77", "omega=0.1:10:401:log"] {
            let axis = axis(text);
            for i in 0..axis.count {
                assert_eq!(value(&axis, 0, i.into()), axis.value(i), "{text}, {i}");
                // Coarser and finer levels meet the same cells.
                assert_eq!(value(&axis, 3, 8 * i64::from(i)), axis.value(i));
                assert_eq!(value(&axis, -2, i64::from(i / 4)), axis.value(4 * (i / 4)));
            }
            assert!(value(&axis, 0, -1) != axis.value(0) && value(&axis, 1, 1) != axis.value(0));
        }
    }

    #[test]
    fn a_cell_is_in_its_tile() {
        for (i, j) in [(0, 0), (17, -1), (-16, 31), (-17, 5)] {
            let cell = Cell { z: 3, i, j };
            let (key, at) = cell.tile();
            assert_eq!(key.cell(at as u32 % SIDE, at as u32 / SIDE), cell);
            assert!(at < (SIDE * SIDE) as usize);
        }
        assert_eq!(Cell { z: 0, i: 4, j: -2 }.coarser(), Some(Cell { z: -1, i: 2, j: -1 }));
        assert_eq!(Cell { z: 0, i: 4, j: 3 }.coarser(), None);
    }

    #[test]
    fn the_window_of_all_cells_is_the_plane() {
        let schedule = Schedule { transient: 300, observe: 150, max_period: 32, fixed_periods: false };
        let plane =
            Plane::of_paper("omega=0.2:5:80", "delta=0.02:0.8:60", Start::Symmetric, schedule).unwrap();
        let all = Window { z: 0, columns: [0, 79], rows: [0, 59] };
        assert_eq!(all.plane(&plane).unwrap(), plane);
        let part = Window { z: 1, columns: [-2, 10], rows: [3, 9] }.plane(&plane).unwrap();
        assert_eq!((part.x.count, part.y.count), (13, 7));
        assert_eq!(part.x.first, plane.x.at(-1.0));
        assert!(Window { z: 0, columns: [-900, 0], rows: [0, 9] }.plane(&plane).is_err());
        assert!(!Window { z: 0, columns: [5, 4], rows: [0, 9] }.is_near());
        assert!(!Window { z: 0, columns: [0, i64::MAX], rows: [0, 9] }.is_near());
    }
}
