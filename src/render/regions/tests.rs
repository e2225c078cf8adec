//! Structure of pictures of planes: every word inside the picture and apart from the others, and what they say.

use resvg::tiny_skia::Rect;
use resvg::usvg::{Group, Node, Options, Tree};

use super::*;
use crate::analysis::{Regime, Verdict};
use crate::figure::{carried_configuration, database};
use crate::plane::Start;
use crate::render::curves::Key;
use crate::render::example;

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
    let one = Verdict::of_motion(Regime::Periodic, [1, 1, 1], true);
    let mut long = example::map(40, 30);
    long.plane.x = "x2=-1e-7:3e-7:40".parse().unwrap();
    long.plane.y = "v1=1000.00001:1000.00002:30".parse().unwrap();
    let strange = [("zeta", 1.0 / 3.0), ("mu_k", 2.0 / 3.0), ("mu_c", 1.0 / 7.0)];
    long.plane.parameters = strange
        .into_iter()
        .fold(long.plane.parameters, |setting, (name, value)| setting.with_named(name, value));
    long.plane.start = Start::State([-1.0 / 30.0, 0.0, 0.0, -2.0 / 3.0].into());
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
    let options = Options { fontdb: database(), font_family: "Inter".into(), ..Options::default() };
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
    for words in [
        "L1",
        "L2",
        "L3",
        "F 1-1-1",
        "R1",
        "Neimark–Sacker (NS)",
        "subcritical",
        "codimension two, one or several",
    ] {
        assert!(said(&bounding, words) && said(&all, words) && !said(&bare, words), "{words}");
    }
    for words in ["grazing (G)", "G 1-3-3"] {
        assert!(!said(&bounding, words) && said(&all, words), "{words} does not bound anything");
    }
    let mut other = map;
    other.plane.parameters = other.plane.parameters.with_named("r", 0.7);
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
fn a_small_picture_says_what_it_leaves_out_and_which_size_is_enough() {
    let map = example::map(80, 60);
    let curves = example::curves(&map);
    for (width, height) in SIZES {
        let size = Size::new(width, height).unwrap();
        let picture = region_map(&map, size);
        let Some(left_out) = picture.left_out() else {
            assert!(picture.svg().contains(">chaotic<"), "{width} × {height}");
            continue;
        };
        assert_eq!(left_out.parts[0], "the legend", "{width} × {height}");
        assert!(!picture.svg().contains(">chaotic<"), "{width} × {height}");
        let enough = left_out.enough.unwrap();
        assert!(left_out.to_string().contains(&format!("{}x{} is enough", enough.width(), enough.height())));
        let whole = region_map(&map, enough);
        assert!(whole.left_out().is_none() && whole.svg().contains(">chaotic<"));
        let with_curves = region_map_with_curves(&map, &curves, Shown::All, 2, size);
        assert!(with_curves.left_out().is_some());
    }
    assert!(region_map(&map, Size::new(300, 200).unwrap()).left_out().is_some());
    assert!(region_map(&map, Size::new(1200, 900).unwrap()).left_out().is_none());
}

#[test]
fn nothing_else_is_given_up_for_a_title_that_is_too_long() {
    let map = example::map(80, 60);
    let long: Vec<Text> = (0..60).map(|k| Text::from(format!("stiffness{k} = 0.123456789,"))).collect();
    let size = Size::new(1200, 900).unwrap();
    let (census, frame) = (Census::of(&map, Window::whole(&map.plane)).unwrap(), frame_of(&map.plane));
    let layout = |title: &[Text]| Layout::of(true, title, &census, &frame, &Key::default(), size);
    let without = layout(&long);
    assert!(without.legend.is_some() && without.title.is_empty());
    assert_eq!(without.left_out, ["so long a title"]);
    assert!(layout(&long[..8]).left_out.is_empty());
}

#[test]
fn the_plot_is_shown_pixel_by_pixel() {
    let map = example::map(80, 60);
    for (width, height) in [(200, 150), (640, 480)] {
        let size = Size::new(width, height).unwrap();
        let window = Window::whole(&map.plane);
        let census = Census::of(&map, window).unwrap();
        let frame = frame_of(&map.plane);
        let plot = Layout::of(true, &title(&map.plane), &census, &frame, &Key::default(), size).plot;
        let [x, y, width, height] = [plot.x, plot.y, plot.width, plot.height].map(|length| length as u32);
        let expected = raster::draw(&map, window, &census, [width, height], size.em()).unwrap();
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
    assert_eq!(carried_configuration(picture.svg().as_bytes()), Some(map.config()));
}

#[test]
fn curves_that_share_a_name_of_the_papers_are_called_by_kind_and_motion() {
    let map = example::map(80, 60);
    let mut curves = example::curves(&map);
    let mut other = curves[1].clone();
    other.points.truncate(60);
    other.points.iter_mut().for_each(|point| point.y += 0.25);
    curves.push(other);
    let named = crate::paper::named(&curves, &map.plane);
    assert!(named.iter().any(|stretch| stretch.name.as_deref() == Some("L3'")), "a second one has a prime");
    let picture = region_map_with_curves(&map, &curves, Shown::All, 2, Size::new(1200, 900).unwrap());
    let said = |words: &str| picture.svg().matches(&format!(">{words}<")).count();
    assert_eq!((said("L3"), said("PF 1-1-1"), said("L3′")), (1, 1, 0));
}

#[test]
fn a_heap_of_curves_says_how_many_have_no_name() {
    let map = example::map(80, 60);
    let fold = example::curves(&map)[2].clone();
    let heap = |count: u32| -> Vec<Curve> {
        let lowered = |k| {
            let mut curve = fold.clone();
            curve.points.iter_mut().for_each(|point| point.y -= 0.004 * f64::from(k));
            curve
        };
        (0..count).map(lowered).collect()
    };
    for (count, all_named) in [(2, true), (40, false)] {
        let size = Size::new(1200, 900).unwrap();
        let picture = region_map_with_curves(&map, &heap(count), Shown::All, 2, size);
        let named = picture.svg().matches(">F 1-1-1<").count();
        let heading = format!("bifurcation ({} of {count} curves without a name)", count as usize - named);
        assert_eq!((named == count as usize, picture.svg().contains(&heading)), (all_named, !all_named));
        let list = format!(">not named: {} × F 1-1-1<", count as usize - named);
        assert_eq!(picture.svg().contains(&list), !all_named, "{list}");
        assert!(named > 0 && picture.svg().contains(">bifurcation"), "{named} of {count}");
    }
}
