//! A colour bar: from numbers to colours, its ticks, and the samples of what has no number.

use image::RgbImage;

use super::canvas::Canvas;
use super::frame::{fitting_ticks, line_width};
use super::ink::{INK, MUTED};
use super::paint::Paint;
use super::palette::Palette;
use super::scale::Scale;
use super::shapes::{Anchor, Colour, Point, Rect};
use super::spread::Spread;

/// The width of a bar, and the height of a row of samples below it, in em.
pub const WIDTH: f64 = 1.2;
const SAMPLE_ROW: f64 = 1.5;
/// What lies outside these shares of the numbers does not stretch a bar that it would more than double.
const OUTLIERS: f64 = 0.001;
/// A bar of equal ratios spans at least this one.
const NARROW: f64 = 2.0;

/// A colour bar, in one part, or in two that meet at zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    palette: Palette,
    /// The parts upwards, each with the shares of the palette and of the bar that it takes.
    parts: Vec<(Scale, [f64; 2])>,
}

impl Bar {
    /// The bar of some numbers, or of a range; none where there are no numbers.
    pub fn of(values: &[f32], spread: Spread, range: Option<[f64; 2]>, palette: Palette) -> Option<Self> {
        let fits = |value: f64| value.is_finite() && (spread != Spread::Ratios || value > 0.0);
        let [low, high] = match range {
            Some(range) => range,
            None => ends(values.iter().map(|&value| f64::from(value)).filter(|&value| fits(value)), spread)?,
        };
        let parts = match spread {
            Spread::Ratios if low > 0.0 => vec![(Scale::logarithmic(low, high), [0.0, 1.0])],
            Spread::AboutZero if low < 0.0 && high > 0.0 => {
                vec![(Scale::new(low, 0.0), [0.0, 0.5]), (Scale::new(0.0, high), [0.5, 1.0])]
            }
            Spread::AboutZero if low < 0.0 => vec![(Scale::new(low, high), [0.0, 0.5])],
            Spread::AboutZero => vec![(Scale::new(low, high), [0.5, 1.0])],
            Spread::Even | Spread::Ratios => vec![(Scale::new(low, high), [0.0, 1.0])],
        };
        Some(Bar { palette, parts })
    }

    /// Its parts upwards, each with the shares of the palette that it takes.
    pub fn parts(&self) -> &[(Scale, [f64; 2])] {
        &self.parts
    }

    /// The shares of the palette at its ends.
    pub fn shares(&self) -> Option<(f64, f64)> {
        Some((self.parts.first()?.1[0], self.parts.last()?.1[1]))
    }

    /// Its colours.
    pub fn palette(&self) -> Palette {
        self.palette
    }

    fn ends(&self) -> [f64; 2] {
        let of = |part: Option<&(Scale, [f64; 2])>, end: usize| {
            part.map_or(f64::NAN, |(scale, _)| scale.ends()[end])
        };
        [of(self.parts.first(), 0), of(self.parts.last(), 1)]
    }

    /// The colour of a number.
    pub fn colour(&self, value: f64) -> Colour {
        let [low, high] = self.ends();
        if value < low || value > high {
            return Palette::beyond(value > high);
        }
        let part = self.parts.iter().find(|(scale, _)| value <= scale.ends()[1]).or(self.parts.last());
        let Some((scale, [from, to])) = part else { return self.palette.colour(0.0) };
        self.palette.colour(from + scale.fraction(value) * (to - from))
    }

    /// Whether some of the numbers lie below the bar, or above it.
    pub fn beyond(&self, values: &[f32]) -> [bool; 2] {
        let [low, high] = self.ends();
        let finite = || values.iter().map(|&value| f64::from(value)).filter(|value| value.is_finite());
        [finite().any(|value| value < low), finite().any(|value| value > high)]
    }

    /// Draws the bar into a rectangle, with its numbers and its title at the right.
    pub fn draw(&self, canvas: &mut Canvas, bar: Rect, title: &str, em: f64) {
        let line = line_width(em);
        let count = self.parts.len() as f64;
        let mut bottom = bar.bottom();
        let mut shown = f64::INFINITY;
        for (scale, [from, to]) in &self.parts {
            let height = bar.height / count;
            let part = Rect { y: bottom - height, height, ..bar };
            let steps = 256;
            let gradient = RgbImage::from_fn(1, steps, |_, y| {
                let share = 1.0 - f64::from(y) / f64::from(steps - 1);
                self.palette.colour(from + share * (to - from))
            });
            canvas.image(part, &gradient);
            let ticks = fitting_ticks(*scale, part.height, |_| 1.5 * em);
            let y = |value: f64| part.bottom() - scale.fraction(value) * part.height;
            let tick = |value: f64, length: f64| {
                let from = Point { x: bar.right(), y: y(value) };
                (from, Point { x: from.x + length * em, ..from })
            };
            let mut lines: Vec<(Point, Point)> =
                ticks.labelled.iter().map(|&(value, _)| tick(value, 0.4)).collect();
            lines.extend(ticks.minor.iter().map(|&value| tick(value, 0.2)));
            canvas.lines(&lines, line, INK);
            for (value, label) in &ticks.labelled {
                let unit = match ticks.exponent {
                    0 => label.clone(),
                    power => format!("{label}e{power}").replace("e-", "e−"),
                };
                let at = Point { x: bar.right() + 0.7 * em, y: y(*value) };
                // Where the two parts meet, zero is written only once.
                if (at.y - shown).abs() > 0.8 * em {
                    canvas.text(&unit.as_str().into(), at, Anchor::Start, em, INK);
                    shown = at.y;
                }
            }
            bottom -= height;
        }
        canvas.outline(bar, line, INK);
        let middle = Point { x: bar.right() + 5.4 * em, y: bar.y + bar.height / 2.0 };
        canvas.rising_text(&title.into(), middle, Anchor::Middle, 1.1 * em, INK);
    }
}

