//! `impact-atlas map --data plane.zarr`: a plane computed into a store, whole or in part.

use std::path::Path;
use std::time::Instant;

use anyhow::anyhow;
use impact_atlas::plane::fields::Extras;
use impact_atlas::plane::{Part, Plane, Window};
use impact_atlas::store::{Failure, Wanted, ZarrStore};
use impact_atlas::sweep::{check, provenance, sweep_stored};
use serde::Serialize;

use super::drawing::{CurveSource, DrawingArgs};
use super::files::{self, Batch, Kind};
use super::map_args::MapArgs;
use super::options::BackendArgs;
use super::progress::Progress;
use super::terminal::{print, print_json};
use super::{CliError, Result, curve_table, estimate, note, wrong};

/// What is printed.
#[derive(Debug, Serialize)]
struct Summary<'a> {
    cells: u64,
    impacts: u64,
    seconds: f64,
    impacts_per_second: f64,
    /// The part that was computed, K/M.
    part: String,
    /// Tiles of the part that were there before.
    tiles_there: u32,
    /// Tiles computed now.
    tiles_computed: u32,
    /// Tiles that failed twice.
    tiles_failed: &'a [Failure],
    /// Tiles of the whole plane that are missing.
    tiles_missing: u32,
    backend: &'a str,
    adapter: &'a str,
}

/// Runs the command.
pub fn run(args: &MapArgs, plane: &Plane, path: &Path, options: &BackendArgs, extras: Extras) -> Result<()> {
    let part = args.part.unwrap_or(Part::WHOLE);
    if args.part.is_some() && (args.out.is_some() || args.curves.is_some()) {
        return Err(wrong!(
            "--part {part} computes a part of the plane and draws nothing: drop --out and --curves, and use `render` once \
             all parts are there"
        ));
    }
    if args.curves.is_some() && args.out.is_none() {
        return Err(wrong!(
            "--curves draws over a picture, and beside a store there is none unless it is asked for: name one with --out"
        ));
    }
    // A layer may ask for what the store is to hold.
    let unseen = args.drawing.given().find(|&option| option != DrawingArgs::LAYER || !extras.extents);
    if let (None, Some(option)) = (&args.out, unseen) {
        return Err(wrong!(
            "--{option} has no effect beside a store, of which nothing is drawn unless it is asked for: drop it, or name a picture \
             with --out"
        ));
    }
    let wanted = [Kind::Picture.at(args.out.as_deref()), Kind::Table.at(args.curves_out.as_deref())];
    let [picture, table] = files::prepare(args.overwrite, wanted)?;
    // Before there is a store; one that is there was checked before it was made.
    if !path.exists() {
        check(plane)?;
    }
    let backend = options.open()?;
    let (name, adapter) = (backend.name(), backend.adapter());
    let provenance = provenance(&*backend);
    let asked = Wanted { plane, provenance: &provenance, extras, tile: args.tile };
    let store = ZarrStore::of(path, &asked)?;
    let tiles = part.tiles(plane, &store.tiling());
    let cells: u64 = tiles.iter().map(|&tile| store.tiling().window(tile).cells() as u64).sum();
    if tiles.is_empty() {
        note(&format!("part {part} has no tile: the plane has {} of them", store.tiling().count()));
    }
    if args.part.is_none() && store.tiles_there()?.iter().all(|there| !there) {
        estimate::of_plane("the map", plane, &*backend)?;
    }
    let began = Instant::now();
    let run = {
        let progress = Progress::of_cells("computing", cells);
        sweep_stored(&store, &tiles, backend, &|| options.reopen(), &progress)?
    };
    let seconds = began.elapsed().as_secs_f64();
    let missing = store.tiles_there()?.iter().filter(|there| !*there).count() as u32;
    let summary = Summary {
        cells: run.cells,
        impacts: run.impacts,
        seconds,
        impacts_per_second: run.impacts as f64 / seconds,
        part: part.to_string(),
        tiles_there: run.there,
        tiles_computed: run.computed,
        tiles_failed: &run.failed,
        tiles_missing: missing,
        backend: name,
        adapter: &adapter,
    };
    if missing == 0 && args.out.is_some() {
        let source = args.curves.map(CurveSource::Computed);
        let (drawn, curves) = args.drawing.draw(&store, Window::whole(plane), source)?;
        let mut batch = Batch::default();
        batch.picture(&picture, &drawn)?;
        curve_table::add(&mut batch, &table, &curves, plane)?;
        batch.show()?;
    }
    if args.json { print_json(&summary) } else { print(&summary.text(path)) }?;
    match run.failed.first() {
        None => Ok(()),
        Some(Failure { tile, message }) => Err(CliError::Machine(anyhow!(
            "{} of {} tiles failed twice and are missing (tile {tile}: {message}); the same command tries them again",
            run.failed.len(),
            tiles.len()
        ))),
    }
}

impl Summary<'_> {
    fn text(&self, path: &Path) -> String {
        let mut lines = match self.tiles_computed {
            0 => vec!["nothing was computed".to_owned()],
            _ => vec![format!(
                "{} cells and {} impacts in {:.2} s, {:.3e} impacts/s",
                self.cells, self.impacts, self.seconds, self.impacts_per_second
            )],
        };
        let part = if self.part == "1/1" { String::new() } else { format!(" of part {}", self.part) };
        lines.push(format!(
            "tiles{part}: {} computed, {} there before, {} failed; of the plane {} missing in {}",
            self.tiles_computed,
            self.tiles_there,
            self.tiles_failed.len(),
            self.tiles_missing,
            path.display()
        ));
        lines.join("\n")
    }
}
