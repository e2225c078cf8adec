//! The layers of numbers that a page may show instead of motions: those of `map --layer`.

use serde_json::{Value, json};

use super::asked::{Refused, because, refused};
use super::lattice::{Cell, Window};
use super::limits;
use super::scene::Scene;
use super::store::Tiles;
use super::tile::{Cells, Extents};
use crate::analysis::{Extent, Verdict};
use crate::plane::fields::{CellResult, Extras, Layer};
use crate::render::live_bar;
use crate::system::Family;

/// What can be had of a cell here beside its verdict.
const HERE: Extras = Extras { extents: true, ..Extras::NONE };

/// Whether a layer shows how far motions go, which is measured when it is asked for.
pub fn needs_extents(layer: Option<Layer>) -> bool {
    layer.is_some_and(|layer| !layer.is_with(Extras::NONE))
}

/// The layer of a name; none for motions, or where there is no name.
///
/// # Errors
/// The layers that there are.
pub fn named(name: Option<&str>, family: &Family) -> Result<Option<Layer>, Refused> {
    match name {
        None | Some(Layer::MOTION) => Ok(None),
        Some(name) => match Layer::named(name, family).map_err(because)? {
            layer if layer.is_with(HERE) => Ok(Some(layer)),
            _ => Err(refused(format!("the layer {name} is not computed here: use `map --layer {name}`"))),
        },
    }
}

/// The layers of numbers that a family has here, in the order in which pages list them.
fn listed(family: &Family) -> impl Iterator<Item = Layer> {
    Layer::all(family).into_iter().filter(|layer| *layer != Layer::Motion && layer.is_with(HERE))
}

/// By what number a tile says whose numbers it carries: the place of the layer among those that pages list, from 1; 0 for
/// none.
pub fn place(layer: Option<Layer>, family: &Family) -> u32 {
    let at = layer.and_then(|layer| listed(family).position(|other| other == layer));
    at.map_or(0, |at| at as u32 + 1)
}

/// The layers of a family by name, as pages list them.
pub fn layers(family: &Family) -> Value {
    let listed = listed(family).map(|layer| json!({ "name": layer.name(), "title": layer.title() }));
    json!(listed.collect::<Vec<_>>())
}

/// The numbers of a tile's cells, row by row; NaN where there is no such system or it does not begin, and everywhere without a layer.
pub fn numbers(layer: Option<Layer>, cells: &Cells, extents: Option<&Extents>, family: &Family) -> Vec<f32> {
    let Some(layer) = layer else { return vec![f32::NAN; cells.len()] };
    let extent = |at: usize| extents.map(|all| all[at]);
    let there: Vec<(Verdict, Option<Extent>)> =
        cells.iter().enumerate().filter_map(|(at, cell)| Some(((*cell)?, extent(at)))).collect();
    let mut numbers = of_cells(&layer, &there, family).into_iter();
    cells.iter().map(|cell| cell.as_ref().and_then(|_| numbers.next()).unwrap_or(f32::NAN)).collect()
}

fn of_cells(layer: &Layer, cells: &[(Verdict, Option<Extent>)], family: &Family) -> Vec<f32> {
    layer.numbers(
        cells.iter().map(|(verdict, extent)| CellResult {
            verdict,
            place: &verdict.state,
            multipliers: None,
            extent: extent.as_ref(),
        }),
        family,
    )
}

/// The colour bar of what is known of a window, along `length` pixels; null where nothing is.
///
/// # Errors
/// A window that is too large or too far away, and a layer that there is not.
pub fn bar(
    scene: &Scene,
    tiles: &Tiles,
    layer: &str,
    window: &Window,
    length: f64,
    em: f64,
) -> Result<Value, Refused> {
    let sane = (20.0..=20_000.0).contains(&length) && (4.0..=100.0).contains(&em);
    if !sane || !window.is_near() || window.cells() > limits::CURVES_CELLS {
        return Err(refused("this bar cannot be drawn"));
    }
    let family = scene.plane.parameters.family();
    let Some(layer) = named(Some(layer), family)? else { return Ok(Value::Null) };
    let cells = (window.rows[0]..=window.rows[1])
        .flat_map(|j| (window.columns[0]..=window.columns[1]).map(move |i| Cell { z: window.z, i, j }));
    let known: Vec<(Verdict, Option<Extent>)> = cells
        .filter_map(|cell| Some((tiles.cell(scene.id, cell).flatten()?, tiles.extent(scene.id, cell))))
        .collect();
    Ok(json!(live_bar(&layer, &of_cells(&layer, &known, family), length, em)))
}
