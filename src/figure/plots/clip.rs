//! Lines cut off at the edge of a plot.

use crate::figure::shapes::{Point, Rect};

/// What of a straight line lies inside a rectangle (Liang and Barsky 1984).
pub(crate) fn segment(rect: Rect, a: Point, b: Point) -> Option<(Point, Point)> {
    let (dx, dy) = (b.x - a.x, b.y - a.y);
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    let edges =
        [(-dx, a.x - rect.x), (dx, rect.right() - a.x), (-dy, a.y - rect.y), (dy, rect.bottom() - a.y)];
    for (outwards, room) in edges {
        if outwards == 0.0 {
            if room < 0.0 {
                return None;
            }
        } else if outwards < 0.0 {
            enter = enter.max(room / outwards);
        } else {
            leave = leave.min(room / outwards);
        }
    }
    let at = |t: f64| Point { x: a.x + t * dx, y: a.y + t * dy };
    (enter <= leave).then(|| (at(enter), at(leave)))
}

/// The parts of a line through points that lie inside a rectangle, without points closer than `step` pixels to the
/// one before; a point that is not a number interrupts the line.
pub(crate) fn polyline(rect: Rect, points: impl Iterator<Item = Point>, step: f64) -> Vec<Vec<Point>> {
    let mut parts: Vec<Vec<Point>> = Vec::new();
    let mut last: Option<Point> = None;
    let mut open = false;
    for point in points {
        if !(point.x.is_finite() && point.y.is_finite()) {
            last = None;
            open = false;
            continue;
        }
        let Some(from) = last.replace(point) else { continue };
        let Some((a, b)) = segment(rect, from, point) else {
            open = false;
            continue;
        };
        if !open || a != from {
            parts.push(vec![a]);
        }
        let part = parts.last_mut().expect("a part was just begun");
        // The last point of a part replaces a near one before it, so that corners are kept to within `step`.
        if part.len() > 1 && near(part[part.len() - 2], b, step) && near(part[part.len() - 1], b, step) {
            part.pop();
        }
        part.push(b);
        open = b == point;
    }
    parts
}

fn near(a: Point, b: Point, step: f64) -> bool {
    (a.x - b.x).abs() < step && (a.y - b.y).abs() < step
}

/// Whether a point lies inside a rectangle.
pub(crate) fn contains(rect: Rect, point: Point) -> bool {
    (rect.x..=rect.right()).contains(&point.x) && (rect.y..=rect.bottom()).contains(&point.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: Rect = Rect { x: 10.0, y: 20.0, width: 30.0, height: 40.0 };

    fn at(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    #[test]
    fn lines_end_at_the_edge() {
        assert_eq!(segment(RECT, at(15.0, 30.0), at(20.0, 40.0)), Some((at(15.0, 30.0), at(20.0, 40.0))));
        assert_eq!(segment(RECT, at(0.0, 30.0), at(100.0, 30.0)), Some((at(10.0, 30.0), at(40.0, 30.0))));
        assert_eq!(segment(RECT, at(0.0, 0.0), at(5.0, 100.0)), None);
        assert_eq!(segment(RECT, at(0.0, 50.0), at(20.0, 90.0)), None, "past a corner");
    }

    #[test]
    fn a_line_that_leaves_and_returns_is_two() {
        let points = [at(15.0, 30.0), at(15.0, 100.0), at(35.0, 100.0), at(35.0, 30.0)];
        let parts = polyline(RECT, points.into_iter(), 0.1);
        assert_eq!(parts, [vec![at(15.0, 30.0), at(15.0, 60.0)], vec![at(35.0, 60.0), at(35.0, 30.0)]]);
    }

    #[test]
    fn what_is_not_a_number_interrupts() {
        let points = [at(15.0, 30.0), at(16.0, 30.0), at(f64::NAN, 0.0), at(18.0, 30.0), at(19.0, 30.0)];
        assert_eq!(polyline(RECT, points.into_iter(), 0.1).len(), 2);
    }

    #[test]
    fn dense_points_are_thinned_without_moving_the_line() {
        let points = (0..=10_000).map(|i| at(12.0 + f64::from(i) / 500.0, 30.0));
        let parts = polyline(RECT, points, 0.5);
        assert_eq!(parts.len(), 1);
        assert!((40..200).contains(&parts[0].len()), "{}", parts[0].len());
        assert_eq!(*parts[0].last().unwrap(), at(32.0, 30.0));
    }
}
