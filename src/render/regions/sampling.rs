//! Numbers of cells in pixels.

use super::bands;
use crate::plane::Window;
use crate::plane::fields::{CellField, Cells, CellsError, Layer};

/// Numbers of a window's cells in pixels, the first row at the bottom: means of the cells that a pixel covers, over those
/// that have one; NaN where most have none, minus infinity where most have that.
pub(in crate::render) fn means(
    cells: &dyn Cells,
    window: Window,
    layer: &Layer,
    size: [usize; 2],
) -> Result<Vec<f32>, CellsError> {
    bands::sampled(cells, window, size, |band| layer.values(cells, band), mean)
}

/// Whether most of the cells that a pixel covers have a value of a field.
pub(in crate::render) fn most(
    cells: &dyn Cells,
    window: Window,
    field: &'static CellField,
    value: u32,
    size: [usize; 2],
) -> Result<Vec<bool>, CellsError> {
    let read = |band: Window| {
        let values = cells.read(field, band)?;
        Ok((0..band.cells()).map(|i| values.whole(i) == value).collect())
    };
    bands::sampled(cells, window, size, read, |block| {
        let (all, own) = block.fold((0, 0), |(all, own), is| (all + 1, own + u32::from(is)));
        2 * own > all
    })
}

fn mean(block: &mut dyn Iterator<Item = f32>) -> f32 {
    let (mut sum, mut there, mut lost, mut all) = (0.0_f64, 0_u32, 0_u32, 0_u32);
    for value in block {
        all += 1;
        if value.is_finite() {
            sum += f64::from(value);
            there += 1;
        } else if value == f32::NEG_INFINITY {
            lost += 1;
        }
    }
    match () {
        () if 2 * there >= all && there > 0 => (sum / f64::from(there)) as f32,
        () if 2 * lost >= all => f32::NEG_INFINITY,
        () => f32::NAN,
    }
}
