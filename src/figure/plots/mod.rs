//! Figures of one or several plots: lines, dots, bands, strips, and a key.

pub(crate) mod clip;
mod key;
mod marks;
mod strip;
mod too_small;

pub use key::{KeyEntry, Sample};
pub use marks::Mark;
pub use strip::{Stretch, Strip, StripLabel};
pub use too_small::TooSmall;

use self::marks::Plot;
use super::canvas::Canvas;
use super::frame::{Frame, Placed};
use super::ink::{INK, MUTED};
use super::picture::Picture;
use super::shapes::{Anchor, Point, Rect};
use super::size::Size;
use super::text::Text;

/// The lengths of a figure, in em.
const MARGIN: f64 = 1.0;
const TITLE_ROW: f64 = 1.4;
const CAPTION_ROW: f64 = 1.5;
const COLUMN_GAP: f64 = 1.2;
const ROW_GAP: f64 = 0.6;
const KEY_GAP: f64 = 0.5;
const NOTE: f64 = 0.9;
const NOTE_ROW: f64 = 1.3;
/// What ticks and titles take at the left of a plot at most, so that the title above it fits.
const LEFT: f64 = 7.0;
/// The sizes of text that are tried, as shares of the one that suits the width.
const TEXT_SIZES: [f64; 5] = [1.0, 0.9, 0.8, 0.7, 0.6];
/// How far a caption may reach beyond its plot, in em, and the smallest share of the text's size that makes it fit.
const BEYOND: f64 = 0.5;
const CAPTION_LEAST: f64 = 0.75;
/// The smallest text, in pixels.
const SMALLEST_EM: f64 = 9.5;

/// One plot of a figure.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What stands above it.
    pub caption: Option<Text>,
    /// Its axes.
    pub frame: Frame,
    /// What is drawn in it, in order.
    pub marks: Vec<Mark>,
    /// Strips above it.
    pub strips: Vec<Strip>,
    /// Its share of its row's width.
    pub weight: f64,
}

impl Panel {
    /// A plot without caption or strips, as wide as others.
    pub fn new(frame: Frame, marks: Vec<Mark>) -> Self {
        Panel { caption: None, frame, marks, strips: Vec::new(), weight: 1.0 }
    }
}

/// A row of plots.
#[derive(Clone, Debug)]
pub struct Row {
    /// The plots, from left to right.
    pub panels: Vec<Panel>,
    /// Its share of the figure's height.
    pub weight: f64,
}

impl Row {
    /// Plots in rows of so many beside each other, each row of the same height.
    pub fn of(panels: Vec<Panel>, beside: usize, weight: f64) -> Vec<Row> {
        panels.chunks(beside).map(|row| Row { panels: row.to_vec(), weight }).collect()
    }
}

/// A figure: rows of plots under a title, with a key and notes below.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The title in pieces that belong together.
    pub title: Vec<Text>,
    /// The plots, from top to bottom.
    pub rows: Vec<Row>,
    /// What marks stand for.
    pub key: Vec<KeyEntry>,
    /// Smaller text at the bottom, in pieces that belong together.
    pub notes: Vec<Text>,
    /// How many em the figure is wide: about 36 to be printed across a column, 58 across a page.
    pub width: f64,
}

impl Figure {
    /// A size that suits the figure, for a picture so many pixels wide: plots about four fifths as high as wide.
    pub fn natural_size(&self, width: u32) -> Size {
        let columns = self.rows.iter().map(|row| row.panels.iter().map(|p| p.weight).sum::<f64>());
        let across = columns.fold(1.0, f64::max);
        let rows: f64 = self.rows.iter().map(|row| row.weight).sum();
        let em = f64::from(width) / self.width;
        let height = rows * 0.8 * f64::from(width) / across + 5.0 * em;
        let height = (height as u32).clamp(Size::SMALLEST, Size::LARGEST);
        let size = Size::new(width.clamp(Size::SMALLEST, Size::LARGEST), height).unwrap_or_else(|_| {
            Size::new(Size::SMALLEST, Size::SMALLEST).expect("the smallest size is a size")
        });
        self.at_least(size)
    }

