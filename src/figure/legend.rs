//! A legend: what the paints of a figure stand for.

use super::canvas::Canvas;
use super::frame::line_width;
use super::ink::{INK, MUTED};
use super::paint::Paint;
use super::shapes::{Anchor, Point, Rect};
use super::text::Text;

/// The lengths of a legend, in em.
const ROW: f64 = 1.5;
const SWATCH: [f64; 2] = [1.7, 1.0];
const GAP: f64 = 0.6;
const COLUMN_GAP: f64 = 1.6;
const NOTE: f64 = 0.9;
const NOTE_ROW: f64 = 1.4;
const NOTES_GAP: f64 = 0.6;

/// One row of a legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// What is shown in the sample: one paint, or the first few of a group, side by side.
    pub paints: Vec<Paint>,
    /// What it stands for.
    pub name: Text,
    /// A number that belongs to it, right-aligned.
    pub value: Option<Text>,
}

/// A legend, in one or several columns, with notes below.
#[derive(Clone, Debug, Default)]
pub struct Legend {
    /// What is above the names and above the values.
    pub heading: [Text; 2],
    /// The rows, in order.
    pub entries: Vec<Entry>,
    /// Lines of smaller text below.
    pub notes: Vec<Text>,
}

impl Legend {
    /// How many rows fit into a height, in one column with heading and notes.
    pub fn rows_in(height: f64, notes: usize, em: f64) -> usize {
        let rows = (height - notes_height(notes, em)) / (ROW * em) - 1.0;
        rows.max(0.0) as usize
    }

    /// How many columns fit into a width.
    pub fn columns_in(&self, width: f64, em: f64) -> usize {
        (((width + COLUMN_GAP * em) / (self.column(em) + COLUMN_GAP * em)) as usize).max(1)
    }

    /// The width that the legend takes in a number of columns.
    pub fn width(&self, columns: usize, em: f64) -> f64 {
        let notes = self.notes.iter().map(|note| note.width(NOTE * em)).fold(0.0, f64::max);
        let columns = columns as f64;
        (columns * self.column(em) + (columns - 1.0) * COLUMN_GAP * em).max(notes)
    }

    /// The height that the legend takes in a number of columns.
    pub fn height(&self, columns: usize, em: f64) -> f64 {
        let rows = 1 + self.entries.len().div_ceil(columns);
        rows as f64 * ROW * em + notes_height(self.notes.len(), em)
    }

    /// Draws the legend with its upper left corner at `at`, spread over `width`.
    pub fn draw(&self, canvas: &mut Canvas, at: Point, width: f64, columns: usize, em: f64) {
        let rows = self.entries.len().div_ceil(columns).max(1);
        let column = (width + COLUMN_GAP * em) / columns as f64 - COLUMN_GAP * em;
        let mut left = at.x;
        for entries in self.entries.chunks(rows) {
            self.draw_column(canvas, Point { x: left, y: at.y }, column, entries, em);
            left += column + COLUMN_GAP * em;
        }
        let mut y = at.y + ((rows + 1) as f64 * ROW + NOTES_GAP) * em;
        for note in &self.notes {
            y += NOTE_ROW * NOTE * em;
            let at = Point { x: at.x, y: y - 0.5 * NOTE_ROW * NOTE * em };
            canvas.text(note, at, Anchor::Start, NOTE * em, MUTED);
        }
    }

    fn draw_column(&self, canvas: &mut Canvas, at: Point, width: f64, entries: &[Entry], em: f64) {
        let [over_names, over_values] = &self.heading;
        let middle = |row: usize| at.y + (row as f64 + 0.5) * ROW * em;
        let right = at.x + width;
        canvas.text(over_names, Point { x: at.x, y: middle(0) }, Anchor::Start, NOTE * em, MUTED);
        canvas.text(over_values, Point { x: right, y: middle(0) }, Anchor::End, NOTE * em, MUTED);
        for (row, entry) in entries.iter().enumerate() {
            let y = middle(row + 1);
            let corner = Point { x: at.x.round(), y: (y - SWATCH[1] * em / 2.0).round() };
            draw_swatch(canvas, corner, &entry.paints, em);
            let x = at.x + (SWATCH[0] + GAP) * em;
            canvas.text(&entry.name, Point { x, y }, Anchor::Start, em, INK);
            if let Some(value) = &entry.value {
                canvas.text(value, Point { x: right, y }, Anchor::End, em, INK);
            }
        }
    }

    /// The width of one column.
    fn column(&self, em: f64) -> f64 {
        let [over_names, over_values] = self.heading.each_ref().map(|text| text.width(NOTE * em));
        let rows = self.entries.iter().map(|entry| {
            let value = entry.value.as_ref().map_or(0.0, |value| value.width(em) + 2.0 * GAP * em);
            (SWATCH[0] + GAP) * em + entry.name.width(em) + value
        });
        rows.fold(over_names + over_values + GAP * em, f64::max).ceil()
    }
}

fn notes_height(notes: usize, em: f64) -> f64 {
    if notes == 0 { 0.0 } else { (NOTES_GAP + notes as f64 * NOTE_ROW * NOTE) * em }
}

fn draw_swatch(canvas: &mut Canvas, corner: Point, paints: &[Paint], em: f64) {
    let [width, height] = SWATCH.map(|length| (length * em).round());
    let part = width / paints.len() as f64;
    for (i, paint) in paints.iter().enumerate() {
        let x = corner.x + i as f64 * part;
        canvas.paint(Rect { x, y: corner.y, width: part, height }, *paint, em);
    }
    let line = line_width(em);
    canvas.outline(Rect { x: corner.x, y: corner.y, width, height }.grown(line / 2.0), line, INK);
}

#[cfg(test)]
mod tests {
    use image::Rgb;

    use super::*;

    fn legend(entries: usize) -> Legend {
        let entry = |i: usize| Entry {
            paints: vec![Paint::plain(Rgb([200; 3]))],
            name: format!("motion {i}").into(),
            value: Some("1.0 %".into()),
        };
        Legend {
            heading: ["motion".into(), "share".into()],
            entries: (0..entries).map(entry).collect(),
            notes: vec!["a note".into(); 3],
        }
    }

    #[test]
    fn the_rows_that_fit_do_fit() {
        for em in [9.5, 20.0] {
            for height in [100.0, 300.0, 777.0] {
                let rows = Legend::rows_in(height, 3, em);
                assert!(rows == 0 || legend(rows).height(1, em) <= height);
                assert!(legend(rows + 1).height(1, em) > height);
            }
        }
    }

    #[test]
    fn the_columns_that_fit_do_fit() {
        let legend = legend(20);
        for width in [200.0, 500.0, 1500.0] {
            let columns = legend.columns_in(width, 10.0);
            assert!(legend.width(columns, 10.0) <= width);
            assert!(legend.width(columns + 1, 10.0) > width);
        }
    }
}
