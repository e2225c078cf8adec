//! Some cells of a plane in equal steps, as a map of their own.

use serde::Deserialize;

use super::{Cells, CellsError, assembled};
use crate::plane::{Axis, Plane, Provenance, RegionMap, Window};

/// A window of a plane as a map: all of its cells, or where they are more than `most` every second, third … of each row and
/// column. Without multipliers.
///
/// # Errors
/// What could not be read, and cells that were not computed.
pub fn thinned(cells: &dyn Cells, window: Window, most: usize) -> Result<RegionMap, CellsError> {
    let step =
        (1..).find(|step| sparse(window, *step).0 * sparse(window, *step).1 <= most.max(1)).unwrap_or(1);
    let plane = window.plane(cells.plane());
    let family = plane.parameters.family();
    let mut verdicts = Vec::new();
    for row in (0..window.rows).step_by(step as usize) {
        let line = Window { row: window.row + row, rows: 1, ..window };
        let (of_line, _) =
            assembled::<CellsError>(family, line.cells(), false, |field| cells.read(field, line))?;
        verdicts.extend(of_line.into_iter().step_by(step as usize));
    }
    let axis = |axis: Axis| {
        let count = axis.count.div_ceil(step);
        Axis { last: axis.value((count - 1) * step), count, ..axis }
    };
    let provenance = Provenance::deserialize(cells.configuration())
        .map_err(|error| CellsError(format!("the configuration is not understood: {error}")))?;
    let plane = Plane { x: axis(plane.x), y: axis(plane.y), ..plane };
    Ok(RegionMap { plane, provenance, verdicts, multipliers: None })
}

/// Columns and rows of a window in steps.
fn sparse(window: Window, step: u32) -> (usize, usize) {
    (window.columns.div_ceil(step) as usize, window.rows.div_ceil(step) as usize)
}
