//! The frame of a plot: its edges, ticks, labels and titles.

use super::canvas::Canvas;
use super::ink::INK;
use super::scale::Scale;
use super::shapes::{Anchor, Point, Rect};
use super::text::Text;
use super::ticks::Ticks;

/// The most labels on one axis.
const MOST_LABELS: usize = 12;
/// The lengths, distances and text sizes of a frame, in em.
const TICK: f64 = 0.45;
const MINOR_TICK: f64 = 0.25;
const GAP: f64 = 0.35;
pub(crate) const TITLE: f64 = 1.1;
const TITLE_GAP: f64 = 0.6;
/// What the outermost labels may stand out at the upper and the right end, in em.
const OVERHANG: f64 = 0.7;
/// What the outermost label at the right end may stand out at most: a part of it into the margin.
const WIDEST_OVERHANG: f64 = 1.5;

/// What stands along an axis: in full, and as short as possible where space is scarce.
#[derive(Clone, Debug, PartialEq)]
pub struct AxisTitle {
    /// Description and symbol.
    pub long: Text,
    /// The symbol alone.
    pub short: Text,
}

impl AxisTitle {
    /// A description and a symbol behind it.
    pub fn new(description: &str, short: Text) -> Self {
        AxisTitle { long: Text::from(description).upright(" ").then(short.clone()), short }
    }

    /// The fullest title that is no longer than `room`, in the unit that the labels leave out.
    pub(crate) fn fitting(&self, exponent: i32, size: f64, room: f64) -> Option<Text> {
        let unit = |title: &Text| match exponent {
            0 => title.clone(),
            power => title.clone().upright(" / 10").superscript(power.to_string().replace('-', "−")),
        };
        [&self.long, &self.short].map(unit).into_iter().find(|title| title.width(size) <= room)
    }
}

/// The axes around a plot.
#[derive(Clone, Debug)]
pub struct Frame {
    /// The scale along the lower edge.
    pub x: Scale,
    /// The scale along the left edge, upwards.
    pub y: Scale,
    /// The title of the lower edge.
    pub x_title: AxisTitle,
    /// The title of the left edge.
    pub y_title: AxisTitle,
}

/// A frame that has found its place.
#[derive(Clone, Debug)]
pub(crate) struct Placed {
    /// The plot inside the frame, on whole pixels.
    pub plot: Rect,
    x_ticks: Ticks,
    y_ticks: Ticks,
    titles: bool,
}

impl Frame {
    /// Fits frame, labels and, if wanted, titles into `space`.
    ///
    /// `None` where a plot of any use would not be left over.
    pub(crate) fn place(&self, space: Rect, em: f64, titles: bool) -> Option<Placed> {
        self.place_beside(0.0, space, em, titles)
    }

    /// Like [`Frame::place`], with a room of at least `left` pixels at the left of the plot, so that the plots of
    /// several frames can stand above each other.
    pub(crate) fn place_beside(&self, left: f64, space: Rect, em: f64, titles: bool) -> Option<Placed> {
        let title = if titles { (TITLE_GAP + TITLE) * em } else { 0.0 };
        let top = (space.y + OVERHANG * em).round();
        let bottom = (space.bottom() - (TICK + GAP + 1.0) * em - title).round();
        let mut right = (space.right() - OVERHANG * em).round();
        let y_ticks = fitting_ticks(self.y, bottom - top, |_| 2.0 * em);
        let labels = widest(&y_ticks, em);
        let left = (space.x + (title + labels + (GAP + TICK) * em).max(left)).round();
        let x_ticks_to =
            |right: f64| fitting_ticks(self.x, right - left, |ticks| widest(ticks, em) + 1.2 * em);
        let mut x_ticks = x_ticks_to(right);
        // Where the label at the right end is long, the plot is made narrower.
        let excess = overhang(self.x, &x_ticks, right - left, em) - WIDEST_OVERHANG * em;
        if excess > 0.0 {
            right = (right - excess).round();
            x_ticks = x_ticks_to(right);
        }
        let plot = Rect { x: left, y: top, width: right - left, height: bottom - top };
        let useful = plot.width >= 8.0 * em && plot.height >= 6.0 * em;
        useful.then_some(Placed { plot, x_ticks, y_ticks, titles })
    }

