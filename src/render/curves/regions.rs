//! Where the paper's region names stand: in the widest place of each region.

use crate::curves::Curve;
use crate::figure::{Point, Rect};
use crate::paper::{Named, REGIONS, regions};
use crate::plane::RegionMap;

/// Where in a region its name may stand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    pub at: Point,
    /// How far the border of the region is, in pixels.
    pub clearance: f64,
}

/// A region's name and the places where it may stand, the widest first.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RegionName {
    pub name: &'static str,
    pub places: Vec<Place>,
}

/// The paper's region names, on the paper's plane.
pub(super) fn region_names(
    map: &RegionMap,
    curves: &[Curve],
    stretches: &[Named],
    plot: Rect,
) -> Vec<RegionName> {
    let names = regions(map, curves, stretches);
    let grid = Grid { columns: map.plane.x.count as usize, rows: map.plane.y.count as usize };
    REGIONS
        .into_iter()
        .map(|name| RegionName { name, places: places(name, &names, grid, plot) })
        .filter(|region| !region.places.is_empty())
        .collect()
}

#[derive(Clone, Copy)]
struct Grid {
    columns: usize,
    rows: usize,
}

/// The middles of a name's cells, those farthest from its borders first.
fn places(name: &'static str, names: &[Option<&str>], grid: Grid, plot: Rect) -> Vec<Place> {
    let cell = [plot.width / grid.columns as f64, plot.height / grid.rows as f64];
    let inside: Vec<bool> = names.iter().map(|&other| other == Some(name)).collect();
    let place = |(i, clearance): (usize, f64)| {
        let (column, row) = (i % grid.columns, i / grid.columns);
        let at = Point {
            x: plot.x + (column as f64 + 0.5) * cell[0],
            y: plot.bottom() - (row as f64 + 0.5) * cell[1],
        };
        Place { at, clearance }
    };
    let distances = distances(&inside, grid, cell).into_iter().enumerate();
    let mut places: Vec<Place> = distances.filter(|(i, _)| inside[*i]).map(place).collect();
    places.sort_by(|a, b| b.clearance.total_cmp(&a.clearance));
    places
}

/// How far each cell is from the next one outside, in pixels; beyond the plane is outside (two sweeps of a chamfer).
fn distances(inside: &[bool], grid: Grid, [width, height]: [f64; 2]) -> Vec<f64> {
    let (columns, rows) = (grid.columns as i64, grid.rows as i64);
    let steps =
        [(-1, 0, width), (-1, -1, width.hypot(height)), (0, -1, height), (1, -1, width.hypot(height))];
    let mut far: Vec<f64> = inside.iter().map(|&inside| if inside { f64::INFINITY } else { 0.0 }).collect();
    for sign in [1, -1] {
        for i in 0..columns * rows {
            let i = if sign > 0 { i } else { columns * rows - 1 - i };
            let (column, row) = (i % columns, i / columns);
            for (across, up, length) in steps {
                let (c, r) = (column + sign * across, row + sign * up);
                let beyond = c < 0 || r < 0 || c >= columns || r >= rows;
                let from = if beyond { 0.0 } else { far[(r * columns + c) as usize] };
                far[i as usize] = far[i as usize].min(from + length);
            }
        }
    }
    far
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{Regime, Verdict};
    use crate::curves::{Criticality, CurveMotion, CurvePoint, End, Kind};
    use crate::paper::named;
    use crate::render::example;

    const PLOT: Rect = Rect { x: 0.0, y: 0.0, width: 200.0, height: 100.0 };

    /// Stripes of 20 columns: R1, chaos, no impact, R2, chaos, R5, 2-4-4 with chaos in it, chaos.
    fn stripes() -> RegionMap {
        let periodic = |counts, symmetric| Verdict::of_motion(Regime::Periodic, counts, symmetric);
        let chaos = Verdict::of_motion(Regime::Chaotic, [0; 3], false);
        example::of(160, 40, |column, row| match column / 20 {
            0 => periodic([1, 1, 1], true),
            2 => Verdict::of_motion(Regime::NoImpact, [0; 3], false),
            3 => periodic([1, 1, 1], false),
            5 => periodic([1, 2, 2], false),
            6 if column < 139 && row % 2 == 0 => periodic([2, 4, 4], false),
            6 if column == 139 => Verdict::of_motion(Regime::NoImpact, [0; 3], false),
            _ => chaos,
        })
    }

    /// An upright curve along the middle of a column.
    fn upright(map: &RegionMap, kind: Kind, [n, p, q]: [u32; 3], symmetric: bool, column: u32) -> Curve {
        let point = |row| CurvePoint {
            x: map.plane.x.value(column),
            y: map.plane.y.value(row),
            criticality: Some(Criticality::Supercritical),
            bounding: true,
            special: None,
        };
        Curve {
            kind,
            motion: CurveMotion { n, impacts: vec![p, q], image: Some(vec![q, p]), symmetric },
            touches: None,
            points: (0..map.plane.y.count).map(point).collect(),
            ends: [End::LeavesPlane; 2],
        }
    }

    /// The names and the stripes that they stand in.
    fn found(map: &RegionMap, curves: &[Curve]) -> Vec<(&'static str, usize)> {
        let names = region_names(map, curves, &named(curves, &map.plane), PLOT);
        assert!(names.iter().all(|name| name.places.is_sorted_by(|a, b| a.clearance >= b.clearance)));
        let widest: Vec<(&str, Place)> = names.iter().map(|name| (name.name, name.places[0])).collect();
        assert!(widest.iter().all(|(_, place)| (place.clearance - 12.5).abs() < 2.0), "{widest:?}");
        widest.into_iter().map(|(name, place)| (name, (place.at.x / 25.0) as usize)).collect()
    }

    #[test]
    fn regions_are_named_by_motion_and_by_the_curves_along_them() {
        let map = stripes();
        let curves = [
            upright(&map, Kind::NeimarkSacker, [1, 1, 1], true, 20),
            upright(&map, Kind::NeimarkSacker, [1, 1, 1], false, 80),
            upright(&map, Kind::PeriodDoubling, [1, 2, 2], false, 119),
        ];
        let expected = [("R1", 0), ("R2", 3), ("R3", 4), ("R5", 5), ("R6", 6), ("R7", 1)];
        assert_eq!(found(&map, &curves), expected);
        assert_eq!(found(&map, &[]), [("R1", 0), ("R2", 3), ("R5", 5)], "nothing tells chaos from chaos");
    }

    #[test]
    fn specks_do_not_narrow_a_region() {
        let mut map = stripes();
        let window = Verdict::of_motion(Regime::Periodic, [3, 7, 7], true);
        map.verdicts[20 * 160 + 70] = window;
        assert!(found(&map, &[]).contains(&("R2", 3)));
        for row in 0..40 {
            map.verdicts[row * 160 + 70] = window;
        }
        let wall = region_names(&map, &[], &[], PLOT);
        assert!(wall.iter().any(|name| name.name == "R2" && name.places[0].clearance < 8.0));
    }

    #[test]
    fn other_planes_have_no_such_names() {
        let mut map = stripes();
        map.plane.parameters = map.plane.parameters.with_named("r", 0.7);
        assert_eq!(found(&map, &[]), []);
    }
}
