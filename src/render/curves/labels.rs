//! Names along curves, where there is room for them.

use super::geometry::{about, crosses, length, overlap, stations, within};
use crate::render::canvas::{Point, Rect};

/// The height of a name's box, in text sizes.
pub(super) const HEIGHT: f64 = 0.95;
/// The room between a name and its line, in text sizes.
const GAP: f64 = 0.28;
/// A line shorter than this many times its name stays without.
const SHORTEST: f64 = 1.5;
/// How far apart the places are that are tried, in text sizes.
const STEP: f64 = 0.4;

/// A name that is wanted at a line.
#[derive(Clone, Debug)]
pub(super) struct Wanted<'a> {
    pub line: &'a [Point],
    pub width: f64,
    pub size: f64,
}

/// Finds a place beside a line for a name: inside the plot, off every line, and apart from what is already placed.
///
/// The place nearest to the middle of the line is taken; none if there is no room anywhere along it.
pub(super) fn place(wanted: &Wanted, plot: Rect, lines: &[&[Point]], taken: &[Rect]) -> Option<Rect> {
    if length(wanted.line) < SHORTEST * wanted.width {
        return None;
    }
    let size = wanted.size;
    let (width, height) = (wanted.width + 0.3 * size, HEIGHT * size);
    let places = stations(wanted.line, STEP * size);
    let middle = places.len() as f64 / 2.0;
    let mut order: Vec<usize> = (0..places.len()).collect();
    order.sort_by(|&a, &b| (a as f64 - middle).abs().total_cmp(&(b as f64 - middle).abs()));
    order.into_iter().find_map(|i| {
        let (at, along) = places[i];
        // How far a box reaches towards a line of this direction.
        let reach = 0.5 * (width * along.y.abs() + height * along.x.abs()) + GAP * size;
        [1.0, -1.0].into_iter().find_map(|side| {
            let middle =
                Point { x: at.x - side * reach * along.y, y: at.y + side * reach * along.x };
            let rect = about(middle, width, height);
            let free = within(rect, plot)
                && !taken.iter().any(|&other| overlap(rect, other))
                && !lines.iter().any(|line| line.windows(2).any(|pair| crosses(rect, pair[0], pair[1])));
            free.then_some(rect)
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLOT: Rect = Rect { x: 0.0, y: 0.0, width: 200.0, height: 100.0 };

    fn placed(line: &[Point], more: &[&[Point]], taken: &[Rect]) -> Option<Rect> {
        let lines: Vec<&[Point]> = [line].into_iter().chain(more.iter().copied()).collect();
        place(&Wanted { line, width: 20.0, size: 10.0 }, PLOT, &lines, taken)
    }

    #[test]
    fn a_name_stands_beside_the_middle_of_its_line() {
        let line = [Point { x: 0.0, y: 50.0 }, Point { x: 200.0, y: 50.0 }];
        let first = placed(&line, &[], &[]).unwrap();
        assert!((first.x + first.width / 2.0 - 100.0).abs() < 4.0 && first.y > 50.0, "{first:?}");
        let second = placed(&line, &[], &[first]).unwrap();
        assert!(second.bottom() < 50.0, "{second:?}");
        let near = [Point { x: 0.0, y: 55.0 }, Point { x: 200.0, y: 55.0 }];
        assert!(placed(&line, &[&near], &[]).unwrap().bottom() < 50.0);
    }

    #[test]
    fn a_name_without_room_is_left_out() {
        let line = [Point { x: 0.0, y: 5.0 }, Point { x: 200.0, y: 5.0 }];
        assert!(placed(&line, &[], &[]).is_some());
        let below = [Point { x: 0.0, y: 10.0 }, Point { x: 200.0, y: 10.0 }];
        assert_eq!(placed(&line, &[&below], &[]), None, "neither between the lines nor in the frame");
        let short = [Point { x: 90.0, y: 50.0 }, Point { x: 110.0, y: 50.0 }];
        assert_eq!(placed(&short, &[], &[]), None);
    }
}
