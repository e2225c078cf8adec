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
use super::picture::Picture;
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
    title.extend(describe(&plane.control, |setting| varied(Quantity::Control(setting))));
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
    if let Some(overlay) = overlay {
        overlay.draw(&mut canvas, layout.plot, &frame, em);
    }
    if let Some(placed) = &layout.frame {
        frame.draw(&mut canvas, placed, em);
    }
    for (row, line) in layout.title.iter().enumerate() {
        let at = Point { x: layout.plot.x, y: layout.margin + (row as f64 + 0.5) * layout::TITLE_ROW * em };
        canvas.text(line, at, Anchor::Start, em, INK);
    }
    if let Some(legend) = &layout.legend {
        legend.legend.draw(&mut canvas, legend.at, legend.width, legend.columns, em);
        key.draw(&mut canvas, legend.key_at, legend.key_columns, em);
    }
    Picture::new(size, config, canvas.finish())
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
mod tests {
    use resvg::tiny_skia::Rect;
    use resvg::usvg::{Group, Node, Options, Tree};

    use super::*;
    use crate::analysis::Regime;
    use crate::plane::Start;
    use crate::render::curves::Key;
    use crate::render::{example, font};

    const SIZES: [(u32, u32); 12] = [
        (16, 16),
        (64, 48),
        (200, 150),
        (320, 240),
        (400, 300),
        (640, 480),
        (1200, 900),
        (1920, 600),
        (600, 2000),
        (500, 700),
        (700, 700),
        (3000, 400),
    ];

    /// Planes that strain the layout: many regions, one region, one cell, long labels, long titles.
    fn strained() -> Vec<RegionMap> {
        let one = example::verdict(Regime::Periodic, [1, 1, 1], true);
        let mut long = example::map(40, 30);
        long.plane.x = "x2=-1e-7:3e-7:40".parse().unwrap();
        long.plane.y = "v1=1000.00001:1000.00002:30".parse().unwrap();
        long.plane.parameters.zeta = 1.0 / 3.0;
        long.plane.parameters.mu_k = 2.0 / 3.0;
        long.plane.parameters.mu_c = 1.0 / 7.0;
        long.plane.start = Start::State([-1.0 / 30.0, 0.0, 0.0, -2.0 / 3.0]);
        let mut single = example::of(2, 2, |_, _| one);
        single.verdicts.truncate(1);
        single.plane.x = "omega=3.7:3.7:1".parse().unwrap();
        single.plane.y = "x2=-0.123456789:-0.123456789:1".parse().unwrap();
        vec![example::map(80, 60), example::of(50, 2, |_, _| one), single, long]
    }

    fn texts(group: &Group, found: &mut Vec<Rect>) {
        for node in group.children() {
            match node {
                Node::Group(inner) => texts(inner, found),
                Node::Text(text) => found.push(text.abs_bounding_box()),
                _ => {}
            }
        }
    }

    #[test]
    fn words_are_inside_the_picture_and_apart() {
        for map in strained() {
            for (width, height) in SIZES {
                let size = Size::new(width, height).unwrap();
                assert_apart(&map, &region_map(&map, size), size);
                if map.plane.x.count > 2 {
                    let curves = example::curves(&map);
                    assert_apart(&map, &region_map_with_curves(&map, &curves, Shown::All, 2, size), size);
                }
            }
        }
    }

    fn assert_apart(map: &RegionMap, picture: &Picture, size: Size) {
        let options = Options { fontdb: font::database(), font_family: "Inter".into(), ..Options::default() };
        let (width, height) = (size.width(), size.height());
        let tree = Tree::from_str(picture.svg(), &options).unwrap();
        let mut words = Vec::new();
        texts(tree.root(), &mut words);
        let plane = format!("{} × {}, {width} × {height}", map.plane.x, map.plane.y);
        assert!(!words.is_empty() || width < 200, "{plane}");
        for (i, word) in words.iter().enumerate() {
            let inside = word.left() >= 0.0
                && word.top() >= 0.0
                && word.right() <= width as f32
                && word.bottom() <= height as f32;
            assert!(inside, "{plane}: {word:?} is clipped");
            let other = words[..i].iter().find(|other| other.intersect(word).is_some());
            assert!(other.is_none(), "{plane}: {word:?} overlaps {other:?}");
        }
    }

    #[test]
    fn curves_are_named_and_explained() {
        let map = example::map(80, 60);
        let curves = example::curves(&map);
        let size = Size::new(1200, 900).unwrap();
        let said = |picture: &Picture, words: &str| picture.svg().contains(&format!(">{words}<"));
        let bare = region_map(&map, size);
        let bounding = region_map_with_curves(&map, &curves, Shown::Bounding, 2, size);
        let all = region_map_with_curves(&map, &curves, Shown::All, 2, size);
        for words in
            ["L1", "L2", "L3", "F 1-1-1", "R1", "Neimark–Sacker (NS)", "subcritical", "codimension two"]
        {
            assert!(said(&bounding, words) && said(&all, words) && !said(&bare, words), "{words}");
        }
        for words in ["grazing (G)", "G 1-3-3"] {
            assert!(!said(&bounding, words) && said(&all, words), "{words} does not bound anything");
        }
        let mut other = map;
        other.plane.parameters.r = 0.7;
        let numbered = region_map_with_curves(&other, &curves, Shown::Bounding, 2, size);
        assert!(said(&numbered, "PF 1-1-1") && !said(&numbered, "L3") && !said(&numbered, "R1"));
        assert!(said(&numbered, "NS 1-1-1"));
    }

    #[test]
    fn dashes_tell_what_is_subcritical() {
        let map = example::map(80, 60);
        let curves = example::curves(&map);
        let size = Size::new(1200, 900).unwrap();
        let dashed = |curves: &[Curve]| {
            let picture = region_map_with_curves(&map, curves, Shown::Bounding, 2, size);
            picture.svg().matches("stroke-dasharray").count()
        };
        // The Neimark–Sacker curve is first: one dashed part of it, and the key's sample.
        assert_eq!((dashed(&curves[..1]), dashed(&curves[1..2])), (2, 0));
    }

    #[test]
    fn the_plot_is_shown_pixel_by_pixel() {
        let map = example::map(80, 60);
        for (width, height) in [(200, 150), (640, 480)] {
            let size = Size::new(width, height).unwrap();
            let census = Census::of(&map);
            let plot =
                Layout::of(&names::title(&map.plane), &census, &frame(&map), &Key::default(), size).plot;
            let [x, y, width, height] = [plot.x, plot.y, plot.width, plot.height].map(|length| length as u32);
            let expected = raster::draw(&map, &census, width, height, size.em());
            let pixels = region_map(&map, size).pixels();
            let shown = image::imageops::crop_imm(&pixels, x, y, width, height).to_image();
            assert!(shown == expected, "{width} × {height}");
        }
    }

    #[test]
    fn a_picture_of_usual_size_says_everything() {
        let map = example::map(80, 60);
        let picture = region_map(&map, Size::new(1200, 900).unwrap());
        for words in ["half clearance <", "forcing periods,", "1-1-1 symmetric", "chaotic", " %<"] {
            assert!(picture.svg().contains(words), "{words}");
        }
        let escaped = map.config().replace('"', "&quot;");
        assert!(picture.svg().contains(&escaped) || picture.svg().contains(&map.config()));
    }
}
