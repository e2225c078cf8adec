//! What a region is filled with.

use super::shapes::{Colour, Point, Rect};

/// A fill, plain or hatched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// The colour of the ground.
    pub fill: Colour,
    /// The colour of rising lines over it, if any.
    pub hatch: Option<Colour>,
}

impl Paint {
    /// A paint of one colour.
    pub const fn plain(fill: Colour) -> Self {
        Paint { fill, hatch: None }
    }

    /// A ground with rising lines over it.
    pub const fn hatched(fill: Colour, hatch: Colour) -> Self {
        Paint { fill, hatch: Some(hatch) }
    }

    /// The colour at a pixel of an image.
    pub(crate) fn at(&self, x: u32, y: u32, hatch: Hatch) -> Colour {
        self.hatch.filter(|_| hatch.covers(x, y)).unwrap_or(self.fill)
    }
}

/// The rising lines of a hatch: the points where x + y is a multiple of the spacing, and a little more.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hatch {
    spacing: u32,
    thickness: u32,
}

impl Hatch {
    /// The hatch that suits a text size.
    pub fn new(em: f64) -> Self {
        let thickness = (0.13 * em).round().max(1.0) as u32;
        Hatch { spacing: (0.5 * em).round() as u32 + thickness, thickness }
    }

    /// The spacing and the thickness, in pixels.
    pub fn lengths(self) -> [u32; 2] {
        [self.spacing, self.thickness]
    }

    /// The width of a line.
    pub fn width(self) -> f64 {
        f64::from(self.thickness) / std::f64::consts::SQRT_2
    }

    /// The lines of the hatch inside a rectangle.
    pub fn lines(self, rect: Rect) -> Vec<(Point, Point)> {
        let spacing = f64::from(self.spacing);
        let first = ((rect.x + rect.y) / spacing).ceil() as i64;
        let last = ((rect.right() + rect.bottom()) / spacing).floor() as i64;
        (first..=last)
            .map(|line| {
                let sum = line as f64 * spacing;
                let left = rect.x.max(sum - rect.bottom());
                let right = rect.right().min(sum - rect.y);
                (Point { x: left, y: sum - left }, Point { x: right, y: sum - right })
            })
            .collect()
    }

    fn covers(self, x: u32, y: u32) -> bool {
        (x + y) % self.spacing < self.thickness
    }
}

#[cfg(test)]
mod tests {
    use image::Rgb;

    use super::*;

    #[test]
    fn hatch_lines_stay_inside() {
        let rect = Rect { x: 10.0, y: 20.0, width: 30.0, height: 12.0 };
        let lines = Hatch::new(12.0).lines(rect);
        assert!(lines.len() > 3);
        for point in lines.into_iter().flat_map(|(a, b)| [a, b]) {
            assert!((rect.x..=rect.right()).contains(&point.x), "{point:?}");
            assert!((rect.y..=rect.bottom()).contains(&point.y), "{point:?}");
        }
    }

    #[test]
    fn a_hatch_shows_both_colours() {
        let (ground, line) = (Rgb([200; 3]), Rgb([0; 3]));
        for em in [9.5, 20.0, 140.0] {
            let hatch = Hatch::new(em);
            let seen: Vec<Colour> = (0..200).map(|x| Paint::hatched(ground, line).at(x, 7, hatch)).collect();
            let lines = seen.iter().filter(|&&colour| colour == line).count();
            assert!((20..80).contains(&lines), "{em}: {lines}");
            assert!((0..200).all(|x| Paint::plain(ground).at(x, 7, hatch) == ground));
        }
    }
}
