//! The regions in pixels.

use image::RgbImage;
use rayon::prelude::*;

use super::bands::sampled;
use super::census::Census;
use crate::figure::{Colour, Hatch, INK, line_width};
use crate::plane::Window;
use crate::plane::fields::{Cells, CellsError};

/// How dark the line between two regions is.
const LINE_OPACITY: f64 = 0.8;
/// A line is drawn only between regions that are this many times as wide as the line.
const WORTH_A_LINE: usize = 4;

/// Draws the regions of a window of a plane into an image of the given size, the first row at the bottom.
///
/// # Errors
/// What could not be read.
pub(super) fn draw(
    cells: &dyn Cells,
    window: Window,
    census: &Census,
    [width, height]: [u32; 2],
    em: f64,
) -> Result<RgbImage, CellsError> {
    let pixels = Pixels::sample(cells, window, census, [width as usize, height as usize])?;
    let hatch = Hatch::new(em);
    let line = line_width(em) as usize;
    let mut bytes = vec![0; 3 * pixels.width * pixels.height];
    bytes.par_chunks_exact_mut(3 * pixels.width).enumerate().for_each(|(y, row)| {
        for (x, pixel) in row.chunks_exact_mut(3).enumerate() {
            let paint = census.regions[pixels.at(x, y) as usize].paint;
            let mut colour = paint.at(x as u32, y as u32, hatch);
            if pixels.on_line(x, y, line) {
                colour = darkened(colour);
            }
            pixel.copy_from_slice(&colour.0);
        }
    });
    Ok(RgbImage::from_raw(width, height, bytes).expect("three bytes for each pixel"))
}

/// The region of each pixel.
struct Pixels {
    width: usize,
    height: usize,
    regions: Vec<u32>,
}

impl Pixels {
    fn sample(
        cells: &dyn Cells,
        window: Window,
        census: &Census,
        size: [usize; 2],
    ) -> Result<Self, CellsError> {
        let read = |band| census.regions_of(cells, band);
        let regions = sampled(cells, window, size, read, most_frequent)?;
        let [width, height] = size;
        Ok(Pixels { width, height, regions })
    }

    fn at(&self, x: usize, y: usize) -> u32 {
        self.regions[y * self.width + x]
    }

    /// Whether a line between two regions, `line` pixels wide, covers a pixel.
    fn on_line(&self, x: usize, y: usize, line: usize) -> bool {
        let across = |i: usize| self.at(i, y);
        let down = |i: usize| self.at(x, i);
        near_border(across, self.width, x, line) || near_border(down, self.height, y, line)
    }
}

/// Whether position `at` is covered by a line over a border along one row or column.
fn near_border(region: impl Fn(usize) -> u32, length: usize, at: usize, line: usize) -> bool {
    let before = line - line / 2;
    let first = (at + 1).saturating_sub(before).max(1);
    let last = (at + line / 2).min(length - 1);
    let border = |i: usize| {
        let (a, b) = (region(i - 1), region(i));
        let reach = WORTH_A_LINE * line;
        a != b
            && (i.saturating_sub(reach)..i).all(|j| region(j) == a)
            && (i..(i + reach).min(length)).all(|j| region(j) == b)
    };
    (first..=last).any(border)
}

/// The most frequent region; of equally frequent ones the one that is larger in the whole plane.
fn most_frequent(block: &mut dyn Iterator<Item = u32>) -> u32 {
    let first = block.next().expect("a pixel shows at least one cell");
    let mut counts: Vec<(u32, u32)> = vec![(first, 1)];
    for region in block {
        match counts.iter_mut().find(|(known, _)| *known == region) {
            Some((_, count)) => *count += 1,
            None => counts.push((region, 1)),
        }
    }
    let most = counts.into_iter().max_by_key(|&(region, count)| (count, std::cmp::Reverse(region)));
    most.expect("a pixel shows at least one cell").0
}

fn darkened(colour: Colour) -> Colour {
    let mut mixed = colour;
    for (channel, ink) in mixed.0.iter_mut().zip(INK.0) {
        *channel = (LINE_OPACITY * f64::from(ink) + (1.0 - LINE_OPACITY) * f64::from(*channel)).round() as u8;
    }
    mixed
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{Regime, Verdict};
    use crate::plane::RegionMap;
    use crate::render::{Motion, example, paint_of};

    fn colour(map: &RegionMap, column: u32, row: u32) -> Colour {
        paint_of(Motion::of(map.at(column, row))).fill
    }

    fn drawn(map: &RegionMap, size: [u32; 2]) -> RgbImage {
        let whole = Window::whole(&map.plane);
        draw(map, whole, &Census::of(map, whole).unwrap(), size, 10.0).unwrap()
    }

    #[test]
    fn the_first_row_is_at_the_bottom() {
        let left = Verdict::of_motion(Regime::Periodic, [1, 1, 1], true);
        let right = Verdict::of_motion(Regime::Chaotic, [0; 3], false);
        let above = Verdict::of_motion(Regime::NoImpact, [0; 3], false);
        let map = example::of(2, 2, |column, row| match (column, row) {
            (0, 0) => left,
            (1, 0) => right,
            _ => above,
        });
        let image = drawn(&map, [80, 60]);
        assert_eq!(*image.get_pixel(20, 45), colour(&map, 0, 0));
        assert_eq!(*image.get_pixel(60, 45), colour(&map, 1, 0));
        assert_eq!(*image.get_pixel(20, 15), colour(&map, 0, 1));
        assert_eq!(*image.get_pixel(40, 45), darkened(colour(&map, 1, 0)), "a line between two regions");
        assert_eq!(*image.get_pixel(40, 15), colour(&map, 1, 1), "no line inside a region");
    }

    #[test]
    fn a_thin_region_is_not_hidden_by_lines() {
        let thin = Verdict::of_motion(Regime::Chaotic, [0; 3], false);
        let wide = Verdict::of_motion(Regime::Periodic, [1, 1, 1], true);
        let map = example::of(100, 10, |column, _| if column == 50 { thin } else { wide });
        let image = drawn(&map, [200, 100]);
        let shown = (0..200).filter(|&x| *image.get_pixel(x, 50) == colour(&map, 50, 0)).count();
        assert_eq!(shown, 2);
    }

    #[test]
    fn a_small_picture_shows_the_most_frequent() {
        let rare = Verdict::of_motion(Regime::Chaotic, [0; 3], false);
        let common = Verdict::of_motion(Regime::Periodic, [1, 1, 1], true);
        let map =
            example::of(400, 300, |column, row| if column % 4 == 0 && row % 3 == 0 { rare } else { common });
        let image = drawn(&map, [100, 100]);
        assert!(image.pixels().all(|&pixel| pixel == colour(&map, 1, 1)));
    }
}
