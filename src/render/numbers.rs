//! Pictures of planes of numbers, with a colour bar.

use image::{Rgb, RgbImage};

use crate::analysis::Regime;
use crate::figure::{
    Anchor, Bar, Canvas, Colour, Frame, Hatch, INK, LeftOut, Paint, Palette, Picture, Placed, Point, Rect,
    Size, Text, WIDTH, draw_samples,
};
use crate::plane::fields::{CELL_FIELDS, CellsError, Layer, NOT_COMPUTED};
use crate::render::axes::frame_of;
use crate::render::colours::paint_of;
use crate::render::curves::Overlay;
use crate::render::motion::Motion;
use crate::render::regions::{PlanePicture, means, most};

/// The lengths of the picture, in em.
const MARGIN: f64 = 1.0;
const TITLE_ROW: f64 = 1.4;
const GAP: f64 = 1.3;
/// What the bar, its labels and its words take at the right.
const RIGHT: f64 = 9.5;
/// The most lines of a title.
const MOST_TITLE_LINES: usize = 3;

/// Cells without a number, those whose number is minus infinity, and those that were not computed.
pub const UNDEFINED: Colour = Rgb([0xd9, 0xd9, 0xd9]);
pub const LOST: Colour = Rgb([0x8c, 0x8c, 0x8c]);
const NOT_THERE: Paint = Paint::plain(Rgb([0xff; 3]));

/// Draws a layer of numbers, and curves over it.
///
/// # Errors
/// What could not be read.
///
/// # Panics
/// For the layer of motions.
pub fn draw_numbers(of: &PlanePicture, overlay: Option<&Overlay>, size: Size) -> Result<Picture, CellsError> {
    let Layer::Number { drawn, .. } = of.layer else { panic!("motions have no numbers") };
    let sheet = Sheet {
        frame: frame_of(&of.plane()),
        title: of.title(),
        bar: of.legend.then(|| of.layer.title()),
        config: of.configuration().to_string(),
    };
    sheet.draw(size, overlay, |extent| {
        let across = extent.map(|length| length as usize);
        let values = means(of.cells, of.window, &of.layer, across)?;
        let codes = [NOT_COMPUTED, Regime::Inadmissible.code()].map(u32::from);
        let regimes = most(of.cells, of.window, &CELL_FIELDS[0], codes, across)?;
        let [not_there, inadmissible] =
            codes.map(|code| regimes.iter().map(|&regime| regime == Some(code)).collect());
        let apart = vec![
            Apart { which: not_there, paint: NOT_THERE, name: "not computed" },
            Apart::inadmissible(inadmissible),
        ];
        let palette = of.palette.unwrap_or_else(|| Palette::suiting(drawn.spread));
        let bar = Bar::of(&values, drawn.spread, of.range, palette);
        let (undefined, lost) = ((UNDEFINED, drawn.undefined), (LOST, drawn.lost));
        Ok(Numbers { extent, values, apart, bar, undefined, lost })
    })
}

/// What stands around the numbers of a plane.
pub struct Sheet {
    /// The axes.
    pub frame: Frame,
    /// What stands above, in pieces that belong together.
    pub title: Vec<Text>,
    /// What the colour bar says; none where it is left out.
    pub bar: Option<String>,
    /// What it takes to make the picture again.
    pub config: String,
}

impl Sheet {
    /// Draws the numbers that `numbers` gives for a plot of so many pixels, and curves over them.
    ///
    /// # Errors
    /// Those of `numbers`.
    pub fn draw<E>(
        self,
        size: Size,
        overlay: Option<&Overlay>,
        numbers: impl FnOnce([u32; 2]) -> Result<Numbers, E>,
    ) -> Result<Picture, E> {
        let em = size.em();
        let placed = self.place(size);
        let plot = placed.as_ref().map_or(Rect::whole(size), |(placed, _)| placed.plot);
        let numbers = numbers([plot.width as u32, plot.height as u32])?;
        let mut canvas = Canvas::new(size, &self.config);
        canvas.image(plot, &numbers.image(em));
        if let Some(overlay) = overlay {
            overlay.draw(&mut canvas, plot, &self.frame, em);
        }
        let Some((placed, title)) = placed else {
            let enough = size.enough(|size| self.place(size).is_some());
            let parts =
                if self.bar.is_some() { vec!["the axes", "the colour bar"] } else { vec!["the axes"] };
            let left_out = Some(LeftOut { parts, enough });
            return Ok(Picture::new(size, self.config, canvas.finish()).without(left_out));
        };
        self.frame.draw(&mut canvas, &placed, em);
        for (row, line) in title.iter().enumerate() {
            let at = Point { x: plot.x, y: (MARGIN + (row as f64 + 0.5) * TITLE_ROW) * em };
            canvas.text(line, at, Anchor::Start, em, INK);
        }
        if let Some(title) = &self.bar {
            numbers.draw_key(&mut canvas, plot, title, em);
        }
        Ok(Picture::new(size, self.config, canvas.finish()))
    }

