//! Some cells of a plane in equal steps, as a map of their own.

use serde::Deserialize;

use super::{CellField, Cells, CellsError, Extras, assembled};
use crate::figure::Steps;
use crate::plane::{Axis, Made, Plane, RegionMap, Window};

/// A window of a plane as a map: all of its cells, or where they are more than `most` every second, third … of each row and
/// column. Without multipliers.
///
/// # Errors
/// What could not be read, and cells that were not computed.
pub fn thinned(cells: &dyn Cells, window: Window, most: usize) -> Result<RegionMap, CellsError> {
    let step =
        (1..).find(|step| sparse(window, *step).0 * sparse(window, *step).1 <= most.max(1)).unwrap_or(1);
    let Made { plane, provenance, .. } = Made::deserialize(cells.configuration())
        .map_err(|error| CellsError(format!("the configuration is not understood: {error}")))?;
    let plane = window.plane(&plane);
    let family = plane.parameters.family();
    let mut verdicts = Vec::new();
    let end = window.row + window.rows;
    // In the bands in which the cells lie, so that none is read twice.
    let mut row = window.row;
    while row < end {
        let next = (row / cells.band() + 1) * cells.band();
        let band = Window { row, rows: next.min(end) - row, ..window };
        let wanted = |(column, row): &(u32, u32)| {
            (column - window.column).is_multiple_of(step) && (row - window.row).is_multiple_of(step)
        };
        let picks: Vec<usize> = band.places().filter(wanted).map(|place| band.index(place)).collect();
        if !picks.is_empty() {
            let read = |field: &'static CellField| {
                Ok(cells.read(field, band)?.picked(&picks, field.inner.len(family)))
            };
            verdicts.extend(assembled::<CellsError>(family, picks.len(), Extras::NONE, read)?.verdicts);
        }
        row = next;
    }
    let axis = |axis: Axis| {
        let count = axis.count.div_ceil(step);
        Axis { steps: Steps { last: axis.value((count - 1) * step), count, ..axis.steps }, ..axis }
    };
    let plane = Plane { x: axis(plane.x), y: axis(plane.y), ..plane };
    Ok(RegionMap::new(plane, provenance, verdicts))
}

/// Columns and rows of a window in steps.
fn sparse(window: Window, step: u32) -> (usize, usize) {
    (window.columns.div_ceil(step) as usize, window.rows.div_ceil(step) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{Regime, Schedule, Verdict};
    use crate::plane::{Provenance, Start};

    fn map(columns: u32, rows: u32) -> RegionMap {
        let of = |i: u32| Verdict { periods: i, ..Verdict::of_motion(Regime::Periodic, [1, 1, 1], true) };
        let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
        let (x, y) = (format!("omega=1:3:{columns}"), format!("delta=0.1:0.4:{rows}"));
        let plane = Plane::of_paper(&x, &y, Start::Rest, schedule).unwrap();
        RegionMap::new(plane, Provenance::default(), (0..columns * rows).map(of).collect())
    }

    #[test]
    fn a_map_that_fits_is_the_same() {
        let map = map(7, 5);
        let same = thinned(&map, Window::whole(&map.plane), 35).unwrap();
        assert_eq!(same, map);
    }

    #[test]
    fn a_larger_one_has_every_so_many_cells_at_their_places() {
        let map = map(50, 700);
        let window = Window { column: 3, row: 10, columns: 40, rows: 600 };
        let thin = thinned(&map, window, 4000).unwrap();
        assert_eq!((thin.plane.x.count, thin.plane.y.count), (14, 200));
        for (column, row) in [(0, 0), (13, 199), (5, 100)] {
            let there = map.at(3 + 3 * column, 10 + 3 * row);
            assert_eq!(thin.at(column, row).periods, there.periods);
            assert!((thin.plane.x.value(column) - map.plane.x.value(3 + 3 * column)).abs() < 1e-12);
        }
    }
}
