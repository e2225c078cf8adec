//! The key of a figure: what its lines, dots and fills stand for, in rows below the plots.

use crate::figure::canvas::Canvas;
use crate::figure::ink::INK;
use crate::figure::paint::Paint;
use crate::figure::shapes::{Anchor, Colour, Point, Rect};
use crate::figure::text::Text;

/// The lengths of a key, in em.
const ROW: f64 = 1.5;
const SAMPLE: f64 = 1.6;
const GAP: f64 = 0.5;
const BETWEEN: f64 = 1.6;

/// How something looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// A line.
    Line(Colour),
    /// A dot.
    Dot(Colour),
    /// A fill.
    Fill(Paint),
}

/// What something stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct KeyEntry {
    /// How it looks.
    pub sample: Sample,
    /// What it stands for.
    pub name: Text,
}

/// Cuts a key into rows that are no wider than `width`.
pub(crate) fn rows(entries: &[KeyEntry], width: f64, em: f64) -> Vec<Vec<&KeyEntry>> {
    let mut rows: Vec<Vec<&KeyEntry>> = Vec::new();
    let mut used = f64::INFINITY;
    for entry in entries {
        let own = length(entry, em);
        if used + own > width {
            rows.push(Vec::new());
            used = 0.0;
        }
        used += own + BETWEEN * em;
        rows.last_mut().expect("the first entry begins a row").push(entry);
    }
    rows
}

/// The width of the widest entry.
pub(crate) fn widest(entries: &[KeyEntry], em: f64) -> f64 {
    entries.iter().map(|entry| length(entry, em)).fold(0.0, f64::max)
}

/// The height of so many rows.
pub(crate) fn height(rows: usize, em: f64) -> f64 {
    rows as f64 * ROW * em
}

fn length(entry: &KeyEntry, em: f64) -> f64 {
    (SAMPLE + GAP) * em + entry.name.width(em)
}

/// Draws rows with their upper left corner at `at`.
pub(crate) fn draw(canvas: &mut Canvas, rows: &[Vec<&KeyEntry>], at: Point, em: f64) {
    for (row, entries) in rows.iter().enumerate() {
        let y = at.y + (row as f64 + 0.5) * ROW * em;
        let mut x = at.x;
        for entry in entries {
            draw_sample(canvas, entry.sample, Point { x, y }, em);
            canvas.text(&entry.name, Point { x: x + (SAMPLE + GAP) * em, y }, Anchor::Start, em, INK);
            x += length(entry, em) + BETWEEN * em;
        }
    }
}

fn draw_sample(canvas: &mut Canvas, sample: Sample, at: Point, em: f64) {
    let right = at.x + SAMPLE * em;
    match sample {
        Sample::Line(colour) => {
            let y = at.y.round();
            canvas.lines(&[(Point { x: at.x, y }, Point { x: right, y })], 0.16 * em, colour);
        }
        Sample::Dot(colour) => canvas.dots(&[Point { x: (at.x + right) / 2.0, y: at.y }], 0.4 * em, colour),
        Sample::Fill(paint) => {
            let rect = Rect {
                x: at.x.round(),
                y: (at.y - 0.45 * em).round(),
                width: (SAMPLE * em).round(),
                height: (0.9 * em).round(),
            };
            canvas.paint(rect, paint, em);
            canvas.outline(rect, 1.0, INK);
        }
    }
}
