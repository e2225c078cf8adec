//! A computed plane as a picture: filled regions inside named axes, with a legend.

mod census;
mod layout;
mod names;
mod raster;

use serde_json::json;

use self::census::Census;
use self::layout::Layout;
use super::canvas::{Anchor, Canvas, Point};
use super::colours::INK;
use super::control::describe;
use super::curves::{Overlay, Shown};
use super::frame::Frame;
use super::picture::{LeftOut, Picture};
use super::scale::Scale;
use super::size::Size;
use super::symbols;
use super::text::Text;
use crate::curves::Curve;
use crate::plane::{ControlMap, Plane, Quantity, RegionMap};

/// Draws a computed plane.
///
/// Regions are filled with the colours of their motions and parted by thin lines; a line is left out where it
/// would hide a region that is not much wider. The first row of the plane is at the bottom. A picture with
/// fewer pixels than the plane has cells shows the most frequent motion of each pixel. The legend names the
/// motions by descending share of the plane. Small pictures do without the least needed words.
pub fn region_map(map: &RegionMap, size: Size) -> Picture {
    draw(map, &names::title(&map.plane), map.config(), None, size)
}

/// Draws the motions that the cells of a plane reach under control, like [`region_map`].
pub fn control_map(map: &ControlMap, size: Size) -> Picture {
    draw(&map.motions(), &control_title(map), map.config(), None, size)
}

/// The fixed parameters, the start and the method, in pieces that belong together.
pub(super) fn control_title(map: &ControlMap) -> Vec<Text> {
    let plane = &map.plane;
    let varied = |quantity| [plane.x.quantity, plane.y.quantity].contains(&quantity);
    let mut title = names::title(&plane.plane());
    title.last_mut().into_iter().for_each(|last| *last = last.clone().upright(";"));
    title.extend(describe(&plane.control, plane.parameters.family(), |setting| {
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
    let overlay = Overlay::new(map, curves, shown);
    let config = map.config_with("curves", json!({ "shown": shown.name(), "max_period": max_period }));
    draw(map, &names::title(&map.plane), config, Some(&overlay), size)
}

fn draw(map: &RegionMap, title: &[Text], config: String, overlay: Option<&Overlay>, size: Size) -> Picture {
    let key = overlay.map(Overlay::key).unwrap_or_default();
    let census = Census::of(map);
    let frame = frame(map);
    let em = size.em();
    let layout = Layout::of(title, &census, &frame, &key, size);
    let (width, height) = (layout.plot.width as u32, layout.plot.height as u32);
    let regions = raster::draw(map, &census, width, height, em);

    let mut canvas = Canvas::new(size, &config);
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
        let whole = |size| Layout::of(title, &census, &frame, &key, size).left_out.is_empty();
        LeftOut { parts: layout.left_out, enough: size.enough(whole) }
    });
    Picture::new(size, config, canvas.finish()).without(left_out)
}

fn frame(map: &RegionMap) -> Frame {
    frame_of(&map.plane)
}

/// The axes of a plane.
pub(super) fn frame_of(plane: &Plane) -> Frame {
    Frame {
        x: Scale::of(&plane.x),
        y: Scale::of(&plane.y),
        x_title: symbols::axis_title(plane.x.quantity),
        y_title: symbols::axis_title(plane.y.quantity),
    }
}

#[cfg(test)]
mod tests;