    /// The axes and the lines of the title; none where there is no room for axes.
    fn place(&self, size: Size) -> Option<(Placed, Vec<Text>)> {
        let em = size.em();
        let (width, height) = (f64::from(size.width()), f64::from(size.height()));
        let room = width - (2.0 * MARGIN + 7.0) * em;
        let mut title = Text::wrap(self.title.clone(), em, room);
        if title.len() > MOST_TITLE_LINES || title.iter().any(|line| line.width(em) > room) {
            title.clear();
        }
        let top = (MARGIN + title.len() as f64 * TITLE_ROW) * em;
        let right = if self.bar.is_some() { RIGHT } else { 0.0 };
        let space = Rect {
            x: MARGIN * em,
            y: top,
            width: width - (2.0 * MARGIN + right) * em,
            height: height - top - MARGIN * em,
        };
        Some((self.frame.place(space, em, true)?, title))
    }
}

/// The numbers of a plane's cells, or of pixels that show them, the upper row first, and how they are shown.
pub struct Numbers {
    /// How many stand in a row, and how many rows there are.
    pub extent: [u32; 2],
    /// NaN where there is none, infinities as they are.
    pub values: Vec<f32>,
    /// What of them is no number, and not for want of one.
    pub apart: Vec<Apart>,
    /// Their colours; none where no number is finite.
    pub bar: Option<Bar>,
    /// The colour of what has no number, and what it is called.
    pub undefined: (Colour, &'static str),
    /// The colour of minus infinity, and what it is called.
    pub lost: (Colour, &'static str),
}

/// Cells that are shown otherwise than by a number.
pub struct Apart {
    /// Which of the numbers stand for them.
    pub which: Vec<bool>,
    /// What they are painted with.
    pub paint: Paint,
    /// What they are called.
    pub name: &'static str,
}

impl Apart {
    /// Those that would begin beyond a stop.
    pub fn inadmissible(which: Vec<bool>) -> Self {
        let regime = Regime::Inadmissible;
        Apart { which, paint: paint_of(Motion::without_label(regime)), name: regime.name() }
    }
}

impl Numbers {
    /// What one of them is shown as instead.
    fn apart(&self, i: usize) -> Option<&Apart> {
        self.apart.iter().find(|apart| apart.which[i])
    }

    fn image(&self, em: f64) -> RgbImage {
        let ([width, height], hatch) = (self.extent, Hatch::new(em));
        RgbImage::from_fn(width, height, |x, y| {
            let i = y as usize * width as usize + x as usize;
            if let Some(Apart { paint, .. }) = self.apart(i) {
                return paint.at(x, y, hatch);
            }
            let value = f64::from(self.values[i]);
            match &self.bar {
                _ if value == f64::NEG_INFINITY => self.lost.0,
                Some(bar) if value.is_finite() => bar.colour(value),
                _ => self.undefined.0,
            }
        })
    }

    /// The bar over samples of what is not on it.
    fn draw_key(&self, canvas: &mut Canvas, plot: Rect, title: &str, em: f64) {
        let any = |wanted: fn(f32) -> bool| {
            self.values.iter().enumerate().any(|(i, &value)| wanted(value) && self.apart(i).is_none())
        };
        let mut samples: Vec<(Paint, &str)> = Vec::new();
        let plain = |(colour, name)| (Paint::plain(colour), name);
        let [below, above] = self.bar.as_ref().map_or([false; 2], |bar| bar.beyond(&self.values));
        samples.extend(above.then_some(plain((Palette::beyond(true), "above the bar"))));
        samples.extend(below.then_some(plain((Palette::beyond(false), "below the bar"))));
        samples.extend(any(|value| value == f32::NEG_INFINITY).then_some(plain(self.lost)));
        samples.extend(any(f32::is_nan).then_some(plain(self.undefined)));
        let shown = self.apart.iter().filter(|apart| apart.which.contains(&true));
        samples.extend(shown.map(|apart| (apart.paint, apart.name)));
        let left = (plot.right() + GAP * em).round();
        let taken = draw_samples(canvas, Point { x: left, y: plot.bottom() }, &samples, em);
        let height = (plot.height - taken - 0.6 * em).round();
        if let Some(bar) = self.bar.as_ref().filter(|_| height > 4.0 * em) {
            let rect = Rect { x: left, y: plot.y, width: (WIDTH * em).round(), height };
            bar.draw(canvas, rect, title, em);
        }
    }
}
