//! What is drawn inside a plot, in the coordinates of its scales.

use image::{Rgba, RgbaImage};

use crate::figure::canvas::Canvas;
use crate::figure::frame::Frame;
use crate::figure::plots::clip;
use crate::figure::shapes::{Colour, Point, Rect};

/// More dots than this are drawn as pixels, so that the file stays small.
const MOST_DISCS: usize = 20_000;
/// How far apart the points of a line are at least, in pixels.
const STEP: f64 = 0.4;

/// Something drawn inside a plot. Lengths other than coordinates are in em.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A line through points; a NaN interrupts it.
    Line {
        /// Where it goes.
        points: Vec<[f64; 2]>,
        /// Its width.
        width: f64,
        /// Its colour.
        colour: Colour,
    },
    /// Dots.
    Dots {
        /// Where they are.
        points: Vec<[f64; 2]>,
        /// Their diameter.
        diameter: f64,
        /// Their colour.
        colour: Colour,
    },
    /// A band over the whole height, from one x to another; at least a line's width wide.
    Band {
        /// Its first and last x.
        x: [f64; 2],
        /// Its colour.
        colour: Colour,
    },
    /// A level over the whole width.
    Level {
        /// Its y.
        y: f64,
        /// Its width.
        width: f64,
        /// Its colour.
        colour: Colour,
    },
    /// An upright line over the whole height.
    Upright {
        /// Its x.
        x: f64,
        /// Its width.
        width: f64,
        /// Its colour.
        colour: Colour,
    },
}

impl Mark {
    /// Whether any of it is seen between the axes of a frame; a line is if one of its points is.
    pub fn is_in(&self, frame: &Frame) -> bool {
        match self {
            Mark::Line { points, .. } | Mark::Dots { points, .. } => {
                points.iter().any(|&[x, y]| frame.x.shows(x) && frame.y.shows(y))
            }
            Mark::Band { x: [from, until], .. } => {
                let (a, b) = (frame.x.fraction(*from), frame.x.fraction(*until));
                a.min(b) < 1.0 && a.max(b) > 0.0
            }
            Mark::Level { y, .. } => frame.y.shows(*y),
            Mark::Upright { x, .. } => frame.x.shows(*x),
        }
    }
}

/// A plot that marks are drawn into.
pub(crate) struct Plot<'a> {
    pub frame: &'a Frame,
    pub rect: Rect,
    pub em: f64,
}

impl Plot<'_> {
    /// Where a pair of values is.
    pub fn at(&self, [x, y]: [f64; 2]) -> Point {
        Point {
            x: self.rect.x + self.frame.x.fraction(x) * self.rect.width,
            y: self.rect.bottom() - self.frame.y.fraction(y) * self.rect.height,
        }
    }

    /// Draws a mark, cut off at the edges of the plot.
    pub fn draw(&self, canvas: &mut Canvas, mark: &Mark) {
        match mark {
            Mark::Line { points, width, colour } => {
                let places = points.iter().map(|&point| self.at(point));
                for part in clip::polyline(self.rect, places, STEP) {
                    canvas.stroke(&part, width * self.em, *colour, &[]);
                }
            }
            Mark::Dots { points, diameter, colour } => self.dots(canvas, points, diameter * self.em, *colour),
            Mark::Band { x: [from, until], colour } => self.band(canvas, *from, *until, *colour),
            Mark::Level { y, width, colour } => {
                let at = self.at([0.0, *y]).y;
                if (self.rect.y..=self.rect.bottom()).contains(&at) {
                    let ends = (Point { x: self.rect.x, y: at }, Point { x: self.rect.right(), y: at });
                    canvas.lines(&[ends], width * self.em, *colour);
                }
            }
            Mark::Upright { x, width, colour } => {
                let at = self.at([*x, 0.0]).x;
                if (self.rect.x..=self.rect.right()).contains(&at) {
                    let ends = (Point { x: at, y: self.rect.y }, Point { x: at, y: self.rect.bottom() });
                    canvas.lines(&[ends], width * self.em, *colour);
                }
            }
        }
    }

    fn band(&self, canvas: &mut Canvas, from: f64, until: f64, colour: Colour) {
        let (a, b) = (self.at([from, 0.0]).x, self.at([until, 0.0]).x);
        let left = a.min(b).max(self.rect.x);
        let right = a.max(b).max(left + 1.0).min(self.rect.right());
        if right > left {
            let (y, height) = (self.rect.y, self.rect.height);
            canvas.fill(Rect { x: left, y, width: right - left, height }, colour);
        }
    }

    fn dots(&self, canvas: &mut Canvas, points: &[[f64; 2]], diameter: f64, colour: Colour) {
        let inside = points.iter().map(|&point| self.at(point)).filter(|&at| clip::contains(self.rect, at));
        if points.len() <= MOST_DISCS {
            canvas.dots(&inside.collect::<Vec<_>>(), diameter, colour);
            return;
        }
        let (width, height) = (self.rect.width as u32, self.rect.height as u32);
        let mut image = RgbaImage::new(width, height);
        let side = (diameter.round() as u32).max(1);
        let [r, g, b] = colour.0;
        for at in inside {
            let corner = |value: f64| (value - f64::from(side - 1) / 2.0).floor().max(0.0) as u32;
            let (left, top) = (corner(at.x - self.rect.x), corner(at.y - self.rect.y));
            for y in top..(top + side).min(height) {
                for x in left..(left + side).min(width) {
                    image.put_pixel(x, y, Rgba([r, g, b, u8::MAX]));
                }
            }
        }
        canvas.image(self.rect, &image);
    }
}
