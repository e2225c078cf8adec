//! Cells of a plane brought to the pixels of a picture, some rows at a time, so that memory does not grow with the plane.

use std::ops::Range;

use rayon::prelude::*;

use crate::plane::Window;
use crate::plane::fields::{Cells, CellsError};

/// So many cells are read at a time, about.
const TOGETHER: usize = 1 << 20;

/// A window in bands of whole rows, as many as are best read together.
pub(super) fn bands(cells: &dyn Cells, window: Window) -> Vec<Window> {
    let rows = rows_together(cells, window);
    let end = window.row + window.rows;
    let band = |row: u32| Window { row, rows: rows.min(end - row), ..window };
    (window.row..end).step_by(rows as usize).map(band).collect()
}

/// How many rows of a window are best read together.
fn rows_together(cells: &dyn Cells, window: Window) -> u32 {
    let band = cells.band().max(1);
    let fitting = (TOGETHER / window.columns.max(1) as usize) as u32;
    (fitting / band).max(1) * band
}

/// The cells of a window brought to `width` × `height` pixels, the first row of the window at the bottom: `read` gives some
/// rows of it, `shown` makes one of those that a pixel covers.
///
/// # Errors
/// Those of `read`.
pub(super) fn sampled<V: Copy + Sync, T: Send>(
    cells: &dyn Cells,
    window: Window,
    [width, height]: [usize; 2],
    read: impl Fn(Window) -> Result<Vec<V>, CellsError>,
    shown: impl Fn(&mut dyn Iterator<Item = V>) -> T + Sync,
) -> Result<Vec<T>, CellsError> {
    let (columns, rows) = (window.columns as usize, window.rows as usize);
    let most = rows_together(cells, window) as usize;
    let mut lines: Vec<Vec<T>> = Vec::with_capacity(height);
    // Upwards from the first row, as the cells lie.
    let mut first = 0;
    while first < height {
        let begin = covered(first, height, rows).start;
        let fits = |y: &usize| *y == first || covered(*y, height, rows).end <= begin + most;
        let last = (first..height).take_while(fits).last().unwrap_or(first);
        let end = covered(last, height, rows).end;
        let band = Window { row: window.row + begin as u32, rows: (end - begin) as u32, ..window };
        let values = read(band)?;
        let line = |y: usize| {
            let down = covered(y, height, rows);
            let pixel = |x: usize| {
                let across = covered(x, width, columns);
                let mut block = down.clone().flat_map(|row| {
                    let start = (row - begin) * columns;
                    values[start + across.start..start + across.end].iter().copied()
                });
                shown(&mut block)
            };
            (0..width).map(pixel).collect::<Vec<T>>()
        };
        lines.par_extend((first..=last).into_par_iter().map(line));
        first = last + 1;
    }
    Ok(lines.into_iter().rev().flatten().collect())
}

/// The cells that pixel `i` of `pixels` shows: the one under its middle, or all that it covers.
pub(super) fn covered(i: usize, pixels: usize, cells: usize) -> Range<usize> {
    if cells <= pixels {
        let middle = (2 * i + 1) * cells / (2 * pixels);
        middle..middle + 1
    } else {
        i * cells / pixels..(i + 1) * cells / pixels
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::example;

    #[test]
    fn every_cell_is_shown_once_where_sizes_match() {
        for (pixels, count) in [(7, 7), (7, 3), (3, 7), (800, 3), (3, 800), (20_000, 65_536)] {
            let shown: Vec<usize> = (0..pixels).flat_map(|i| covered(i, pixels, count)).collect();
            assert!(shown.is_sorted() && shown[0] == 0 && *shown.last().unwrap() == count - 1);
            if count >= pixels {
                assert_eq!(shown.len(), count);
            }
        }
    }

    #[test]
    fn a_window_is_read_in_bands_and_shown_upside_down() {
        let map = example::map(6, 5);
        let window = Window { column: 1, row: 1, columns: 4, rows: 3 };
        assert_eq!(bands(&map, window).iter().map(|band| band.rows).sum::<u32>(), 3);
        let read = |band: Window| Ok(band.places().collect::<Vec<_>>());
        let shown = sampled(&map, window, [4, 3], read, |block| block.next().unwrap()).unwrap();
        assert_eq!((shown[0], shown[11]), ((1, 3), (4, 1)));
        let counted = sampled(&map, window, [2, 1], read, |block| block.count()).unwrap();
        assert_eq!(counted, [6, 6]);
    }
}
