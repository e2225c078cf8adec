//! How long control takes, cell by cell: iterates to convergence on a logarithmic colour scale.

use image::{Rgb, RgbImage};

use super::axes::frame_of;
use super::colours::paint_of;
use super::motion::Motion;
use super::regions::control_title;
use crate::analysis::Regime;
use crate::control::NEVER;
use crate::figure::{
    Anchor, Canvas, Colour, INK, LeftOut, MUTED, Picture, Point, Rect, Scale, Size, Text, fitting_ticks,
    line_width,
};
use crate::plane::{Control, RegionMap};

/// The lengths of the picture, in em.
const MARGIN: f64 = 1.0;
const TITLE_ROW: f64 = 1.4;
const BAR: f64 = 1.2;
const GAP: f64 = 1.3;
const SAMPLE_ROW: f64 = 1.5;
/// A range of times that is narrower than this ratio is widened to whole decades.
const NARROW: f64 = 2.0;
/// What the bar, its labels and its words take at the right.
const RIGHT: f64 = 9.5;

/// The colour of cells that took no time: none of the bar's.
const AT_ONCE: Colour = Rgb([255; 3]);

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
/// Cells whose points returned from the first one on, and those that did not come to return, have colours of their own.
pub fn convergence_map(map: &RegionMap<Control>, size: Size) -> Picture {
    let em = size.em();
    let config = map.config();
    let mut canvas = Canvas::new(size, &config);
    let (width, height) = (f64::from(size.width()), f64::from(size.height()));
    let title = title(map, size);
    let space = |size| space(map, size);
    let frame = frame_of(&map.plane);
    let times = Times::of(map.verdicts.iter().map(|outcome| outcome.converged_at));
    let Some(placed) = frame.place(space(size), em, true) else {
        let whole = Rect { x: 0.0, y: 0.0, width, height };
        canvas.image(whole, &cells(map, &times));
        let enough = size.enough(|size| frame.place(space(size), size.em(), true).is_some());
        let left_out = LeftOut { parts: vec!["the axes", "the key"], enough };
        return Picture::new(size, config, canvas.finish()).without(Some(left_out));
    };
    canvas.image(placed.plot, &cells(map, &times));
    frame.draw(&mut canvas, &placed, em);
    for (row, line) in title.iter().enumerate() {
        let at = Point { x: placed.plot.x, y: (MARGIN + (row as f64 + 0.5) * TITLE_ROW) * em };
        canvas.text(line, at, Anchor::Start, em, INK);
    }
    times.draw_key(&mut canvas, placed.plot, em);
    Picture::new(size, config, canvas.finish())
}

/// The lines of the title.
fn title(map: &RegionMap<Control>, size: Size) -> Vec<Text> {
    let em = size.em();
    Text::wrap(control_title(map), em, f64::from(size.width()) - (2.0 * MARGIN + 7.0) * em)
}

/// The space of the plot and its axes: below the title, beside the bar.
fn space(map: &RegionMap<Control>, size: Size) -> Rect {
    let em = size.em();
    let top = (MARGIN + title(map, size).len() as f64 * TITLE_ROW) * em;
    Rect {
        x: MARGIN * em,
        y: top,
        width: f64::from(size.width()) - (2.0 * MARGIN + RIGHT) * em,
        height: f64::from(size.height()) - top - MARGIN * em,
    }
}

/// What there is to be shown of some convergence times.
#[derive(Clone, Debug, PartialEq)]
struct Times {
    /// From the shortest to the longest that is not 0, and at least over a decade where they are nearly alike.
    scale: Option<Scale>,
    /// Whether some are 0.
    at_once: bool,
    /// Whether some cells have none.
    never: bool,
}

impl Times {
    fn of(times: impl Iterator<Item = u32> + Clone) -> Self {
        let there = times.clone().filter(|&time| time != NEVER && time > 0);
        let ends = there.clone().min().zip(there.max());
        let scale = ends.map(|(shortest, longest)| {
            let (low, high) = (f64::from(shortest), f64::from(longest));
            if high >= NARROW * low {
                return Scale::logarithmic(low, high);
            }
            let (below, above) = (low.log10().floor() as i32, high.log10().ceil() as i32);
            Scale::logarithmic(10_f64.powi(below), 10_f64.powi(above.max(below + 1)))
        });
        Times {
            scale,
            at_once: times.clone().any(|time| time == 0),
            never: times.clone().any(|t| t == NEVER),
        }
    }

    fn colour(&self, time: u32) -> Colour {
        match (time, &self.scale) {
            (NEVER, _) | (_, None) if time != 0 => unconverged(),
            (0, _) | (_, None) => AT_ONCE,
            (time, Some(scale)) => ramp(scale.fraction(f64::from(time)).clamp(0.0, 1.0)),
        }
    }

