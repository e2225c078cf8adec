//! Structure of figures: every word inside the picture and apart from the others, every mark inside its plot.

use image::Rgb;
use resvg::usvg::{Group, Node, Options, Rect as Box, Tree};

use super::*;
use crate::figure::font;
use crate::figure::frame::AxisTitle;
use crate::figure::paint::Paint;
use crate::figure::scale::Scale;

const BLUE: Rgb<u8> = Rgb([39, 109, 173]);

fn title(name: &str) -> AxisTitle {
    AxisTitle { long: format!("a quantity {name}").into(), short: name.into() }
}

fn panel(strips: usize) -> Panel {
    let points: Vec<[f64; 2]> = (0..500).map(|i| [f64::from(i) / 50.0 - 5.0, f64::from(i % 37)]).collect();
    let stretch =
        |i: i32| Stretch { x: [f64::from(i), f64::from(i) + 1.0], paint: Paint::hatched(BLUE, Rgb([0; 3])) };
    let label = |i: i32| StripLabel {
        x: [f64::from(i), f64::from(i) + 1.0],
        names: vec!["1-1-1 symmetric, with a long name".into(), "1-1-1".into()],
    };
    let strip = Strip {
        stretches: (-6..6).map(stretch).collect(),
        labels: (-6..6).map(label).collect(),
        name: Some("down".into()),
    };
    Panel {
        caption: Some("(a) a caption".into()),
        frame: Frame {
            x: Scale::new(4.0, -4.0),
            y: Scale::new(0.0, 30.0),
            x_title: title("x"),
            y_title: title("y"),
        },
        marks: vec![
            Mark::Band { x: [-9.0, -3.5], colour: BLUE },
            Mark::Line { points: points.clone(), width: 0.1, colour: BLUE },
            Mark::Dots { points, diameter: 0.2, colour: BLUE },
            Mark::Level { y: 5.0, width: 0.1, colour: BLUE },
            Mark::Level { y: 50.0, width: 0.1, colour: BLUE },
            Mark::Upright { x: 0.0, width: 0.1, colour: BLUE },
        ],
        strips: vec![strip; strips],
        weight: 1.0,
    }
}

fn figure(rows: usize, columns: usize, strips: usize) -> Figure {
    let entry = |name: &str, sample| KeyEntry { sample, name: name.into() };
    Figure {
        title: vec!["ω = 3.7,".into(), "δ = 0.1,".into(), "start at rest".into()],
        rows: (0..rows).map(|_| Row { panels: vec![panel(strips); columns], weight: 1.0 }).collect(),
        key: vec![
            entry("impact", Sample::Dot(BLUE)),
            entry("orbit", Sample::Line(BLUE)),
            entry("sticking", Sample::Fill(Paint::plain(BLUE))),
        ],
        notes: vec!["a note".into(), "that goes on".into()],
        width: 29.0 * columns as f64,
    }
}

fn boxes(group: &Group, texts: &mut Vec<Box>, others: &mut Vec<Box>) {
    for node in group.children() {
        match node {
            Node::Group(inner) => boxes(inner, texts, others),
            Node::Text(text) => texts.push(text.abs_bounding_box()),
            other => others.push(other.abs_stroke_bounding_box()),
        }
    }
}

/// What is wrong with a picture: words that are clipped or overlap, shapes beyond the canvas.
pub(crate) fn faults(picture: &Picture, size: Size) -> Vec<String> {
    let options = Options { fontdb: font::database(), font_family: "Inter".into(), ..Options::default() };
    let tree = Tree::from_str(picture.svg(), &options).unwrap();
    let (mut texts, mut others) = (Vec::new(), Vec::new());
    boxes(tree.root(), &mut texts, &mut others);
    let (width, height) = (size.width() as f32, size.height() as f32);
    let inside = |b: &Box| b.left() >= 0.0 && b.top() >= 0.0 && b.right() <= width && b.bottom() <= height;
    let mut faults = Vec::new();
    for (i, text) in texts.iter().enumerate() {
        if let Some(other) = texts[..i].iter().find(|other| other.intersect(text).is_some()) {
            faults.push(format!("{text:?} overlaps {other:?}"));
        }
    }
    faults.extend(texts.iter().chain(&others).filter(|b| !inside(b)).map(|b| format!("{b:?} is outside")));
    faults
}

