//! A few tiles at once: what is known is taken, the rest computed on the scene's back end.

use std::panic::{self, AssertUnwindSafe};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::lattice::{Cell, SIDE, TileKey};
use super::layer::{needs_extents, numbers, place};
use super::outbox::Page;
use super::reply::Outgoing;
use super::scene::Scene;
use super::store::Tiles;
use super::tile::{Cells, Extents, encoded};
use crate::analysis::{Extent, Verdict};
use crate::backend::{self, BackendError, Job, Watch, decide};
use crate::plane::Reached as _;
use crate::plane::fields::Layer;
use crate::sweep::{Begun, of_begun};

/// Jobs that a processor's thread takes at a time.
const FEW: usize = 128;

/// Some tiles of a plane.
#[derive(Debug)]
pub struct Batch<'a> {
    /// The plane.
    pub scene: &'a Scene,
    /// Where tiles are kept.
    pub tiles: &'a Tiles,
    /// The tiles to compute, by their keys.
    pub keys: &'a [TileKey],
    /// What is shown of them, if not their motions.
    pub layer: Option<Layer>,
    /// Whether the request was cancelled.
    pub cancelled: &'a AtomicBool,
}

/// Tiles that are done.
#[derive(Debug)]
pub struct Done {
    tiles: Vec<Tile>,
    /// How many of them were computed; the others were known.
    pub computed: usize,
}

#[derive(Debug)]
struct Tile {
    key: TileKey,
    cells: Arc<Cells>,
    /// How far its motions go, where the layer that is shown asks for it.
    extents: Option<Arc<Extents>>,
}

/// Why there are no tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// The request was cancelled.
    Cancelled,
    /// The back end, or the program, could not.
    Failed(String),
}

/// Says when a flag is up.
#[derive(Debug)]
pub struct Flag<'a>(pub &'a AtomicBool);

impl Watch for Flag<'_> {
    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What some cells settle on, computed on a back end; a cell without a system has none.
///
/// # Errors
/// [`Stopped`], also where the program has a mistake.
pub fn verdicts(scene: &Scene, cells: &[Cell], watch: &dyn Watch) -> Result<Vec<Option<Verdict>>, Stopped> {
    let begun: Vec<Option<Begun>> = cells.par_iter().map(|&cell| scene.job(cell)).collect();
    let there: Vec<bool> = begun.iter().map(Option::is_some).collect();
    let decided = |jobs: &[Job]| caught(|| decided(scene, jobs, watch));
    let found = of_begun(begun.into_iter().flatten().collect(), decided, Verdict::inadmissible)?;
    let mut found = found.into_iter();
    Ok(there.into_iter().map(|is_there| if is_there { found.next() } else { None }).collect())
}

/// What a back end computes; a mistake in the program ends no more than this.
fn caught<T>(work: impl FnOnce() -> Result<T, BackendError>) -> Result<T, Stopped> {
    match panic::catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(done)) => Ok(done),
        Ok(Err(BackendError::Cancelled)) => Err(Stopped::Cancelled),
        Ok(Err(error)) => Err(Stopped::Failed(error.to_string())),
        Err(_) => Err(Stopped::Failed("internal error: a mistake in the program; please report it".into())),
    }
}

/// The verdicts on some jobs. A processor takes a few at a time, so that none waits for the slowest of all to be looked at
/// once more; an adapter takes all at once.
fn decided(scene: &Scene, jobs: &[Job], watch: &dyn Watch) -> Result<Vec<Verdict>, BackendError> {
    let backend = scene.computing.backend;
    let decide = |jobs: &[Job]| decide(backend, jobs, &scene.plane.task, watch);
    match backend.name() {
        "cpu" => Ok(jobs.par_chunks(FEW).map(decide).collect::<Result<Vec<_>, _>>()?.concat()),
        _ => decide(jobs),
    }
}

