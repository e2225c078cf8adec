//! The layers of numbers that a page may show instead of motions: those of `map --layer`.

use serde_json::{Value, json};

use super::asked::{Refused, because, refused};
use super::lattice::{Cell, Window};
use super::limits;
use super::scene::Scene;
use super::store::Tiles;
use super::tile::Cells;
use crate::analysis::Verdict;
use crate::plane::fields::{CellResult, Extras, Layer};
use crate::render::live_bar;
use crate::system::Family;

/// The layer of a name; none for motions, or where there is no name.
///
/// # Errors
/// The layers that there are.
pub fn named(name: Option<&str>, family: &Family) -> Result<Option<Layer>, Refused> {
    match name {
        None | Some(Layer::MOTION) => Ok(None),
        Some(name) => match Layer::named(name, family).map_err(because)? {
            layer if layer.is_with(Extras::NONE) => Ok(Some(layer)),
            _ => Err(refused(format!("the layer {name} is not computed here: use `map --layer {name}`"))),
        },
    }
}

/// The layers of a family by name, as pages list them.
pub fn layers(family: &Family) -> Value {
    let here = Layer::all(family).into_iter().filter(|layer| layer.is_with(Extras::NONE));
    let listed = here.filter_map(|layer| match layer {
        Layer::Motion => None,
        Layer::Number { field, coordinate, .. } => {
            let of = coordinate.map(|x| format!(" of {}", x.name())).unwrap_or_default();
            Some(json!({ "name": layer.name(), "title": format!("{}{of}", field.title) }))
        }
    });
    json!(listed.collect::<Vec<_>>())
}

/// The numbers of a tile's cells, row by row; NaN where there is no such system, and everywhere without a layer.
pub fn numbers(layer: Option<Layer>, cells: &Cells, family: &Family) -> Vec<f32> {
    let Some(layer) = layer else { return vec![f32::NAN; cells.len()] };
    let there: Vec<Verdict> = cells.iter().flatten().copied().collect();
    let mut numbers = of_verdicts(&layer, &there, family).into_iter();
    cells.iter().map(|cell| cell.as_ref().and_then(|_| numbers.next()).unwrap_or(f32::NAN)).collect()
}

fn of_verdicts(layer: &Layer, verdicts: &[Verdict], family: &Family) -> Vec<f32> {
    layer.numbers(
        verdicts.iter().map(|verdict| CellResult { verdict, multipliers: None, extent: None }),
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
    let known: Vec<Verdict> = cells.filter_map(|cell| tiles.cell(scene.id, cell).flatten()).collect();
    Ok(json!(live_bar(&layer, &of_verdicts(&layer, &known, family), length, em)))
}
