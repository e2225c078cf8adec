//! How far the motions of a map go.

use super::Result;
use super::begun::of_begun;
use super::map::window_jobs;
use crate::analysis::{Extent, Verdict};
use crate::backend::{self, Backend, Silent, Watch};
use crate::plane::{Plane, RegionMap, Window};

/// Measures root mean square and peak of every coordinate in every cell of a map, and keeps them there.
///
/// # Errors
/// What the back end could not do.
pub fn measure_extents(map: &mut RegionMap, backend: &dyn Backend, watch: &dyn Watch) -> Result<()> {
    map.extents = Some(window_extents(&map.plane, Window::whole(&map.plane), &map.verdicts, backend, watch)?);
    Ok(())
}

/// The same of some cells of a plane, from their verdicts; row by row.
///
/// # Errors
/// What the back end could not do.
pub(super) fn window_extents(
    plane: &Plane,
    window: Window,
    verdicts: &[Verdict],
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Extent>> {
    let mut extents = Vec::with_capacity(verdicts.len());
    // Some rows at a time: jobs take more memory than what becomes of them.
    let columns = window.columns.max(1) as usize;
    let rows = (backend.tile() / columns).max(1);
    for (k, verdicts) in verdicts.chunks(rows * columns).enumerate() {
        let part =
            Window { row: window.row + (k * rows) as u32, rows: (verdicts.len() / columns) as u32, ..window };
        let begun = window_jobs(plane, &[part])?;
        let of_these: Vec<Verdict> = verdicts
            .iter()
            .zip(&begun)
            .filter(|(_, begun)| begun.is_ok())
            .map(|(verdict, _)| *verdict)
            .collect();
        extents.extend(of_begun(
            begun,
            |jobs| backend::extents(backend, jobs, &of_these, &plane.task, &Silent(watch)),
            |_| Extent::NONE,
        )?);
        watch.finished(verdicts.len() as u64);
    }
    Ok(extents)
}
