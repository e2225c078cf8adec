//! A computed plane as a picture: filled regions inside named axes, with a legend.

mod bands;
mod census;
mod layout;
mod names;
mod picture;
mod raster;
mod sampling;

pub(super) use self::census::Census;
use self::layout::Layout;
pub(super) use self::names::{definition, title};
use super::axes::frame_of;
use super::control::describe;
use super::curves::{Overlay, Shown};
use super::numbers::draw_numbers;
use crate::curves::Curve;
use crate::figure::{Anchor, Canvas, Entry, INK, LeftOut, Picture, Point, Size, Text};
use crate::plane::fields::{Cells, CellsError, Layer};
use crate::plane::{Control, Quantity, RegionMap, Window};

pub use self::picture::{DrawnCurves, PlanePicture};
pub(super) use self::sampling::{means, most};

/// Draws a computed plane.
///
/// Regions are filled with the colours of their motions and parted by thin lines; a line is left out where it
/// would hide a region that is not much wider. The first row of the plane is at the bottom. A picture with
/// fewer pixels than the plane has cells shows the most frequent motion of each pixel. The legend names the
/// motions by descending share of the plane. Small pictures do without the least needed words.
pub fn region_map(map: &RegionMap, size: Size) -> Picture {
    PlanePicture::of(map).draw(size).expect(IN_MEMORY)
}

/// Draws the motions that the cells of a plane reach under control, like [`region_map`].
pub fn control_map(map: &RegionMap<Control>, size: Size) -> Picture {
    let what = What {
        cells: map,
        window: Window::whole(&map.plane),
        title: &control_title(map),
        config: map.config(),
        legend: true,
    };
    draw_motions(&what, None, size).expect(IN_MEMORY)
}

/// The fixed parameters, the start and the method, in pieces that belong together.
pub(super) fn control_title(map: &RegionMap<Control>) -> Vec<Text> {
    let plane = &map.plane;
    let varied = |quantity| [plane.x.quantity, plane.y.quantity].contains(&quantity);
    let mut title = title(plane);
    title.last_mut().into_iter().for_each(|last| *last = last.clone().upright(";"));
    title.extend(describe(&plane.task.scheme, plane.parameters.family(), |setting| {
        varied(Quantity::Control(setting))
    }));
    title
}

/// Draws a computed plane like [`region_map`], with its bifurcation curves over it.
///
/// Lines tell the kinds apart and, by dashes, what is subcritical; points of codimension two are marked, and a key
/// explains both. Curves are named where there is room beside them, by abbreviation and motion or, on the plane of the
/// paper's Fig. 5, as there; so are the regions of that plane. `max_period` is the largest N of the motions whose curves
/// were computed; the picture carries it with the map's configuration.
pub fn region_map_with_curves(
    map: &RegionMap,
    curves: &[Curve],
    shown: Shown,
    max_period: u32,
    size: Size,
) -> Picture {
    let curves = Some(DrawnCurves { map, curves, shown, max_period: Some(max_period) });
    PlanePicture { curves, ..PlanePicture::of(map) }.draw(size).expect(IN_MEMORY)
}

impl PlanePicture<'_> {
    /// Draws it.
    ///
    /// # Errors
    /// What could not be read.
    ///
    /// # Panics
    /// If the window holds no cells.
    pub fn draw(&self, size: Size) -> Result<Picture, CellsError> {
        assert!(self.window.cells() > 0, "a picture shows at least one cell");
        let overlay = self.curves.map(|drawn| Overlay::new(drawn.map, drawn.curves, drawn.shown));
        match self.layer {
            Layer::Motion => draw(self, overlay.as_ref(), size),
            Layer::Number { .. } => draw_numbers(self, overlay.as_ref(), size),
        }
    }
}

/// Why drawing a map does not fail.
const IN_MEMORY: &str = "a map in memory can be read";

/// The motions of a plane, to be drawn.
struct What<'a> {
    cells: &'a dyn Cells,
    window: Window,
    title: &'a [Text],
    config: String,
    legend: bool,
}

/// Draws the motions of a plane.
fn draw(of: &PlanePicture, overlay: Option<&Overlay>, size: Size) -> Result<Picture, CellsError> {
    let what = What {
        cells: of.cells,
        window: of.window,
        title: &of.title(),
        config: of.configuration().to_string(),
        legend: of.legend,
    };
    draw_motions(&what, overlay, size)
}

fn draw_motions(what: &What, overlay: Option<&Overlay>, size: Size) -> Result<Picture, CellsError> {
    let key = overlay.map(Overlay::key).unwrap_or_default();
    let census = Census::of(what.cells, what.window)?;
    let frame = frame_of(&what.window.plane(&what.cells.plane()));
    let em = size.em();
    let layout_of = |size| Layout::of(what.legend, what.title, &census, &frame, &key, size);
    let layout = layout_of(size);
    let extent = [layout.plot.width as u32, layout.plot.height as u32];
    let regions = raster::draw(what.cells, what.window, &census, extent, em)?;

    let mut canvas = Canvas::new(size, &what.config);
    canvas.image(layout.plot, &regions);
    let unnamed = overlay.map_or_else(Vec::new, |overlay| overlay.draw(&mut canvas, layout.plot, &frame, em));
    if let Some(placed) = &layout.frame {
        frame.draw(&mut canvas, placed, em);
    }
    for (row, line) in layout.title.iter().enumerate() {
        let at = Point { x: layout.plot.x, y: layout.margin + (row as f64 + 0.5) * layout::TITLE_ROW * em };
        canvas.text(line, at, Anchor::Start, em, INK);
    }
    if let Some(legend) = &layout.legend {
        legend.legend.draw(&mut canvas, legend.at, legend.width, legend.columns, em);
        let below = [legend.width, f64::from(size.height()) - layout.margin];
        key.draw(&mut canvas, legend.key_at, legend.key_columns, &unnamed, below, em);
    }
    let left_out = (!layout.left_out.is_empty()).then(|| {
        let whole = |size| layout_of(size).left_out.is_empty();
        LeftOut { parts: layout.left_out, enough: size.enough(whole) }
    });
    Ok(Picture::new(size, what.config.clone(), canvas.finish()).without(left_out))
}

/// The rows of the legend of a census, `rows` of them, or one more than is not periodic.
pub(super) fn entries_of(census: &Census, rows: usize) -> Vec<Entry> {
    names::entries(census, rows.max(census.indispensable() + 1), true)
}

#[cfg(test)]
mod tests;