/// The least and the greatest number, without outliers that would stretch the bar, made different.
fn ends(values: impl Iterator<Item = f64>, spread: Spread) -> Option<[f64; 2]> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let (&low, &high) = (sorted.first()?, sorted.last()?);
    if spread == Spread::Ratios {
        if high >= NARROW * low {
            return Some([low, high]);
        }
        let (below, above) = (low.log10().floor(), high.log10().ceil());
        return Some([10_f64.powf(below), 10_f64.powf(above.max(below + 1.0))]);
    }
    let at = |share: f64| sorted[((sorted.len() - 1) as f64 * share).round() as usize];
    let (usual_low, usual_high) = (at(OUTLIERS), at(1.0 - OUTLIERS));
    let [low, high] = if high - low > 2.0 * (usual_high - usual_low) && usual_high > usual_low {
        [usual_low, usual_high]
    } else {
        [low, high]
    };
    match high - low > 1e-9 * low.abs().max(high.abs()) {
        true => Some([low, high]),
        false => Some([low - 0.05 * low.abs().max(1.0), high + 0.05 * high.abs().max(1.0)]),
    }
}

/// Draws samples of paints with what they stand for, upwards from the lower end of a plot; gives the height that they take.
pub fn draw_samples(canvas: &mut Canvas, at: Point, samples: &[(Paint, &str)], em: f64) -> f64 {
    let (line, width) = (line_width(em), (WIDTH * em).round());
    let mut bottom = at.y;
    for (paint, name) in samples.iter().rev() {
        let swatch = Rect { x: at.x, y: bottom - 1.2 * em, width, height: (0.9 * em).round() };
        canvas.paint(swatch, *paint, em);
        canvas.outline(swatch, line, INK);
        let beside = Point { x: swatch.right() + 0.7 * em, y: swatch.y + swatch.height / 2.0 };
        canvas.text(&(*name).into(), beside, Anchor::Start, 0.9 * em, MUTED);
        bottom -= SAMPLE_ROW * em;
    }
    at.y - bottom
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bar(values: &[f32], spread: Spread) -> Bar {
        Bar::of(values, spread, None, Palette::suiting(spread)).unwrap()
    }

    #[test]
    fn zero_is_in_the_middle_of_what_lies_about_it() {
        let bar = bar(&[-3.0, -1.0, 0.2, 0.4], Spread::AboutZero);
        assert_eq!(bar.ends(), [-3.0, f64::from(0.4_f32)]);
        let palette = Palette::suiting(Spread::AboutZero);
        assert_eq!(bar.colour(0.0), palette.colour(0.5));
        assert_eq!((bar.colour(-3.0), bar.colour(-1.5)), (palette.colour(0.0), palette.colour(0.25)));
        let negative = self::bar(&[-3.0, -1.0], Spread::AboutZero);
        assert_eq!(negative.colour(-3.0), palette.colour(0.0));
    }

    #[test]
    fn outliers_are_beyond_the_bar_and_told_apart() {
        let mut values: Vec<f32> = (0..10_000).map(|i| i as f32 / 10_000.0).collect();
        values.extend([1e6, -1e6]);
        let even = bar(&values, Spread::Even);
        let [low, high] = even.ends();
        assert!(low > -0.1 && high < 1.1, "{low} to {high}");
        assert_eq!(even.beyond(&values), [true, true]);
        assert_eq!(even.colour(1e6), Palette::beyond(true));
        assert_eq!(even.colour(-1e6), Palette::beyond(false));
        assert_eq!(bar(&[0.1, 0.2, f32::NAN], Spread::Even).beyond(&[0.1, f32::NAN]), [false, false]);
    }

    #[test]
    fn equal_numbers_and_none_have_bars_too() {
        assert_eq!(bar(&[2.0, 2.0], Spread::Ratios).ends(), [1.0, 10.0]);
        assert_eq!(bar(&[99.0, 101.0], Spread::Ratios).ends(), [10.0, 1000.0]);
        assert_eq!(bar(&[3.0, 1200.0], Spread::Ratios).ends(), [3.0, 1200.0]);
        let [low, high] = bar(&[0.0, 0.0], Spread::Even).ends();
        assert!(low < 0.0 && high > 0.0);
        assert!(Bar::of(&[f32::NAN], Spread::Even, None, Palette::suiting(Spread::Even)).is_none());
        assert!(Bar::of(&[0.0, -1.0], Spread::Ratios, None, Palette::suiting(Spread::Even)).is_none());
    }
}