/// Computes the tiles that are not there yet.
///
/// # Errors
/// [`Stopped`].
pub fn compute(batch: &Batch<'_>) -> Result<Done, Stopped> {
    let Batch { scene, tiles, keys, layer, cancelled } = *batch;
    let kept: Vec<Option<Arc<Cells>>> = keys.iter().map(|&key| tiles.get(scene.id, key)).collect();
    let unknown = || keys.iter().zip(&kept).filter(|(_, kept)| kept.is_none()).map(|(key, _)| *key);
    scene.prepare(unknown().flat_map(cells)).map_err(Stopped::Failed)?;
    let mut found: Vec<(usize, Vec<Option<Option<Verdict>>>)> = Vec::new();
    let mut open: Vec<Cell> = Vec::new();
    for (at, &key) in keys.iter().enumerate().filter(|(at, _)| kept[*at].is_none()) {
        let cells: Vec<Option<Option<Verdict>>> = (cells(key))
            .map(|cell| {
                let coarser = cell.coarser().and_then(|coarser| tiles.cell(scene.id, coarser));
                let known = scene.known(cell).map(Some).or(coarser);
                if known.is_none() {
                    open.push(cell);
                }
                known
            })
            .collect();
        found.push((at, cells));
    }
    let mut fresh = verdicts(scene, &open, &Flag(cancelled))?.into_iter();
    let mut done = Done { tiles: Vec::with_capacity(keys.len()), computed: found.len() };
    let mut found = found.into_iter().peekable();
    for (at, &key) in keys.iter().enumerate() {
        let cells = match (&kept[at], found.next_if(|(open, _)| *open == at)) {
            (Some(cells), _) => cells.clone(),
            (None, Some((_, cells))) => {
                let all: Cells =
                    cells.into_iter().map(|known| known.unwrap_or_else(|| fresh.next().flatten())).collect();
                let all = Arc::new(all);
                tiles.put(scene.id, key, all.clone());
                all
            }
            (None, None) => continue,
        };
        done.tiles.push(Tile { key, cells, extents: None });
    }
    if needs_extents(layer) {
        for tile in &mut done.tiles {
            tile.extents = Some(measured(batch, tile.key, &tile.cells)?);
        }
    }
    Ok(done)
}

/// How far the motions of a tile go: as it is known, or measured now and kept.
fn measured(batch: &Batch<'_>, key: TileKey, verdicts: &Cells) -> Result<Arc<Extents>, Stopped> {
    let Batch { scene, tiles, cancelled, .. } = *batch;
    if let Some(extents) = tiles.extents(scene.id, key) {
        return Ok(extents);
    }
    let there: Vec<(usize, Job, Verdict)> = cells(key)
        .zip(verdicts)
        .enumerate()
        .filter_map(|(at, (cell, verdict))| Some((at, scene.job(cell)?.ok()?, (*verdict)?)))
        .collect();
    let (jobs, found): (Vec<Job>, Vec<Verdict>) =
        there.iter().map(|(_, job, verdict)| (job.clone(), *verdict)).unzip();
    let schedule = &scene.plane.task;
    let watch = Flag(cancelled);
    let measured = caught(|| backend::extents(scene.computing.backend, &jobs, &found, schedule, &watch))?;
    let mut extents = vec![Extent::NONE; verdicts.len()];
    for ((at, ..), extent) in there.into_iter().zip(measured) {
        extents[at] = extent;
    }
    let extents = Arc::new(extents);
    tiles.put_extents(scene.id, key, extents.clone());
    Ok(extents)
}

/// The cells of a tile, row by row.
fn cells(key: TileKey) -> impl Iterator<Item = Cell> {
    (0..SIDE).flat_map(move |row| (0..SIDE).map(move |column| key.cell(column, row)))
}

/// Sends tiles to a page, and before them the motions that it was not `told` of.
pub fn send(scene: &Scene, done: &Done, layer: Option<Layer>, page: &Page, told: Option<&mut usize>) {
    let family = scene.plane.parameters.family();
    // The layer may be another than when the tiles were begun: then they are asked for once more.
    let shown = || done.tiles.iter().filter(|tile| tile.extents.is_some() || !needs_extents(layer));
    let numbered: Vec<Vec<u16>> = shown().map(|tile| scene.numbered(&tile.cells)).collect();
    if let Some(told) = told {
        let motions = scene.motions_from(*told);
        if !motions.is_empty() {
            let _ = page.send(Outgoing::motions(scene.id, *told, &motions, scene.plane.has_mirror()));
            *told += motions.len();
        }
    }
    let place = place(layer, family);
    for (Tile { key, cells, extents }, motions) in shown().zip(&numbered) {
        let numbers = numbers(layer, cells, extents.as_deref(), family);
        let _ = page.send(Outgoing::Bytes(encoded(scene.id, *key, cells, motions, (place, &numbers))));
    }
}
