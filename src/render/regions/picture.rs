//! What of a plane is drawn, and how.

use serde_json::{Value, json};

use super::super::curves::Shown;
use super::names;
use crate::curves::Curve;
use crate::figure::{Palette, Text};
use crate::plane::fields::{Cells, Layer};
use crate::plane::{Plane, RegionMap, Window};

/// Curves that are drawn over a plane.
#[derive(Clone, Copy, Debug)]
pub struct DrawnCurves<'a> {
    /// The part of the plane that is drawn, or cells of it in equal steps: what is worth drawing is read from them.
    pub map: &'a RegionMap,
    /// The curves.
    pub curves: &'a [Curve],
    /// Which parts of them.
    pub shown: Shown,
    /// The largest N of the motions whose curves were computed, if that is known.
    pub max_period: Option<u32>,
}

/// A picture of a plane, of which the cells are read from a map, an archive or a store.
#[derive(Clone)]
pub struct PlanePicture<'a> {
    /// The cells.
    pub cells: &'a dyn Cells,
    /// The part of the plane that is drawn.
    pub window: Window,
    /// What is drawn of every cell.
    pub layer: Layer,
    /// Curves over it.
    pub curves: Option<DrawnCurves<'a>>,
    /// What stands above it in place of the parameters and the start.
    pub title: Option<String>,
    /// The colours of numbers, in place of those that suit them.
    pub palette: Option<Palette>,
    /// The ends of the colour bar, in place of those of the numbers.
    pub range: Option<[f64; 2]>,
    /// Whether it has a legend, or a colour bar.
    pub legend: bool,
}

impl<'a> PlanePicture<'a> {
    /// The motions of a whole plane.
    pub fn of(cells: &'a dyn Cells) -> Self {
        PlanePicture {
            cells,
            window: Window::whole(&cells.plane()),
            layer: Layer::Motion,
            curves: None,
            title: None,
            palette: None,
            range: None,
            legend: true,
        }
    }

    /// The plane of the cells that are drawn.
    pub(in crate::render) fn plane(&self) -> Plane<()> {
        self.window.plane(&self.cells.plane())
    }

    /// What stands above it, in pieces that belong together.
    pub(in crate::render) fn title(&self) -> Vec<Text> {
        match &self.title {
            Some(title) => title.split_whitespace().map(Text::from).collect(),
            None => names::title(&self.cells.plane()),
        }
    }

    /// What it takes to make it again: the configuration of the cells, and what is not as usual in the picture.
    pub(in crate::render) fn configuration(&self) -> Value {
        let mut configuration = self.cells.configuration();
        if let Some(DrawnCurves { shown, max_period, .. }) = self.curves {
            configuration["curves"] = json!({ "shown": shown.name(), "max_period": max_period });
        }
        let mut picture = json!({});
        if self.layer != Layer::Motion {
            picture["layer"] = self.layer.name().into();
        }
        if self.window != Window::whole(&self.cells.plane()) {
            let plane = self.plane();
            picture["x"] = json!([plane.x.first, plane.x.last]);
            picture["y"] = json!([plane.y.first, plane.y.last]);
        }
        if let Some(title) = &self.title {
            picture["title"] = title.as_str().into();
        }
        if let Some(palette) = self.palette {
            picture["palette"] = palette.name().into();
        }
        if let Some(range) = self.range {
            picture["range"] = json!(range);
        }
        if !self.legend {
            picture["legend"] = false.into();
        }
        if picture != json!({}) {
            configuration["picture"] = picture;
        }
        configuration
    }
}