#[test]
fn words_are_apart_and_everything_is_inside() {
    for (rows, columns, strips) in [(1, 1, 0), (1, 2, 0), (2, 2, 1), (2, 1, 2), (1, 3, 0), (4, 2, 0)] {
        let figure = figure(rows, columns, strips);
        for width in [600, 1000, 2400] {
            let size = figure.natural_size(width);
            let picture = match figure.draw(size, "{}") {
                Ok(picture) => picture,
                Err(small) => {
                    let enough = Size::new(small.least_width, small.least_height).unwrap();
                    assert!(enough.width() > width);
                    figure.draw(enough, "{}").unwrap();
                    continue;
                }
            };
            assert_eq!(faults(&picture, size), [""; 0], "{rows} × {columns}, {width}");
        }
    }
}

#[test]
fn long_captions_are_made_to_fit() {
    for (length, fits) in [(20, true), (34, true), (400, false)] {
        let mut figure = figure(1, 3, 0);
        for panel in &mut figure.rows[0].panels {
            panel.caption = Some("n".repeat(length).as_str().into());
        }
        let size = figure.natural_size(2000);
        match figure.draw(size, "{}") {
            Ok(picture) => assert_eq!((faults(&picture, size), fits), (Vec::new(), true), "{length}"),
            Err(_) => assert!(!fits, "{length}"),
        }
    }
}

#[test]
fn faults_are_found() {
    let size = Size::new(300, 200).unwrap();
    let mut canvas = Canvas::new(size, "{}");
    for x in [40.0, 45.0, 290.0] {
        canvas.text(&"word".into(), Point { x, y: 100.0 }, Anchor::Start, 12.0, BLUE);
    }
    canvas.dots(&[Point { x: -5.0, y: 5.0 }], 3.0, BLUE);
    let picture = Picture::new(size, "{}".into(), canvas.finish());
    assert_eq!(faults(&picture, size).len(), 3);
}

#[test]
fn a_size_that_is_too_small_is_refused_with_one_that_is_enough() {
    let figure = figure(2, 2, 0);
    let small = figure.draw(Size::new(200, 150).unwrap(), "{}").unwrap_err();
    assert!(small.to_string().contains("200 × 150"), "{small}");
    assert!(figure.draw(Size::new(small.least_width, small.least_height).unwrap(), "{}").is_ok());
}

#[test]
fn many_dots_become_pixels_and_look_alike() {
    let drawn = |copies: usize| {
        let points = [[0.0, 15.0], [1.0, 16.0]].repeat(copies);
        let mut figure = figure(1, 1, 0);
        figure.rows[0].panels[0].marks = vec![Mark::Dots { points, diameter: 0.3, colour: BLUE }];
        let size = figure.natural_size(800);
        let picture = figure.draw(size, "{}").unwrap();
        let blue = picture.pixels().pixels().filter(|pixel| **pixel == BLUE).count();
        (picture.svg().contains("<image"), blue)
    };
    let (discs, pixels) = (drawn(1), drawn(15_000));
    assert_eq!((discs.0, pixels.0), (false, true));
    assert!(discs.1 > 20 && pixels.1 > 20 && pixels.1 < 4 * discs.1, "{discs:?} {pixels:?}");
}

#[test]
fn stacked_plots_share_their_left_edge() {
    let mut figure = figure(2, 1, 0);
    figure.rows[1].panels[0].frame.y = Scale::new(1000.0, 1000.0001);
    let layout = figure.layout(figure.natural_size(1200)).unwrap();
    assert_eq!(layout.panels[0].plot.x, layout.panels[1].plot.x);
}
