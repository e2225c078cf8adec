//! Rectangles of cells, and the tiles that a plane is computed in.

use super::spec::Plane;

/// A rectangle of cells of a plane; it may be empty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Window {
    /// The first column.
    pub column: u32,
    /// The first row.
    pub row: u32,
    /// How many columns.
    pub columns: u32,
    /// How many rows.
    pub rows: u32,
}

impl Window {
    /// All cells of a plane.
    pub fn whole<T>(plane: &Plane<T>) -> Self {
        Window { column: 0, row: 0, columns: plane.x.count, rows: plane.y.count }
    }

    /// Whether all of its cells are on a plane.
    pub fn is_on<T>(&self, plane: &Plane<T>) -> bool {
        let ends = [(self.column, self.columns, plane.x.count), (self.row, self.rows, plane.y.count)];
        ends.into_iter().all(|(first, count, all)| first.checked_add(count).is_some_and(|end| end <= all))
    }

    /// How many cells it holds.
    pub fn cells(&self) -> usize {
        self.columns as usize * self.rows as usize
    }

    /// Its cells, row by row: column and row on the plane.
    pub fn places(&self) -> impl Iterator<Item = (u32, u32)> + use<> {
        let Window { column, row, columns, rows } = *self;
        (row..row + rows).flat_map(move |row| (column..column + columns).map(move |column| (column, row)))
    }

    /// Whether a cell of the plane is one of them.
    pub fn contains(&self, (column, row): (u32, u32)) -> bool {
        (self.column..self.column + self.columns).contains(&column)
            && (self.row..self.row + self.rows).contains(&row)
    }

    /// The cells that it shares with another; empty if there are none.
    pub fn shared(&self, other: &Window) -> Window {
        let span = |first: [u32; 2], count: [u32; 2]| {
            let begin = first[0].max(first[1]);
            let end = (first[0] + count[0]).min(first[1] + count[1]);
            (begin, end.saturating_sub(begin))
        };
        let (column, columns) = span([self.column, other.column], [self.columns, other.columns]);
        let (row, rows) = span([self.row, other.row], [self.rows, other.rows]);
        Window { column, row, columns, rows }
    }

    /// Where a cell of the plane stands among the window's cells, row by row.
    pub fn index(&self, (column, row): (u32, u32)) -> usize {
        (row - self.row) as usize * self.columns as usize + (column - self.column) as usize
    }

    /// The plane of the window's cells alone: the same cells, with the same values on the axes.
    pub fn plane<T: Clone>(&self, plane: &Plane<T>) -> Plane<T> {
        Plane {
            x: plane.x.part(self.column, self.columns),
            y: plane.y.part(self.row, self.rows),
            ..plane.clone()
        }
    }
}

/// A plane cut into square tiles, those at the right and upper ends smaller; counted row by row from the first row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tiling {
    /// Cells along a side of a tile.
    pub side: u32,
    columns: u32,
    rows: u32,
}

impl Tiling {
    /// The longest side.
    pub const LARGEST: u32 = 1024;
    /// The side of a plane that is not small.
    const USUAL: u32 = 128;
    /// A plane has so many tiles at least, unless they would be smaller than [`Tiling::SMALL`].
    const FEWEST: u32 = 64;
    const SMALL: u32 = 16;

    /// A plane in tiles of a side.
    ///
    /// # Panics
    /// If the side is 0.
    pub fn of(plane: &Plane, side: u32) -> Self {
        assert!(side > 0, "a tile has at least one cell");
        Tiling { side, columns: plane.x.count, rows: plane.y.count }
    }

    /// A plane in tiles that are worth a dispatch, and still enough of them to be shared out.
    pub fn usual(plane: &Plane) -> Self {
        let sides = std::iter::successors(Some(Self::USUAL), |side| Some(side / 2));
        let mut fitting = sides.take_while(|side| *side > Self::SMALL).map(|side| Tiling::of(plane, side));
        fitting.find(|tiling| tiling.count() >= Self::FEWEST).unwrap_or(Tiling::of(plane, Self::SMALL))
    }

    /// Tiles in a row and in a column.
    pub fn shape(&self) -> [u32; 2] {
        [self.columns.div_ceil(self.side), self.rows.div_ceil(self.side)]
    }

    /// How many tiles there are.
    pub fn count(&self) -> u32 {
        self.shape().iter().product()
    }

    /// Column and row of a tile among the tiles.
    pub fn place(&self, tile: u32) -> [u32; 2] {
        let [across, _] = self.shape();
        [tile % across, tile / across]
    }

    /// The cells of a tile.
    pub fn window(&self, tile: u32) -> Window {
        let [column, row] = self.place(tile).map(|place| place * self.side);
        Window {
            column,
            row,
            columns: self.side.min(self.columns - column),
            rows: self.side.min(self.rows - row),
        }
    }

    /// The tiles that a window touches.
    pub fn touched(&self, window: &Window) -> Vec<u32> {
        let [across, _] = self.shape();
        let span = |first: u32, count: u32| first / self.side..(first + count).div_ceil(self.side);
        let columns = span(window.column, window.columns);
        span(window.row, window.rows)
            .flat_map(|row| columns.clone().map(move |column| row * across + column))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::plane::Start;

    fn plane(columns: u32, rows: u32) -> Plane {
        let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
        let (x, y) = (format!("omega=1:3:{columns}"), format!("delta=0.1:0.4:{rows}"));
        Plane::of_paper(&x, &y, Start::Rest, schedule).unwrap()
    }

    #[test]
    fn tiles_hold_every_cell_once() {
        for (columns, rows, side) in [(7, 5, 3), (6, 6, 3), (2, 9, 16), (100, 70, 16)] {
            let plane = plane(columns, rows);
            let tiling = Tiling::of(&plane, side);
            let mut held = vec![0; Window::whole(&plane).cells()];
            for tile in 0..tiling.count() {
                for place in tiling.window(tile).places() {
                    held[Window::whole(&plane).index(place)] += 1;
                }
            }
            assert!(held.iter().all(|&times| times == 1), "{columns} × {rows} by {side}");
        }
    }

    #[test]
    fn the_tiles_that_a_window_touches_are_those_that_share_cells() {
        let tiling = Tiling::of(&plane(40, 30), 8);
        for window in [(0, 0, 40, 30), (7, 7, 2, 2), (8, 8, 8, 8), (39, 29, 1, 1), (3, 20, 30, 1)] {
            let (column, row, columns, rows) = window;
            let window = Window { column, row, columns, rows };
            let sharing: Vec<u32> =
                (0..tiling.count()).filter(|&tile| tiling.window(tile).shared(&window).cells() > 0).collect();
            assert_eq!(tiling.touched(&window), sharing);
        }
    }

    #[test]
    fn small_planes_have_small_tiles() {
        let side = |columns, rows| Tiling::usual(&plane(columns, rows)).side;
        assert_eq!([side(10_000, 10_000), side(800, 600), side(200, 150), side(6, 4)], [128, 64, 16, 16]);
    }

    #[test]
    fn a_part_of_a_plane_has_the_same_values() {
        for text in ["omega=1:3:50", "omega=0.1:10:50:log", "omega=3:1:50"] {
            let mut plane = plane(50, 20);
            plane.x = text.parse().unwrap();
            let window = Window { column: 13, row: 5, columns: 20, rows: 4 };
            let part = window.plane(&plane);
            assert_eq!((part.x.count, part.y.count), (20, 4));
            for i in 0..20 {
                let (here, there) = (part.x.value(i), plane.x.value(13 + i));
                assert!((here - there).abs() < 1e-12 * there, "{text}: {here} and {there}");
            }
        }
    }
}
