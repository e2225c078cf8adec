//! Lines and boxes in pixels.

use super::shapes::{Point, Rect};

/// A rectangle about its middle.
pub(crate) fn about(middle: Point, width: f64, height: f64) -> Rect {
    Rect { x: middle.x - width / 2.0, y: middle.y - height / 2.0, width, height }
}

/// Whether two rectangles have more than an edge in common.
pub(crate) fn overlap(a: Rect, b: Rect) -> bool {
    a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom()
}

/// Whether a rectangle lies inside another.
pub(crate) fn within(inner: Rect, outer: Rect) -> bool {
    inner.x >= outer.x
        && inner.y >= outer.y
        && inner.right() <= outer.right()
        && inner.bottom() <= outer.bottom()
}

/// Whether a straight line passes through a rectangle.
pub(crate) fn crosses(rect: Rect, a: Point, b: Point) -> bool {
    let apart = a.x.max(b.x) < rect.x
        || a.x.min(b.x) > rect.right()
        || a.y.max(b.y) < rect.y
        || a.y.min(b.y) > rect.bottom();
    if apart {
        return false;
    }
    // The corners are on both sides of the line, and the boxes overlap.
    let side = |x: f64, y: f64| (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
    let sides = [
        side(rect.x, rect.y),
        side(rect.right(), rect.y),
        side(rect.x, rect.bottom()),
        side(rect.right(), rect.bottom()),
    ];
    sides.iter().any(|&s| s >= 0.0) && sides.iter().any(|&s| s <= 0.0)
}

/// Whether two straight lines cross.
pub(crate) fn meet(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    side(a, b, c) * side(a, b, d) <= 0.0
        && side(c, d, a) * side(c, d, b) <= 0.0
        && (side(a, b, c) != 0.0 || side(a, b, d) != 0.0)
}

/// The length of a line through points.
pub(crate) fn length(points: &[Point]) -> f64 {
    points.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// Places along a line, `step` apart, with the direction of the line there; the first half a step from its start.
pub(crate) fn stations(points: &[Point], step: f64) -> Vec<(Point, Point)> {
    let mut found = Vec::new();
    let mut ahead = step / 2.0;
    for pair in points.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        let whole = distance(a, b);
        while whole > 0.0 && ahead <= whole {
            let direction = Point { x: (b.x - a.x) / whole, y: (b.y - a.y) / whole };
            let at = Point { x: a.x + ahead * direction.x, y: a.y + ahead * direction.y };
            found.push((at, direction));
            ahead += step;
        }
        ahead -= whole;
    }
    found
}

fn distance(a: Point, b: Point) -> f64 {
    (a.x - b.x).hypot(a.y - b.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64, y: f64) -> Point {
        Point { x, y }
    }

    #[test]
    fn lines_through_a_box_are_told_from_lines_past_it() {
        let rect = about(at(10.0, 10.0), 4.0, 2.0);
        assert_eq!(rect, Rect { x: 8.0, y: 9.0, width: 4.0, height: 2.0 });
        assert!(crosses(rect, at(0.0, 10.0), at(20.0, 10.0)));
        assert!(crosses(rect, at(9.5, 9.5), at(10.0, 10.0)), "inside");
        assert!(crosses(rect, at(7.0, 10.0), at(9.0, 8.0)), "across a corner");
        assert!(!crosses(rect, at(7.0, 9.4), at(8.4, 8.0)), "past a corner");
        assert!(!crosses(rect, at(0.0, 12.0), at(20.0, 12.0)));
    }

    #[test]
    fn lines_that_cross_are_told_from_lines_that_do_not() {
        assert!(meet(at(0.0, 0.0), at(2.0, 2.0), at(0.0, 2.0), at(2.0, 0.0)));
        assert!(!meet(at(0.0, 0.0), at(2.0, 2.0), at(3.0, 2.0), at(3.0, 9.0)));
        assert!(!meet(at(0.0, 0.0), at(2.0, 0.0), at(3.0, 0.0), at(4.0, 0.0)), "along each other");
    }

    #[test]
    fn boxes_overlap_or_hold_each_other() {
        let rect = about(at(0.0, 0.0), 4.0, 4.0);
        assert!(overlap(rect, about(at(3.0, 3.0), 4.0, 4.0)));
        assert!(!overlap(rect, about(at(4.0, 0.0), 4.0, 4.0)), "side by side");
        assert!(within(about(at(1.0, 1.0), 2.0, 2.0), rect) && !within(rect, about(at(1.0, 1.0), 2.0, 2.0)));
    }

    #[test]
    fn stations_are_equally_far_apart() {
        let line = [at(0.0, 0.0), at(3.0, 0.0), at(3.0, 3.0)];
        assert_eq!(length(&line), 6.0);
        let places: Vec<Point> = stations(&line, 2.0).into_iter().map(|(place, _)| place).collect();
        assert_eq!(places, [at(1.0, 0.0), at(3.0, 0.0), at(3.0, 2.0)]);
    }
}
