//! The cells of a window as a map: known ones are taken, the others computed.

use super::asked::{because, refused};
use super::batch::{Stopped, verdicts};
use super::lattice::{Cell, Window};
use super::scene::Scene;
use super::store::Tiles;
use super::task::{Ended, Task};
use crate::analysis::Verdict;
use crate::plane::{Plane, RegionMap};
use crate::sweep::provenance;

/// The map of a window of at most so many cells.
///
/// An axis computes its values anew from its ends, which rounding may change: a cell that is known is taken only where
/// both of its values are the same to the bit, so that the map is what `map` computes of its plane. `exactly` is false
/// where that does not matter, as for where curves begin.
///
/// # Errors
/// [`Ended`], also for a window that is too large, leaves the range of a parameter, or has a cell without a system.
pub fn map(
    scene: &Scene,
    tiles: &Tiles,
    window: &Window,
    most: u64,
    exactly: bool,
    task: &Task,
) -> Result<RegionMap, Ended> {
    if !window.is_near() || window.cells() > most {
        let [columns, rows] = window.size();
        return Err(refused(format!("{columns} × {rows} cells are too many: at most {most}")).into());
    }
    let plane = window.plane(&scene.plane).map_err(because)?;
    plane.check_ranges().map_err(because)?;
    let cells: Vec<Cell> = (window.rows[0]..=window.rows[1])
        .flat_map(|j| (window.columns[0]..=window.columns[1]).map(move |i| Cell { z: window.z, i, j }))
        .collect();
    let same = same(scene, &plane, window);
    let columns = plane.x.count as usize;
    let known = |at: usize, cell: Cell| -> Option<Verdict> {
        let fits = !exactly || same[0][at % columns] && same[1][at / columns];
        fits.then(|| scene.known(cell).or_else(|| tiles.cell(scene.id, cell).flatten())).flatten()
    };
    let mut found: Vec<Option<Verdict>> = Vec::with_capacity(cells.len());
    for some in cells.chunks(1 << 16) {
        scene.prepare(some.iter().copied()).map_err(refused)?;
        let first = found.len();
        found.extend(some.iter().enumerate().map(|(at, &cell)| known(first + at, cell)));
    }
    let open: Vec<usize> = (0..found.len()).filter(|&at| found[at].is_none()).collect();
    let step = task.at("computing cells", open.len() as u64);
    let asked = Scene::new(scene.id, plane.clone(), scene.computing, None);
    for some in open.chunks(scene.computing.backend.tile().clamp(1, 1 << 12)) {
        // The window's plane has its own cells of level 0.
        let own = |&at: &usize| Cell { z: 0, i: (at % columns) as i64, j: (at / columns) as i64 };
        let fresh = verdicts(&asked, &some.iter().map(own).collect::<Vec<_>>(), &step)?;
        for (&at, verdict) in some.iter().zip(fresh) {
            found[at] = verdict;
        }
    }
    let verdicts: Option<Vec<Verdict>> = found.into_iter().collect();
    let nowhere = || Stopped::Failed("a part of the window has no such system: move it off the edge".into());
    let verdicts = verdicts.ok_or_else(nowhere)?;
    Ok(RegionMap::new(plane, provenance(scene.computing.backend), verdicts))
}

/// For each column and each row, whether the window's plane has the very value of the lattice there.
fn same(scene: &Scene, plane: &Plane, window: &Window) -> [Vec<bool>; 2] {
    let columns = (0..plane.x.count).zip(window.columns[0]..);
    let rows = (0..plane.y.count).zip(window.rows[0]..);
    let at = |i: i64, j: i64| scene.values(Cell { z: window.z, i, j });
    [
        columns.map(|(k, i)| plane.x.value(k) == at(i, 0)[0]).collect(),
        rows.map(|(k, j)| plane.y.value(k) == at(0, j)[1]).collect(),
    ]
}
