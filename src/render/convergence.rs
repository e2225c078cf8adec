//! How long control takes, cell by cell: iterates to convergence on a logarithmic colour scale.

use image::{Rgb, RgbImage};

use super::canvas::{Anchor, Canvas, Colour, Point, Rect};
use super::colours::{INK, MUTED, paint_of};
use super::frame::line_width;
use super::motion::Motion;
use super::picture::Picture;
use super::regions::{control_title, frame_of};
use super::size::Size;
use super::symbols;
use super::text::Text;
use crate::analysis::Regime;
use crate::control::NEVER;
use crate::plane::ControlMap;

/// The lengths of the picture, in em.
const MARGIN: f64 = 1.0;
const TITLE_ROW: f64 = 1.4;
const BAR: f64 = 1.2;
const GAP: f64 = 1.3;
/// What the bar, its labels and its words take at the right.
const RIGHT: f64 = 9.5;

/// Dark to light, of even steps of lightness to every eye.
const RAMP: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 44, 122],
    [59, 81, 139],
    [44, 113, 142],
    [33, 144, 141],
    [39, 173, 129],
    [92, 200, 99],
    [170, 220, 50],
    [253, 231, 37],
];

/// Draws how many iterates each cell of a plane took from switching control on until its points kept returning.
///
/// Cells that did not come to return are grey.
pub fn convergence_map(map: &ControlMap, size: Size) -> Picture {
    let em = size.em();
    let config = map.config();
    let mut canvas = Canvas::new(size, &config);
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let title = Text::wrap(control_title(map), em, width - (2.0 * MARGIN + 7.0) * em);
    let top = (MARGIN + title.len() as f64 * TITLE_ROW) * em;
    let space = Rect {
        x: MARGIN * em,
        y: top,
        width: width - (2.0 * MARGIN + RIGHT) * em,
        height: height - top - MARGIN * em,
    };
    let frame = frame_of(&map.plane.plane());
    let longest = map.outcomes.iter().map(|outcome| outcome.converged_at).filter(|&n| n != NEVER).max();
    let scale = LogScale { most: f64::from(longest.unwrap_or(9).max(9)) + 1.0 };
    let Some(placed) = frame.place(space, em, true) else {
        let whole = Rect { x: 0.0, y: 0.0, width, height };
        canvas.image(whole, &cells(map, &scale));
        return Picture::new(size, config, canvas.finish());
    };
    canvas.image(placed.plot, &cells(map, &scale));
    frame.draw(&mut canvas, &placed, em);
    for (row, line) in title.iter().enumerate() {
        let at = Point { x: placed.plot.x, y: (MARGIN + (row as f64 + 0.5) * TITLE_ROW) * em };
        canvas.text(line, at, Anchor::Start, em, INK);
    }
    draw_bar(&mut canvas, placed.plot, &scale, em);
    Picture::new(size, config, canvas.finish())
}

/// A logarithmic scale from 1 to `most`.
struct LogScale {
    most: f64,
}

impl LogScale {
    /// 0 at 1, 1 at the end.
    fn fraction(&self, value: f64) -> f64 {
        (value.max(1.0).ln() / self.most.ln()).clamp(0.0, 1.0)
    }

    fn colour(&self, value: f64) -> Colour {
        ramp(self.fraction(value))
    }

    /// The numbers of iterates beside the bar: none, powers of ten, and the most, each `apart` from the others.
    fn labels(&self, apart: f64) -> Vec<f64> {
        let powers = std::iter::successors(Some(10.0), |power| Some(10.0 * power));
        let below =
            powers.take_while(|&power| self.fraction(power + 1.0) <= 1.0 - apart && power < self.most);
        std::iter::once(0.0).chain(below).chain([self.most - 1.0]).collect()
    }
}

fn ramp(fraction: f64) -> Colour {
    let place = fraction * (RAMP.len() - 1) as f64;
    let i = (place as usize).min(RAMP.len() - 2);
    let share = place - i as f64;
    Rgb(std::array::from_fn(|c| {
        let (a, b) = (f64::from(RAMP[i][c]), f64::from(RAMP[i + 1][c]));
        (a + share * (b - a)).round() as u8
    }))
}

/// The cells, one pixel each, the first row at the bottom.
fn cells(map: &ControlMap, scale: &LogScale) -> RgbImage {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    let none = unconverged();
    RgbImage::from_fn(columns, rows, |x, y| {
        let index = (rows - 1 - y) as usize * columns as usize + x as usize;
        match map.outcomes[index].converged_at {
            NEVER => none,
            iterates => scale.colour(f64::from(iterates) + 1.0),
        }
    })
}

fn unconverged() -> Colour {
    paint_of(Motion { regime: Regime::Unresolved, counts: [0; 3], symmetric: false }).fill
}

fn draw_bar(canvas: &mut Canvas, plot: Rect, scale: &LogScale, em: f64) {
    let line = line_width(em);
    let below = 3.0 * em;
    let bar = Rect {
        x: (plot.right() + GAP * em).round(),
        y: plot.y,
        width: (BAR * em).round(),
        height: (plot.height - below).round().max(em),
    };
    let steps = 256;
    let gradient = RgbImage::from_fn(1, steps, |_, y| ramp(1.0 - f64::from(y) / f64::from(steps - 1)));
    canvas.image(bar, &gradient);
    canvas.outline(bar, line, INK);
    let label = |canvas: &mut Canvas, value: f64| {
        let y = bar.bottom() - scale.fraction(value + 1.0) * bar.height;
        let ends = (Point { x: bar.right(), y }, Point { x: bar.right() + 0.4 * em, y });
        canvas.lines(&[ends], line, INK);
        let at = Point { x: bar.right() + 0.7 * em, y };
        canvas.text(&symbols::number(value).into(), at, Anchor::Start, em, INK);
    };
    for value in scale.labels(1.5 * em / bar.height) {
        label(canvas, value);
    }
    let middle = Point { x: bar.right() + 5.2 * em, y: bar.y + bar.height / 2.0 };
    canvas.rising_text(&"iterates to convergence".into(), middle, Anchor::Middle, 1.1 * em, INK);
    let swatch = Rect { x: bar.x, y: plot.bottom() - 1.2 * em, width: bar.width, height: (0.9 * em).round() };
    canvas.fill(swatch, unconverged());
    canvas.outline(swatch, line, INK);
    let at = Point { x: bar.right() + 0.7 * em, y: swatch.y + swatch.height / 2.0 };
    canvas.text(&"not reached".into(), at, Anchor::Start, 0.9 * em, MUTED);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_rises_from_dark_to_light() {
        let scale = LogScale { most: 1000.0 };
        assert_eq!((scale.colour(1.0), scale.colour(1000.0)), (Rgb(RAMP[0]), Rgb(RAMP[8])));
        let lightness = |Rgb([r, g, b]): Colour| 2 * u32::from(r) + 7 * u32::from(g) + u32::from(b);
        let steps: Vec<u32> = (0..20).map(|i| lightness(ramp(f64::from(i) / 19.0))).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }

    #[test]
    fn both_ends_of_the_bar_are_labelled() {
        assert_eq!(LogScale { most: 10.0 }.labels(0.05), [0.0, 9.0]);
        assert_eq!(LogScale { most: 1300.0 }.labels(0.05), [0.0, 10.0, 100.0, 1299.0]);
        assert_eq!(LogScale { most: 4000.0 }.labels(0.05), [0.0, 10.0, 100.0, 1000.0, 3999.0]);
    }
}