    /// Draws the frame around its plot.
    pub(crate) fn draw(&self, canvas: &mut Canvas, placed: &Placed, em: f64) {
        let Placed { plot, x_ticks, y_ticks, .. } = placed;
        let line = line_width(em);
        let edge = plot.grown(line / 2.0);
        let x_of = |value: f64| on_pixel(plot.x + self.x.fraction(value) * plot.width, line);
        let y_of = |value: f64| on_pixel(plot.bottom() - self.y.fraction(value) * plot.height, line);
        let below = |value: f64, length: f64| {
            let x = x_of(value);
            (Point { x, y: edge.bottom() }, Point { x, y: edge.bottom() + length * em })
        };
        let beside = |value: f64, length: f64| {
            let y = y_of(value);
            (Point { x: edge.x, y }, Point { x: edge.x - length * em, y })
        };
        let mut lines = Vec::new();
        lines.extend(x_ticks.labelled.iter().map(|&(value, _)| below(value, TICK)));
        lines.extend(x_ticks.minor.iter().map(|&value| below(value, MINOR_TICK)));
        lines.extend(y_ticks.labelled.iter().map(|&(value, _)| beside(value, TICK)));
        lines.extend(y_ticks.minor.iter().map(|&value| beside(value, MINOR_TICK)));
        canvas.outline(edge, line, INK);
        canvas.lines(&lines, line, INK);

        let labels_y = plot.bottom() + (TICK + GAP + 0.5) * em;
        for (value, label) in &x_ticks.labelled {
            let at = Point { x: x_of(*value), y: labels_y };
            canvas.text(&Text::from(&**label), at, Anchor::Middle, em, INK);
        }
        for (value, label) in &y_ticks.labelled {
            let at = Point { x: plot.x - (TICK + GAP) * em, y: y_of(*value) };
            canvas.text(&Text::from(&**label), at, Anchor::End, em, INK);
        }
        if placed.titles {
            self.draw_titles(canvas, placed, em);
        }
    }

    fn draw_titles(&self, canvas: &mut Canvas, placed: &Placed, em: f64) {
        let Placed { plot, x_ticks, y_ticks, .. } = placed;
        let size = TITLE * em;
        if let Some(title) = self.x_title.fitting(x_ticks.exponent, size, plot.width) {
            let y = plot.bottom() + (TICK + GAP + 1.0 + TITLE_GAP) * em + 0.4 * size;
            canvas.text(&title, Point { x: plot.x + plot.width / 2.0, y }, Anchor::Middle, size, INK);
        }
        if let Some(title) = self.y_title.fitting(y_ticks.exponent, size, plot.height) {
            let x = plot.x - (TICK + GAP + TITLE_GAP) * em - widest(y_ticks, em) - 0.4 * size;
            let at = Point { x, y: plot.y + plot.height / 2.0 };
            canvas.rising_text(&title, at, Anchor::Middle, size, INK);
        }
    }
}

/// The width of a frame's lines: whole pixels, so that they are sharp.
pub(crate) fn line_width(em: f64) -> f64 {
    (0.07 * em).round().max(1.0)
}

/// The nearest place where a line of whole pixels is sharp.
fn on_pixel(at: f64, line: f64) -> f64 {
    (at - line / 2.0).round() + line / 2.0
}

/// The most ticks whose labels, each with the `room` that it needs, fit along `length`.
pub(crate) fn fitting_ticks(scale: Scale, length: f64, room: impl Fn(&Ticks) -> f64) -> Ticks {
    let fits = |ticks: &Ticks| {
        let apart = |pair: &[(f64, String)]| (scale.fraction(pair[1].0) - scale.fraction(pair[0].0)).abs();
        let nearest = ticks.labelled.windows(2).map(apart).fold(f64::INFINITY, f64::min);
        nearest * length >= room(ticks)
    };
    let candidates = (1..=MOST_LABELS).rev().map(|most| scale.ticks(most));
    let mut fitting = candidates.filter(fits);
    fitting.next().unwrap_or_else(|| scale.ticks(1))
}

/// How far the labels stand out at the right end of an axis of a length.
fn overhang(scale: Scale, ticks: &Ticks, length: f64, em: f64) -> f64 {
    let end = |(value, label): &(f64, String)| {
        scale.fraction(*value) * length + Text::from(&**label).width(em) / 2.0 - length
    };
    ticks.labelled.iter().map(end).fold(0.0, f64::max)
}

/// The width of the widest label.
pub(crate) fn widest(ticks: &Ticks, em: f64) -> f64 {
    ticks.labelled.iter().map(|(_, label)| Text::from(&**label).width(em)).fold(0.0, f64::max)
}
