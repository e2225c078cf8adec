//! The layers of numbers that a page may show instead of motions.

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::asked::{Refused, refused};
use super::lattice::{Cell, Window};
use super::limits;
use super::scene::Scene;
use super::store::Tiles;
use super::tile::impacts_per_period;
use crate::analysis::Verdict;
use crate::render::live_bar;

/// A number of every cell, by the name of its field in a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Layer {
    /// The largest Lyapunov exponent.
    Exponent,
    /// N of periodic motions.
    N,
    /// Impacts per forcing period.
    Impacts,
    /// The largest impact velocity.
    Peak,
    /// Forcing periods followed.
    Periods,
}

impl Layer {
    /// Every layer.
    pub const ALL: [Layer; 5] = [Layer::Exponent, Layer::N, Layer::Impacts, Layer::Peak, Layer::Periods];

    /// What the numbers are.
    pub fn title(self) -> &'static str {
        match self {
            Layer::Exponent => "largest Lyapunov exponent per forcing period",
            Layer::N => "N, forcing periods in one period of the motion",
            Layer::Impacts => "impacts per forcing period",
            Layer::Peak => "largest impact velocity",
            Layer::Periods => "forcing periods followed",
        }
    }

    /// Whether equal ratios suit it.
    fn is_log(self) -> bool {
        matches!(self, Layer::N | Layer::Impacts | Layer::Periods)
    }

    fn of(self, verdict: &Verdict) -> f32 {
        match self {
            Layer::Exponent => verdict.lyapunov,
            Layer::N if verdict.n == 0 => f32::NAN,
            Layer::N => f32::from(verdict.n),
            Layer::Impacts => impacts_per_period(verdict),
            Layer::Peak => verdict.peak_impact_velocity,
            Layer::Periods => verdict.periods as f32,
        }
    }
}

/// The layers by name, as pages list them.
pub fn layers() -> Value {
    json!(Layer::ALL.map(|layer| json!({ "name": layer, "title": layer.title() })))
}

/// The colour bar of what is known of a window, along `length` pixels; null where nothing is.
///
/// # Errors
/// A window that is too large or too far away.
pub fn bar(
    scene: &Scene,
    tiles: &Tiles,
    layer: Layer,
    window: &Window,
    length: f64,
    em: f64,
) -> Result<Value, Refused> {
    let sane = (20.0..=20_000.0).contains(&length) && (4.0..=100.0).contains(&em);
    if !sane || !window.is_near() || window.cells() > limits::CURVES_CELLS {
        return Err(refused("this bar cannot be drawn"));
    }
    let cells = (window.rows[0]..=window.rows[1])
        .flat_map(|j| (window.columns[0]..=window.columns[1]).map(move |i| Cell { z: window.z, i, j }));
    let known = cells.filter_map(|cell| tiles.cell(scene.id, cell).flatten());
    Ok(json!(live_bar(layer.title(), known.map(|verdict| layer.of(&verdict)), layer.is_log(), length, em)))
}
