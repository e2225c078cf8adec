//! Strips above a plot: stretches of the horizontal axis, painted and named.

use super::marks::Plot;
use crate::figure::canvas::Canvas;
use crate::figure::frame::line_width;
use crate::figure::ink::INK;
use crate::figure::paint::Paint;
use crate::figure::shapes::{Anchor, Point, Rect};
use crate::figure::text::Text;

/// The lengths of a strip, in em.
const HEIGHT: f64 = 0.7;
const GAP: f64 = 0.35;
const LABEL: f64 = 0.85;
const LABEL_ROW: f64 = 1.2;

/// A stretch of the horizontal axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Stretch {
    /// Its first and last x.
    pub x: [f64; 2],
    /// How it looks.
    pub paint: Paint,
}

/// What a part of a strip is called.
#[derive(Clone, Debug, PartialEq)]
pub struct StripLabel {
    /// The first and last x of the part.
    pub x: [f64; 2],
    /// Its names, the longest first; the first that fits is written.
    pub names: Vec<Text>,
}

/// A strip along the horizontal axis, with labels above it where they fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Strip {
    /// The stretches, in any order.
    pub stretches: Vec<Stretch>,
    /// What stands above it, where there is room.
    pub labels: Vec<StripLabel>,
    /// What the whole strip is called, at its left, where there are several.
    pub name: Option<Text>,
}

/// The height that strips take above a plot.
pub(crate) fn height(strips: &[Strip], em: f64) -> f64 {
    strips.len() as f64 * (HEIGHT + GAP + LABEL_ROW) * em
}

/// Draws strips above a plot, the last one next to it.
pub(crate) fn draw(canvas: &mut Canvas, plot: &Plot<'_>, strips: &[Strip], em: f64) {
    let line = line_width(em);
    for (i, strip) in strips.iter().rev().enumerate() {
        let bottom = plot.rect.y - line - (i as f64 * (HEIGHT + GAP + LABEL_ROW) + GAP) * em;
        let (y, height) = ((bottom - HEIGHT * em).round(), (HEIGHT * em).round());
        for stretch in &strip.stretches {
            let [a, b] = stretch.x.map(|x| plot.at([x, 0.0]).x.clamp(plot.rect.x, plot.rect.right()));
            let (left, right) = (a.min(b), a.max(b));
            if right > left {
                canvas.paint(Rect { x: left, y, width: right - left, height }, stretch.paint, 0.6 * em);
            }
        }
        let Rect { x, width, .. } = plot.rect;
        canvas.outline(Rect { x, y, width, height }, line, INK);
        let middle = y - 0.5 * LABEL_ROW * em;
        let mut taken = labels(plot, strip, em);
        if let Some(name) = &strip.name {
            // The strip's own name comes first; labels that it would cover give way.
            let end = x + name.width(LABEL * em) + em;
            taken.retain(|(left, _)| *left > end);
            canvas.text(name, Point { x, y: middle }, Anchor::Start, LABEL * em, INK);
        }
        for (left, label) in taken {
            canvas.text(label, Point { x: left, y: middle }, Anchor::Start, LABEL * em, INK);
        }
    }
}

/// The labels that fit over their stretches, with their left ends.
fn labels<'a>(plot: &Plot<'_>, strip: &'a Strip, em: f64) -> Vec<(f64, &'a Text)> {
    let fitting = strip.labels.iter().filter_map(|label| {
        let [a, b] = label.x.map(|x| plot.at([x, 0.0]).x.clamp(plot.rect.x, plot.rect.right()));
        let room = (b - a).abs() - 0.4 * em;
        let name = label.names.iter().find(|name| name.width(LABEL * em) <= room)?;
        Some(((a + b - name.width(LABEL * em)) / 2.0, name))
    });
    fitting.collect()
}