    /// Draws the bar, if there is anything to be read from it, over samples of what is not on it.
    fn draw_key(&self, canvas: &mut Canvas, plot: Rect, em: f64) {
        let line = line_width(em);
        let left = (plot.right() + GAP * em).round();
        let width = (BAR * em).round();
        let samples = [(self.at_once, AT_ONCE, "0, at once"), (self.never, unconverged(), "not reached")];
        let mut bottom = plot.bottom();
        for (_, colour, name) in samples.into_iter().filter(|(shown, ..)| *shown).rev() {
            let swatch = Rect { x: left, y: bottom - 1.2 * em, width, height: (0.9 * em).round() };
            canvas.fill(swatch, colour);
            canvas.outline(swatch, line, INK);
            let at = Point { x: swatch.right() + 0.7 * em, y: swatch.y + swatch.height / 2.0 };
            canvas.text(&name.into(), at, Anchor::Start, 0.9 * em, MUTED);
            bottom -= SAMPLE_ROW * em;
        }
        let height = (bottom - plot.y - 0.6 * em).round();
        if let Some(scale) = self.scale.filter(|_| height > 4.0 * em) {
            draw_bar(canvas, Rect { x: left, y: plot.y, width, height }, scale, em);
        }
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
fn cells(map: &RegionMap<Control>, times: &Times) -> RgbImage {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    RgbImage::from_fn(columns, rows, |x, y| {
        let index = (rows - 1 - y) as usize * columns as usize + x as usize;
        times.colour(map.verdicts[index].converged_at)
    })
}

fn unconverged() -> Colour {
    paint_of(Motion { regime: Regime::Unresolved, counts: [0; 5], symmetric: false }).fill
}

/// Draws a bar of all colours with the numbers of iterates beside it.
fn draw_bar(canvas: &mut Canvas, bar: Rect, scale: Scale, em: f64) {
    let line = line_width(em);
    let steps = 256;
    let gradient = RgbImage::from_fn(1, steps, |_, y| ramp(1.0 - f64::from(y) / f64::from(steps - 1)));
    canvas.image(bar, &gradient);
    canvas.outline(bar, line, INK);
    let ticks = fitting_ticks(scale, bar.height, |_| 1.5 * em);
    let at = |value: f64| Point { x: bar.right(), y: bar.bottom() - scale.fraction(value) * bar.height };
    let tick = |value: f64, length: f64| (at(value), Point { x: bar.right() + length * em, ..at(value) });
    let mut lines: Vec<(Point, Point)> = ticks.labelled.iter().map(|&(value, _)| tick(value, 0.4)).collect();
    lines.extend(ticks.minor.iter().map(|&value| tick(value, 0.2)));
    canvas.lines(&lines, line, INK);
    for (value, label) in &ticks.labelled {
        let at = Point { x: bar.right() + 0.7 * em, ..at(*value) };
        canvas.text(&label.as_str().into(), at, Anchor::Start, em, INK);
    }
    let middle = Point { x: bar.right() + 5.2 * em, y: bar.y + bar.height / 2.0 };
    canvas.rising_text(&"iterates to convergence".into(), middle, Anchor::Middle, 1.1 * em, INK);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figure::faults;

    fn times(times: &[u32]) -> Times {
        Times::of(times.iter().copied())
    }

    #[test]
    fn the_scale_rises_from_dark_to_light() {
        let times = times(&[1, 30, 1000]);
        assert_eq!((times.colour(1), times.colour(1000)), (Rgb(RAMP[0]), Rgb(RAMP[8])));
        let lightness = |Rgb([r, g, b]): Colour| 2 * u32::from(r) + 7 * u32::from(g) + u32::from(b);
        let steps: Vec<u32> = (0..20).map(|i| lightness(ramp(f64::from(i) / 19.0))).collect();
        assert!(steps.windows(2).all(|pair| pair[0] < pair[1]), "{steps:?}");
    }

    #[test]
    fn what_has_no_place_on_a_logarithmic_scale_is_apart_from_it() {
        let all = times(&[0, 7, 900, NEVER]);
        assert_eq!(all.scale, Some(Scale::logarithmic(7.0, 900.0)));
        assert!(all.at_once && all.never);
        let (zero, never) = (all.colour(0), all.colour(NEVER));
        assert!(zero != never);
        assert!([7, 80, 900].into_iter().all(|time| ![zero, never].contains(&all.colour(time))));
        let none = times(&[3, 5, 80]);
        assert!(!none.at_once && !none.never);
    }

    #[test]
    fn a_bar_over_next_to_nothing_reaches_over_a_decade() {
        let ends = |all: &[u32]| times(all).scale.map(|scale| scale.ends());
        assert_eq!(ends(&[37, 37]), Some([10.0, 100.0]));
        assert_eq!(ends(&[1]), Some([1.0, 10.0]));
        assert_eq!(ends(&[99, 101]), Some([10.0, 1000.0]));
        assert_eq!(ends(&[NEVER - 1]).map(|[low, _]| low), Some(1e9));
        assert_eq!((ends(&[0, 0]), ends(&[NEVER]), ends(&[])), (None, None, None));
        assert_eq!((times(&[0]).colour(0), times(&[NEVER]).colour(NEVER)), (AT_ONCE, unconverged()));
    }

    #[test]
    fn keys_of_every_kind_are_drawn_whole() {
        let plot = Rect { x: 60.0, y: 30.0, width: 380.0, height: 300.0 };
        let said = |all: &[u32]| {
            let size = Size::new(580, 380).unwrap();
            let mut canvas = Canvas::new(size, "{}");
            times(all).draw_key(&mut canvas, plot, 12.0);
            let picture = Picture::new(size, "{}".into(), canvas.finish());
            assert_eq!(faults(&picture, size), [""; 0], "{all:?}");
            ["iterates to convergence", ">0, at once<", ">not reached<", ">100<"]
                .map(|words| picture.svg().contains(words))
        };
        assert_eq!(said(&[0, 3, 1200, NEVER]), [true; 4]);
        assert_eq!(said(&[3, 1200]), [true, false, false, true]);
        assert_eq!(said(&[37]), [true, false, false, true]);
        assert_eq!(said(&[0]), [false, true, false, false]);
        assert_eq!(said(&[NEVER]), [false, false, true, false]);
    }
}
