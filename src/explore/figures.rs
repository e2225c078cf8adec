//! What is drawn of a window: its curves, the diagram along a line through it, and the files that are taken along.

use std::io::Cursor;
use std::panic::{self, AssertUnwindSafe};

use serde_json::json;

use super::asked::{Refused, because, refused};
use super::gather;
use super::lattice::Window;
use super::layer::needs_extents;
use super::limits;
use super::request::Format;
use super::scene::Scene;
use super::store::Tiles;
use super::task::{Ended, Task};
use crate::backend::{BackendError, Watch};
use crate::curves::{Curve, CurvesError, bifurcation_curves_until, check};
use crate::figure::{Picture, Size};
use crate::plane::RegionMap;
use crate::plane::fields::Layer;
use crate::render::{DrawnCurves, PlanePicture, Shown, live_lines};
use crate::store::write_map;
use crate::sweep::{SweepError, measure_extents};

/// Sends the bifurcation curves of a window as lines in cells of level 0.
///
/// # Errors
/// [`Ended`].
pub fn curves(
    scene: &Scene,
    tiles: &Tiles,
    window: &Window,
    max_period: u32,
    all: bool,
    task: &Task,
) -> Result<(), Ended> {
    check(&scene.plane).map_err(because)?;
    let map = gather::map(scene, tiles, window, limits::CURVES_CELLS, false, task)?;
    let found = followed(&map, max_period, task)?;
    let shown = if all { Shown::All } else { Shown::Bounding };
    let (x, y) = (&scene.plane.x, &scene.plane.y);
    let mut lines = live_lines(&map, &found, shown);
    for [a, b] in lines.iter_mut().flat_map(|line| &mut line.points) {
        (*a, *b) = (x.place(*a), y.place(*b));
    }
    task.answer("curves", json!({ "lines": lines, "of": found.len() }));
    Ok(())
}

/// The curves of a map.
fn followed(map: &RegionMap, max_period: u32, task: &Task) -> Result<Vec<Curve>, Ended> {
    check(&map.plane).map_err(because)?;
    if !(1..=limits::CURVES_MAX_PERIOD).contains(&max_period) {
        let most = limits::CURVES_MAX_PERIOD;
        return Err(refused(format!("N up to {max_period} cannot be used: give 1 to {most}")).into());
    }
    let step = task.at("following the bifurcation curves", 0);
    let cancelled = || step.cancelled();
    let found =
        panic::catch_unwind(AssertUnwindSafe(|| bifurcation_curves_until(map, max_period, &cancelled)));
    match found.map_err(|_| refused("internal error: a mistake in the program; please report it"))? {
        Ok(found) => Ok(found.curves),
        Err(CurvesError::Cancelled) => Err(Ended::Cancelled),
        Err(error) => Err(because(error).into()),
    }
}

/// A file that is taken along.
#[derive(Clone, Copy, Debug)]
pub struct Wanted {
    /// Its format.
    pub format: Format,
    /// Pixels of a picture.
    pub size: [u32; 2],
    /// The largest N of the motions whose curves are drawn over it, if any are.
    pub curves: Option<u32>,
    /// What is drawn of every cell, if not its motion.
    pub layer: Option<Layer>,
}

/// Sends a window as a file: with `map`'s own drawing, and its own archive.
///
/// # Errors
/// [`Ended`].
pub fn save(scene: &Scene, tiles: &Tiles, window: &Window, wanted: Wanted, task: &Task) -> Result<(), Ended> {
    let size = figure_size(wanted.size)?;
    let mut map = gather::map(scene, tiles, window, limits::SAVED_CELLS, true, task)?;
    if needs_extents(wanted.layer) {
        let step = task.at("measuring how far motions go", window.cells());
        match measure_extents(&mut map, scene.computing.backend, &step) {
            Ok(()) => {}
            Err(SweepError::Backend(BackendError::Cancelled)) => return Err(Ended::Cancelled),
            Err(error) => return Err(because(error).into()),
        }
    }
    let io = |error: std::io::Error| refused(format!("the file could not be made: {error}"));
    let mut bytes = Vec::new();
    match wanted.format {
        Format::Npz => {
            let mut archive = Cursor::new(Vec::new());
            write_map(&map, &mut archive).map_err(io)?;
            task.file("map.npz", "application/octet-stream", &archive.into_inner());
        }
        Format::Png => {
            drawn(&map, size, &wanted, task)?.write_png(&mut bytes).map_err(io)?;
            task.file("map.png", "image/png", &bytes);
        }
        Format::Svg => {
            drawn(&map, size, &wanted, task)?.write_svg(&mut bytes).map_err(io)?;
            task.file("map.svg", "image/svg+xml", &bytes);
        }
    }
    Ok(())
}

fn drawn(map: &RegionMap, size: Size, wanted: &Wanted, task: &Task) -> Result<Picture, Ended> {
    let found = wanted.curves.map(|max_period| followed(map, max_period, task)).transpose()?;
    let curves = found.as_deref().map(|curves| DrawnCurves {
        map,
        curves,
        shown: Shown::Bounding,
        max_period: wanted.curves,
    });
    let layer = wanted.layer.unwrap_or(Layer::Motion);
    let picture = PlanePicture { curves, layer, ..PlanePicture::of(map) };
    Ok(picture.draw(size).map_err(because)?)
}

/// A size that a page may ask for.
///
/// # Errors
/// [`Refused`] where it is too large or too small.
pub fn figure_size([width, height]: [u32; 2]) -> Result<Size, Refused> {
    if width.max(height) > limits::FIGURE {
        return Err(refused(format!(
            "{width} × {height} pixels are too many: {} a side at most",
            limits::FIGURE
        )));
    }
    Size::new(width, height).map_err(because)
}
