//! Names along curves, where there is room for them.

use super::geometry::{about, crosses, length, meet, overlap, stations, within};
use super::shapes::{Point, Rect};

/// The height of a name's box, from ascenders to descenders, in text sizes.
pub(crate) const HEIGHT: f64 = 1.22;
/// The room between a name and its line, in text sizes.
const GAP: f64 = 0.18;
/// A line shorter than this many times its name has none beside it; one shorter than so many text sizes has none at all.
const SHORTEST: f64 = 1.5;
const SHORTEST_LED: f64 = 1.5;
/// How far away a name may stand that has a leader, in text sizes, and how many lines that may cross.
const FARTHEST: u32 = 5;
const MOST_CROSSED: usize = 2;
/// How far apart the places are that are tried, in text sizes.
const STEP: f64 = 0.4;

/// A name that is wanted at a line.
#[derive(Clone, Debug)]
pub(crate) struct Wanted<'a> {
    pub line: &'a [Point],
    pub width: f64,
    pub size: f64,
}

/// Where a name stands, and the line that leads from there to what it names, if that is not near.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    pub rect: Rect,
    pub leader: Option<(Point, Point)>,
}

/// What is on a plot already.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Plot<'a> {
    pub rect: Rect,
    pub lines: &'a [&'a [Point]],
    pub taken: &'a [Rect],
}

impl Plot<'_> {
    /// Finds a place beside a line for its name: inside the plot, off every line, and apart from what is already there.
    ///
    /// The place nearest to the middle of the line is taken that no other line parts from it; none if there is no room
    /// anywhere along the line.
    pub fn beside(&self, wanted: &Wanted) -> Option<Place> {
        if length(wanted.line) < SHORTEST * wanted.width {
            return None;
        }
        self.nearest(wanted, |at, along, side| {
            let rect = beside(wanted, at, along, side, GAP);
            let beyond = |from: Point| moved(from, along, side * 0.3 * GAP * wanted.size);
            let parted = self.crossings(beyond(at), middle(rect)) > 0;
            (self.is_free(rect) && !parted).then_some(Place { rect, leader: None })
        })
    }

    /// Finds the same farther away, with a leader to the line: across as few other lines as possible, and then as near
    /// as possible.
    pub fn led(&self, wanted: &Wanted) -> Option<Place> {
        if length(wanted.line) < SHORTEST_LED * wanted.size {
            return None;
        }
        let distances = (1..=FARTHEST).map(f64::from);
        let candidates = distances.flat_map(|distance| {
            let found = self.nearest(wanted, |at, along, side| {
                let rect = beside(wanted, at, along, side, distance);
                let beyond = moved(at, along, side * 0.3 * GAP * wanted.size);
                let end = moved(at, along, side * (distance * wanted.size - 0.1 * wanted.size));
                let crossings = self.crossings(beyond, end);
                let leads_through = self.taken.iter().any(|&other| crosses(other, at, end));
                (self.is_free(rect) && !leads_through && crossings <= MOST_CROSSED)
                    .then_some((crossings, Place { rect, leader: Some((at, end)) }))
            });
            found.into_iter()
        });
        candidates.min_by_key(|&(crossings, _)| crossings).map(|(_, place)| place)
    }

    /// Tries both sides of places along a line, from its middle outwards.
    fn nearest<T>(&self, wanted: &Wanted, attempt: impl Fn(Point, Point, f64) -> Option<T>) -> Option<T> {
        let places = stations(wanted.line, STEP * wanted.size);
        let middle = places.len() as f64 / 2.0;
        let mut order: Vec<usize> = (0..places.len()).collect();
        order.sort_by(|&a, &b| (a as f64 - middle).abs().total_cmp(&(b as f64 - middle).abs()));
        order.into_iter().find_map(|i| {
            let (at, along) = places[i];
            [1.0, -1.0].into_iter().find_map(|side| attempt(at, along, side))
        })
    }

    fn is_free(&self, rect: Rect) -> bool {
        within(rect, self.rect)
            && !self.taken.iter().any(|&other| overlap(rect, other))
            && !self.lines.iter().any(|line| line.windows(2).any(|pair| crosses(rect, pair[0], pair[1])))
    }

    /// How many lines a straight line crosses.
    fn crossings(&self, a: Point, b: Point) -> usize {
        self.lines.iter().filter(|line| line.windows(2).any(|pair| meet(a, b, pair[0], pair[1]))).count()
    }
}

