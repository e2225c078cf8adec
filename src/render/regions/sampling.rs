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

/// Which of some values of a field most of the cells that a pixel covers have, if it is one of them.
pub(in crate::render) fn most<const K: usize>(
    cells: &dyn Cells,
    window: Window,
    field: &'static CellField,
    values: [u32; K],
    size: [usize; 2],
) -> Result<Vec<Option<u32>>, CellsError> {
    let read = |band: Window| {
        let there = cells.read(field, band)?;
        Ok((0..band.cells()).map(|i| there.whole(i)).collect())
    };
    bands::sampled(cells, window, size, read, |block| {
        let (mut all, mut own) = (0, [0; K]);
        for there in block {
            all += 1;
            for (own, value) in own.iter_mut().zip(values) {
                *own += u32::from(there == value);
            }
        }
        values.into_iter().zip(own).find(|(_, own)| 2 * own > all).map(|(value, _)| value)
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
