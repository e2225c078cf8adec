//! Colours, and places on a picture.

use image::Rgb;

use super::size::Size;

/// An opaque colour, sRGB.
pub type Colour = Rgb<u8>;

/// A point in pixels, from the upper left corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// To the right.
    pub x: f64,
    /// Down.
    pub y: f64,
}

/// An upright rectangle in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left edge.
    pub x: f64,
    /// Upper edge.
    pub y: f64,
    /// Width.
    pub width: f64,
    /// Height.
    pub height: f64,
}

impl Rect {
    /// A whole picture.
    pub fn whole(size: Size) -> Self {
        Rect { x: 0.0, y: 0.0, width: size.width().into(), height: size.height().into() }
    }

    /// Larger on every side.
    #[must_use]
    pub fn grown(self, by: f64) -> Self {
        let Rect { x, y, width, height } = self;
        Rect { x: x - by, y: y - by, width: width + 2.0 * by, height: height + 2.0 * by }
    }

    /// The right edge.
    pub fn right(&self) -> f64 {
        self.x + self.width
    }

    /// The lower edge.
    pub fn bottom(&self) -> f64 {
        self.y + self.height
    }
}

/// Which point of a text is given; by its name in SVG.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Anchor {
    /// Its left end.
    Start,
    /// Its middle.
    Middle,
    /// Its right end.
    End,
}