/// The box of a name at a distance, in text sizes, from a line that passes `at` in direction `along`.
fn beside(wanted: &Wanted, at: Point, along: Point, side: f64, distance: f64) -> Rect {
    let size = wanted.size;
    let (width, height) = (wanted.width + 0.3 * size, HEIGHT * size);
    // How far a box reaches towards a line of this direction.
    let reach = 0.5 * (width * along.y.abs() + height * along.x.abs()) + distance * size;
    about(moved(at, along, side * reach), width, height)
}

/// A point at some distance to the side of a line.
fn moved(from: Point, along: Point, distance: f64) -> Point {
    Point { x: from.x - distance * along.y, y: from.y + distance * along.x }
}

fn middle(rect: Rect) -> Point {
    Point { x: rect.x + rect.width / 2.0, y: rect.y + rect.height / 2.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLOT: Rect = Rect { x: 0.0, y: 0.0, width: 200.0, height: 100.0 };

    fn level(y: f64) -> [Point; 2] {
        [Point { x: 0.0, y }, Point { x: 200.0, y }]
    }

    /// Where the name of the first of some lines stands, beside it or with a leader.
    fn found(lines: &[&[Point]], taken: &[Rect]) -> [Option<Place>; 2] {
        let wanted = Wanted { line: lines[0], width: 20.0, size: 10.0 };
        let plot = Plot { rect: PLOT, lines, taken };
        [plot.beside(&wanted), plot.led(&wanted)]
    }

    fn placed(lines: &[&[Point]], taken: &[Rect]) -> Option<Rect> {
        found(lines, taken)[0].map(|place| place.rect)
    }

    #[test]
    fn a_name_stands_beside_the_middle_of_its_line() {
        let line = level(50.0);
        let first = placed(&[&line], &[]).unwrap();
        assert!((first.x + first.width / 2.0 - 100.0).abs() < 4.0 && first.y > 50.0, "{first:?}");
        let second = placed(&[&line], &[first]).unwrap();
        assert!(second.bottom() < 50.0, "{second:?}");
        assert!(placed(&[&line, &level(55.0)], &[]).unwrap().bottom() < 50.0);
    }

    #[test]
    fn no_line_parts_a_name_from_its_own() {
        // One below is so near that a name would stand beyond it.
        assert!(placed(&[&level(50.0), &level(52.0)], &[]).unwrap().bottom() < 50.0);
        assert_eq!(placed(&[&level(50.0), &level(52.0), &level(48.0)], &[]), None);
    }

    #[test]
    fn a_leader_reaches_from_the_line_to_a_name_farther_away() {
        let lines = [level(50.0), level(52.0), level(48.0), level(46.0)];
        let lines: Vec<&[Point]> = lines.iter().map(|line| &line[..]).collect();
        let Place { rect, leader } = found(&lines, &[])[1].unwrap();
        let (from, to) = leader.unwrap();
        assert_eq!(from.y, 50.0);
        assert!(to.y > 55.0 && to.y < rect.y, "across one line and not two: {to:?} {rect:?}");
        assert!(lines.iter().all(|line| !crosses(rect, line[0], line[1])));
    }

    #[test]
    fn a_name_without_room_is_left_out() {
        assert!(placed(&[&level(5.0)], &[]).is_some());
        assert_eq!(
            placed(&[&level(5.0), &level(10.0)], &[]),
            None,
            "neither between the lines nor in the frame"
        );
        let across = |length: f64| [Point { x: 90.0, y: 50.0 }, Point { x: 90.0 + length, y: 50.0 }];
        let [beside, led] = found(&[&across(20.0)], &[]);
        assert!(beside.is_none() && led.is_some(), "too short for a name beside it");
        assert_eq!(found(&[&across(10.0)], &[]), [None, None]);
    }
}
