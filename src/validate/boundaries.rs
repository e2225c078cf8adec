//! Bifurcation curves against the boundaries that a map shows: how many cells lie between the two.

use serde::Serialize;

use super::{Check, Spread};
use crate::analysis::{Regime, Verdict};
use crate::curves::{Curve, CurveMotion, CurvePoint, Kind};
use crate::plane::RegionMap;

/// How far from a curve its motion's cells, and their boundary, are looked for; in cells.
const WINDOW: i64 = 10;
/// The largest median distance between curves and boundaries that is accepted, in cells.
const LARGEST_MEDIAN: f64 = 1.0;
/// Of its eight neighbours, so many at least are of the motion of a cell that counts: single cells amid chaos do not.
const COMPANY: usize = 3;

/// A curve, and how far from the map's own boundary of its motion it runs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BoundaryAgreement {
    /// The kind of the bifurcation.
    pub kind: Kind,
    /// N-p-q.
    pub motion: String,
    /// Whether the motion is symmetric.
    pub symmetric: bool,
    /// Places along the curve, half a cell apart, where its motion is stable on one side.
    pub places: u64,
    /// Those of them where the map shows the motion within ten cells. Elsewhere the map's start leads to
    /// another motion that exists there as well, and there is nothing to compare.
    pub compared: u64,
    /// Distances to the nearest boundary of the motion's cells, in cells; a boundary farther than ten counts as
    /// twenty.
    pub distance: Option<Spread>,
}

/// All curves against all boundaries.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Boundaries {
    /// Places on all curves where a motion is stable on one side.
    pub places: u64,
    /// The distances of all places of all curves, in cells.
    pub distance: Option<Spread>,
    /// The curves that bound regions of the map, each for itself.
    pub curves: Vec<BoundaryAgreement>,
}

/// Compares every curve that bounds a region of the map with that region's boundary.
///
/// Places are measured in cells, the distance from one cell to the next being one along either axis. Curves along
/// which the map nowhere shows the motion are left out.
pub fn boundaries(map: &RegionMap, curves: &[Curve]) -> Boundaries {
    let mut all = Boundaries { places: 0, distance: None, curves: Vec::new() };
    let mut distances = Vec::new();
    for curve in curves {
        let places = places(map, curve);
        let own: Vec<f64> = places.iter().filter_map(|&place| distance(map, &curve.motion, place)).collect();
        all.places += places.len() as u64;
        distances.extend_from_slice(&own);
        if !own.is_empty() {
            all.curves.push(BoundaryAgreement::new(curve, places.len() as u64, own));
        }
    }
    all.distance = Spread::of(distances);
    all
}

impl Boundaries {
    /// The median of all distances against the largest that is accepted.
    ///
    /// Curves of which no place could be compared agree with nothing.
    pub fn check(&self) -> Check {
        let median = match self.distance {
            Some(distance) => Some(distance.median),
            None if self.places > 0 => Some(f64::INFINITY),
            None => None,
        };
        Check::at_most("curves, median distance in cells", median, LARGEST_MEDIAN)
    }
}

impl BoundaryAgreement {
    /// The agreement of a curve with so many places, and the distances of those that can be compared.
    fn new(curve: &Curve, places: u64, distances: Vec<f64>) -> Self {
        BoundaryAgreement {
            kind: curve.kind,
            motion: curve.motion.label(),
            symmetric: curve.motion.symmetric,
            places,
            compared: distances.len() as u64,
            distance: Spread::of(distances),
        }
    }
}

/// Places half a cell apart on the parts of a curve that bound its motion, in cells from the first.
fn places(map: &RegionMap, curve: &Curve) -> Vec<[f64; 2]> {
    let cell = |point: &CurvePoint| {
        [(&map.plane.x, point.x), (&map.plane.y, point.y)].map(|(axis, value)| axis.place(value))
    };
    let mut found = Vec::new();
    for pair in curve.points.windows(2) {
        let [from, to] = pair else { continue };
        if !(from.bounding && to.bounding) {
            continue;
        }
        let ([ax, ay], [bx, by]) = (cell(from), cell(to));
        let parts = (2.0 * (bx - ax).hypot(by - ay)).ceil().max(1.0);
        found.extend((0..parts as u32).map(|k| {
            let share = f64::from(k) / parts;
            [ax + share * (bx - ax), ay + share * (by - ay)]
        }));
    }
    found
}

/// The distance of a place from the boundary of a motion's cells; none where there are none near.
fn distance(map: &RegionMap, motion: &CurveMotion, [x, y]: [f64; 2]) -> Option<f64> {
    let (column, row) = (x.round() as i64, y.round() as i64);
    let mut shown = false;
    let mut nearest = f64::INFINITY;
    for r in row - WINDOW..=row + WINDOW {
        for c in column - WINDOW..=column + WINDOW {
            if !is_shown(map, motion, c, r) || company(map, motion, c, r) < COMPANY {
                continue;
            }
            shown = true;
            for (dc, dr) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                if inside(map, c + dc, r + dr) && !is_shown(map, motion, c + dc, r + dr) {
                    nearest = nearest.min(to_edge([x, y], [c as f64, r as f64], [dc as f64, dr as f64]));
                }
            }
        }
    }
    shown.then_some(if nearest <= WINDOW as f64 { nearest } else { 2.0 * WINDOW as f64 })
}

/// The distance of a place from the side of a cell that lies in a direction.
fn to_edge([x, y]: [f64; 2], [c, r]: [f64; 2], [dc, dr]: [f64; 2]) -> f64 {
    let (along_x, along_y) = (0.5 * dr.abs(), 0.5 * dc.abs());
    let (middle_x, middle_y) = (c + 0.5 * dc, r + 0.5 * dr);
    let nearest_x = x.clamp(middle_x - along_x, middle_x + along_x);
    let nearest_y = y.clamp(middle_y - along_y, middle_y + along_y);
    (x - nearest_x).hypot(y - nearest_y)
}

fn inside(map: &RegionMap, column: i64, row: i64) -> bool {
    (0..i64::from(map.plane.x.count)).contains(&column) && (0..i64::from(map.plane.y.count)).contains(&row)
}

fn is_shown(map: &RegionMap, motion: &CurveMotion, column: i64, row: i64) -> bool {
    inside(map, column, row) && is_of(map.at(column as u32, row as u32), motion)
}

fn company(map: &RegionMap, motion: &CurveMotion, column: i64, row: i64) -> usize {
    let around = (-1..=1).flat_map(|dr| (-1..=1).map(move |dc| (dc, dr))).filter(|&place| place != (0, 0));
    around.filter(|&(dc, dr)| is_shown(map, motion, column + dc, row + dr)).count()
}

/// Whether a cell shows a motion, or its mirror image.
fn is_of(verdict: &Verdict, motion: &CurveMotion) -> bool {
    let alike = || verdict.regime == Regime::Periodic && verdict.symmetric == motion.symmetric;
    motion.is_counted_by(verdict) && (motion.count() == 0 || alike())
}
