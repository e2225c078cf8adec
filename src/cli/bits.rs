//! `impact-atlas validate --reproducible`: an adapter held to the bits of the CPU's f32.

use anyhow::anyhow;
use impact_atlas::backend::{self, Backend, Choice};
use impact_atlas::plane::{Plane, Provenance, Window};
use impact_atlas::sweep::{measure_extents, sweep};
use impact_atlas::validate::differing;
use serde::Serialize;

use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, Result, estimate, note};

/// What is printed.
#[derive(Debug, Serialize)]
struct Bits<'a> {
    reference: &'a Provenance,
    candidate: &'a Provenance,
    cells: u64,
    /// Cells with other bits.
    differing: usize,
    /// Column and row of the first of them.
    first: Option<(u32, u32)>,
}

/// Computes a plane on an adapter and on the CPU in f32, both with exact arithmetic, and compares every bit of the results.
///
/// # Errors
/// Cells that differ, or what could not be computed.
pub fn hold(plane: &Plane, candidate: &dyn Backend, json: bool) -> Result<()> {
    let reference = backend::open_reproducible(Choice::Cpu, None)?;
    note(&format!("reference on {}: {}", reference.name(), reference.adapter()));
    let computed = |what: &str, backend: &dyn Backend| -> Result<_> {
        estimate::of_plane(&format!("the {what}'s map"), plane, backend)?;
        let mut map = sweep(plane, backend, &Progress::of_cells(what, plane.cells()))?;
        measure_extents(
            &mut map,
            backend,
            &Progress::of_cells(&format!("the {what}'s extents"), plane.cells()),
        )?;
        Ok(map)
    };
    let theirs = computed("candidate", candidate)?;
    let ours = computed("reference", &*reference)?;
    let cells = differing(&ours, &theirs);
    let window = Window::whole(plane);
    let bits = Bits {
        reference: &ours.provenance,
        candidate: &theirs.provenance,
        cells: plane.cells(),
        differing: cells.len(),
        first: cells.first().and_then(|&cell| window.places().nth(cell)),
    };
    if json {
        print_json(&bits)?;
    } else {
        print(&format!("{} of {} cells have the same bits", bits.cells - cells.len() as u64, bits.cells))?;
    }
    match bits.first {
        None => Ok(()),
        Some((column, row)) => Err(CliError::CheckFailed(anyhow!(
            "{} cells differ, the first in column {column}, row {row}, at {} = {}, {} = {}: this adapter does not round as \
             IEEE 754 asks",
            bits.differing,
            plane.x.quantity.name(),
            plane.x.value(column),
            plane.y.quantity.name(),
            plane.y.value(row)
        ).to_string())),
    }
}