    /// A size, or a larger one where the figure does not fit into it, if it fits into any.
    pub fn at_least(&self, size: Size) -> Size {
        if self.layout(size).is_some() { size } else { self.enough(size).unwrap_or(size) }
    }

    /// The first of larger sizes that the figure fits into: as much wider as higher, or higher alone, since letters grow with the
    /// width.
    fn enough(&self, size: Size) -> Option<Size> {
        (10..400).map(|percent| f64::from(percent) * 0.1).find_map(|factor| {
            let scaled = |side: u32| (f64::from(side.max(100)) * factor) as u32;
            let larger = [scaled(size.width()), size.width().max(100)]
                .map(|width| Size::new(width, scaled(size.height())));
            larger.into_iter().flatten().find(|&larger| self.layout(larger).is_some())
        })
    }

    /// Draws the figure; `config` says what it takes to make it again.
    ///
    /// # Errors
    /// [`TooSmall`] with a size that is enough.
    pub fn draw(&self, size: Size, config: &str) -> Result<Picture, TooSmall> {
        let layout = self.layout(size).ok_or_else(|| self.too_small(size))?;
        let em = layout.em;
        let mut canvas = Canvas::new(size, config);
        for (line, text) in layout.title.iter().enumerate() {
            let y = (MARGIN + (line as f64 + 0.5) * TITLE_ROW) * em;
            canvas.text(text, Point { x: layout.left, y }, Anchor::Start, em, INK);
        }
        let panels = self.rows.iter().flat_map(|row| &row.panels);
        for (panel, placed) in panels.zip(&layout.panels) {
            panel.draw(&mut canvas, placed, em, layout.caption);
        }
        key::draw(&mut canvas, &layout.key, Point { x: layout.left, y: layout.key_top }, em);
        for (line, text) in layout.notes.iter().enumerate() {
            let y = layout.notes_top + (line as f64 + 0.5) * NOTE_ROW * em;
            canvas.text(text, Point { x: layout.left, y }, Anchor::Start, NOTE * em, MUTED);
        }
        Ok(Picture::new(size, config.to_owned(), canvas.finish()))
    }

    fn too_small(&self, size: Size) -> TooSmall {
        let enough = self.enough(size).unwrap_or_else(|| self.natural_size(1600));
        TooSmall {
            width: size.width(),
            height: size.height(),
            least_width: enough.width(),
            least_height: enough.height(),
        }
    }

