//! What the lines and marks of curves mean.

use super::major::DRAWN_IN_A_THOUSAND;
use super::style::{CASING, KINDS, Line, names};
use crate::curves::Kind;
use crate::figure::{Anchor, Canvas, INK, MUTED, Point, Text};

/// The lengths of the key, in em.
const ROW: f64 = 1.4;
const SAMPLE: f64 = 1.7;
const GAP: f64 = 0.6;
const COLUMN_GAP: f64 = 1.6;
const HEADING: f64 = 0.9;
/// The radius of a mark.
pub(super) const MARK: f64 = 0.2;

/// A key to lines and marks: the kinds drawn, and what else there is to explain.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::render) struct Key {
    pub(super) kinds: Vec<Kind>,
    pub(super) subcritical: bool,
    pub(super) marks: bool,
    /// How many curves there are.
    pub(super) curves: usize,
    /// How many more there are, too small to be drawn.
    pub(super) minor: usize,
}

#[derive(Clone, Copy)]
enum Row {
    Kind(Kind),
    Subcritical,
    Mark,
}

impl Key {
    fn rows(&self) -> Vec<(Row, Text)> {
        let kinds = KINDS.into_iter().filter(|kind| self.kinds.contains(kind)).map(|kind| {
            let [name, short] = names(kind);
            (Row::Kind(kind), format!("{name} ({short})").into())
        });
        let subcritical = self.subcritical.then(|| (Row::Subcritical, "subcritical".into()));
        let marks = self.marks.then(|| (Row::Mark, "codimension two, one or several".into()));
        kinds.chain(subcritical).chain(marks).collect()
    }

    /// How many columns fit into a width.
    pub fn columns_in(&self, width: f64, em: f64) -> usize {
        (((width + COLUMN_GAP * em) / (self.width(em) + COLUMN_GAP * em)) as usize).max(1)
    }

    /// The width of one column.
    pub fn width(&self, em: f64) -> f64 {
        let rows = self.rows();
        let names = rows.iter().map(|(_, name)| (SAMPLE + GAP) * em + name.width(em));
        names.fold(heading(self.curves, self.curves).width(HEADING * em), f64::max)
    }

    /// The height in a number of columns; nothing if there is nothing to explain.
    pub fn height(&self, columns: usize, em: f64) -> f64 {
        match self.rows().len() {
            0 => 0.0,
            rows => (1 + rows.div_ceil(columns)) as f64 * ROW * em,
        }
    }

    /// Draws the key with its upper left corner at `at`; below it, where there is room in a space of `width` down to
    /// `bottom`, what the curves are that have no name on the plot.
    pub fn draw(
        &self,
        canvas: &mut Canvas,
        at: Point,
        columns: usize,
        unnamed: &[String],
        [width, bottom]: [f64; 2],
        em: f64,
    ) {
        let rows = self.rows();
        if rows.is_empty() {
            return;
        }
        let middle = |row: usize| at.y + (row as f64 + 0.5) * ROW * em;
        let heading = heading(unnamed.len(), self.curves);
        canvas.text(&heading, Point { x: at.x, y: middle(0) }, Anchor::Start, HEADING * em, MUTED);
        let in_column = rows.len().div_ceil(columns);
        for (i, (row, name)) in rows.iter().enumerate() {
            let left = at.x + (i / in_column) as f64 * (self.width(em) + COLUMN_GAP * em);
            let y = middle(1 + i % in_column);
            let ends = [Point { x: left, y }, Point { x: left + SAMPLE * em, y }];
            match row {
                Row::Kind(kind) => draw_line(canvas, &ends, &Line::of(*kind, em)),
                Row::Subcritical => draw_line(canvas, &ends, &Line::subcritical(MUTED, em)),
                Row::Mark => {
                    draw_mark(canvas, Point { x: left + 0.25 * SAMPLE * em, y }, 1, em);
                    draw_mark(canvas, Point { x: left + 0.75 * SAMPLE * em, y }, 2, em);
                }
            }
            canvas.text(name, Point { x: left + (SAMPLE + GAP) * em, y }, Anchor::Start, em, INK);
        }
        let lines = Text::wrap(listed(unnamed), HEADING * em, width);
        let minor = Text::wrap(not_drawn(self.minor), HEADING * em, width);
        let lines: Vec<Text> = lines.into_iter().chain(minor).collect();
        let row = HEADING * ROW * em;
        let first = middle(in_column) + 0.5 * (ROW * em + row);
        if first + (lines.len() as f64 - 0.5) * row <= bottom {
            for (i, line) in lines.iter().enumerate() {
                let at = Point { x: at.x, y: first + i as f64 * row };
                canvas.text(line, at, Anchor::Start, HEADING * em, MUTED);
            }
        }
    }
}

/// The curves without a name in pieces, those that are called alike together.
fn listed(unnamed: &[String]) -> Vec<Text> {
    let mut names = unnamed.to_vec();
    names.sort_unstable();
    let alike = names.chunk_by(|a, b| a == b);
    let pieces: Vec<String> = alike
        .map(|alike| match alike.len() {
            1 => alike[0].clone(),
            count => format!("{count} × {}", alike[0]),
        })
        .collect();
    let Some((last, others)) = pieces.split_last() else { return Vec::new() };
    let heading = std::iter::once("not named:".into());
    heading
        .chain(others.iter().map(|piece| format!("{piece},").into()))
        .chain([last.as_str().into()])
        .collect()
}

/// How many curves are not drawn, word by word.
fn not_drawn(minor: usize) -> Vec<Text> {
    let said = match minor {
        0 => String::new(),
        _ => format!(
            "not drawn: {minor} curves of motions that fill less than {}.{} % of the plane",
            DRAWN_IN_A_THOUSAND / 10,
            DRAWN_IN_A_THOUSAND % 10
        ),
    };
    said.split_whitespace().map(Text::from).collect()
}

fn heading(unnamed: usize, curves: usize) -> Text {
    match unnamed {
        0 => "bifurcation".into(),
        _ => format!("bifurcation ({unnamed} of {curves} curves without a name)").into(),
    }
}

fn draw_line(canvas: &mut Canvas, points: &[Point], line: &Line) {
    canvas.stroke(points, line.width, line.colour, &line.dashes);
}

/// Draws the mark of a special point, or of several so close together that their marks would be a heap.
pub(super) fn draw_mark(canvas: &mut Canvas, at: Point, count: usize, em: f64) {
    canvas.disc(at, MARK * em, CASING, 0.08 * em, INK);
    if count > 1 {
        canvas.disc(at, 0.45 * MARK * em, INK, 0.0, INK);
    }
}