    /// The layout with the largest text that leaves room for the plots.
    fn layout(&self, size: Size) -> Option<Layout<'_>> {
        let usual = f64::from(size.width()) / self.width;
        TEXT_SIZES.iter().find_map(|share| self.layout_with(size, (share * usual).max(SMALLEST_EM)))
    }

    fn layout_with(&self, size: Size, em: f64) -> Option<Layout<'_>> {
        let width = f64::from(size.width()) - 2.0 * MARGIN * em;
        let text_width = width - LEFT * em;
        let title = Text::wrap(self.title.clone(), em, text_width);
        let notes = Text::wrap(self.notes.clone(), NOTE * em, text_width);
        let key = key::rows(&self.key, text_width, em);
        let too_wide = title.iter().any(|line| line.width(em) > text_width)
            || notes.iter().any(|line| line.width(NOTE * em) > text_width)
            || key::widest(&self.key, em) > text_width;
        if too_wide {
            return None;
        }
        let bottom = f64::from(size.height()) - MARGIN * em;
        let notes_top = bottom - notes.len() as f64 * NOTE_ROW * em;
        let key_height = key::height(key.len(), em);
        let key_gap = if key.is_empty() && notes.is_empty() { 0.0 } else { KEY_GAP * em };
        let key_top = notes_top - key_height;
        let top = (MARGIN + title.len() as f64 * TITLE_ROW) * em;
        let space = Rect { x: MARGIN * em, y: top, width, height: key_top - key_gap - top };
        let panels = self.place(space, em)?;
        let left = panels.first().map_or(space.x, |placed| placed.plot.x);
        let caption = self.caption_size(&panels, em)?;
        Some(Layout { em, left, title, panels, caption, key, key_top, notes, notes_top })
    }

    /// The text size at which every caption fits above its plot.
    fn caption_size(&self, placed: &[Placed], em: f64) -> Option<f64> {
        let panels = self.rows.iter().flat_map(|row| &row.panels).zip(placed);
        let shares = panels.filter_map(|(panel, placed)| {
            let room = placed.plot.width + BEYOND * em;
            panel.caption.as_ref().map(|caption| room / caption.width(em))
        });
        let share = shares.fold(1.0, f64::min);
        (share >= CAPTION_LEAST).then_some(share * em)
    }

    /// Places every panel; plots that stand above each other, one to a row, share their left edge.
    fn place(&self, space: Rect, em: f64) -> Option<Vec<Placed>> {
        let weights: f64 = self.rows.iter().map(|row| row.weight).sum();
        let room = space.height - (self.rows.len() as f64 - 1.0) * ROW_GAP * em;
        let alone = self.rows.iter().all(|row| row.panels.len() == 1);
        let spaces: Vec<(&Panel, Rect)> = {
            let mut y = space.y;
            let mut spaces = Vec::new();
            for row in &self.rows {
                let height = room * row.weight / weights;
                spaces.extend(row.spaces(Rect { y, height, ..space }, em));
                y += height + ROW_GAP * em;
            }
            spaces
        };
        if room <= 0.0 || spaces.iter().any(|(_, space)| space.width <= 0.0 || space.height <= 0.0) {
            return None;
        }
        let place = |left: f64| {
            let placed = spaces.iter().map(|(panel, space)| panel.frame.place_beside(left, *space, em, true));
            placed.collect::<Option<Vec<_>>>()
        };
        let placed = place(0.0)?;
        if !alone {
            return Some(placed);
        }
        let left = placed.iter().map(|placed| placed.plot.x - space.x).fold(0.0, f64::max);
        place(left)
    }
}

/// Where everything goes.
struct Layout<'a> {
    em: f64,
    left: f64,
    title: Vec<Text>,
    panels: Vec<Placed>,
    /// The size of captions in pixels.
    caption: f64,
    key: Vec<Vec<&'a KeyEntry>>,
    key_top: f64,
    notes: Vec<Text>,
    notes_top: f64,
}

impl Row {
    /// The space of every panel's frame, below its caption and strips.
    fn spaces(&self, space: Rect, em: f64) -> Vec<(&Panel, Rect)> {
        let weights: f64 = self.panels.iter().map(|panel| panel.weight).sum();
        let room = space.width - (self.panels.len() as f64 - 1.0) * COLUMN_GAP * em;
        let above = self.panels.iter().map(|panel| panel.above(em)).fold(0.0, f64::max);
        let mut x = space.x;
        let mut spaces = Vec::new();
        for panel in &self.panels {
            let width = room * panel.weight / weights;
            spaces.push((panel, Rect { x, y: space.y + above, width, height: space.height - above }));
            x += width + COLUMN_GAP * em;
        }
        spaces
    }
}

impl Panel {
    /// The height of what stands above the plot.
    fn above(&self, em: f64) -> f64 {
        let caption = if self.caption.is_some() { CAPTION_ROW * em } else { 0.0 };
        caption + strip::height(&self.strips, em)
    }

    fn draw(&self, canvas: &mut Canvas, placed: &Placed, em: f64, caption_size: f64) {
        let plot = Plot { frame: &self.frame, rect: placed.plot, em };
        for mark in &self.marks {
            plot.draw(canvas, mark);
        }
        self.frame.draw(canvas, placed, em);
        strip::draw(canvas, &plot, &self.strips, em);
        if let Some(caption) = &self.caption {
            let y = placed.plot.y - strip::height(&self.strips, em) - 0.75 * em;
            canvas.text(caption, Point { x: placed.plot.x, y }, Anchor::Start, caption_size, INK);
        }
    }
}

#[cfg(test)]
pub(crate) mod tests;
