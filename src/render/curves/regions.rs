//! Where the paper's region names stand: in the widest place of each region.

use crate::analysis::{Regime, Verdict};
use crate::curves::{Curve, Named, is_plane_of_paper, paper_region};
use crate::figure::{Point, Rect};
use crate::plane::{Axis, RegionMap};

/// A cell so near to a curve, in cells, lies along it.
const NEAR: i64 = 2;

/// Smaller windows in a region do not keep a name from standing there; as a share of the plane.
const SPECK: f64 = 1e-3;

const NAMES: [&str; 7] = ["R1", "R2", "R3", "R4", "R5", "R6", "R7"];

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
///
/// Regions of one motion are known by it. Where nothing repeats soon, or a cascade does, a connected region is known by
/// the curves that it lies along: L4 and L5 make it R3, L7 makes it R6, L1 and L2 make it R7.
pub(super) fn region_names(
    map: &RegionMap,
    curves: &[Curve],
    stretches: &[Named],
    plot: Rect,
) -> Vec<RegionName> {
    if !is_plane_of_paper(&map.plane) {
        return Vec::new();
    }
    let grid = Grid { columns: map.plane.x.count as usize, rows: map.plane.y.count as usize };
    let open: Vec<bool> = map.verdicts.iter().map(is_open).collect();
    let mut names: Vec<Option<&'static str>> = map.verdicts.iter().map(known).collect();
    name_the_rest(&mut names, &open, &lying_along(map, curves, stretches, grid), grid);
    adopt_specks(&mut names, grid);
    NAMES
        .into_iter()
        .map(|name| RegionName { name, places: places(name, &names, grid, plot) })
        .filter(|region| !region.places.is_empty())
        .collect()
}

/// For every cell near one of the paper's curves, the region that would lie along it there.
fn lying_along(
    map: &RegionMap,
    curves: &[Curve],
    stretches: &[Named],
    grid: Grid,
) -> Vec<Option<&'static str>> {
    let mut near = vec![None; map.verdicts.len()];
    let cell = |axis: &Axis, value: f64| axis.place(value).round() as i64;
    for stretch in stretches {
        let name = match stretch.name.as_deref().map(|name| name.trim_end_matches('\'')) {
            Some("L1" | "L2") => "R7",
            Some("L4" | "L5") => "R3",
            Some("L7") => "R6",
            _ => continue,
        };
        for point in
            curves[stretch.curve].points[stretch.points.clone()].iter().filter(|point| point.bounding)
        {
            let (column, row) = (cell(&map.plane.x, point.x), cell(&map.plane.y, point.y));
            for (c, r) in (-NEAR..=NEAR).flat_map(|c| (-NEAR..=NEAR).map(move |r| (column + c, row + r))) {
                if (0..grid.columns as i64).contains(&c) && (0..grid.rows as i64).contains(&r) {
                    near[r as usize * grid.columns + c as usize] = Some(name);
                }
            }
        }
    }
    near
}

fn known(verdict: &Verdict) -> Option<&'static str> {
    paper_region(verdict).filter(|&name| name != "R6")
}

/// Whether a cell's name depends on its surroundings.
fn is_open(verdict: &Verdict) -> bool {
    matches!(verdict.regime, Regime::Chaotic | Regime::QuasiPeriodic | Regime::Unresolved)
        || paper_region(verdict) == Some("R6")
}

#[derive(Clone, Copy)]
struct Grid {
    columns: usize,
    rows: usize,
}

impl Grid {
    fn neighbours(self, cell: usize) -> impl Iterator<Item = usize> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        [
            (column > 0).then(|| cell - 1),
            (column + 1 < self.columns).then(|| cell + 1),
            (row > 0).then(|| cell - self.columns),
            (row + 1 < self.rows).then(|| cell + self.columns),
        ]
        .into_iter()
        .flatten()
    }

    /// The connected regions of some cells.
    fn regions(self, cells: &[bool]) -> Vec<Vec<usize>> {
        let mut seen = vec![false; cells.len()];
        let mut found = Vec::new();
        for start in 0..cells.len() {
            if !cells[start] || seen[start] {
                continue;
            }
            let mut region = Vec::new();
            let mut ahead = vec![start];
            seen[start] = true;
            while let Some(cell) = ahead.pop() {
                region.push(cell);
                for next in self.neighbours(cell) {
                    if cells[next] && !seen[next] {
                        seen[next] = true;
                        ahead.push(next);
                    }
                }
            }
            found.push(region);
        }
        found
    }
}

fn name_the_rest(
    names: &mut [Option<&'static str>],
    open: &[bool],
    near: &[Option<&'static str>],
    grid: Grid,
) {
    for region in grid.regions(open) {
        let count = |name| region.iter().filter(|&&cell| near[cell] == Some(name)).count();
        let most = ["R7", "R6", "R3"].into_iter().max_by_key(|&name| count(name));
        let most = most.filter(|&name| count(name) > 0);
        region.iter().for_each(|&cell| names[cell] = most);
    }
}

/// Specks without a name take that of most cells around them.
fn adopt_specks(names: &mut [Option<&'static str>], grid: Grid) {
    let nameless: Vec<bool> = names.iter().map(Option::is_none).collect();
    for region in grid.regions(&nameless) {
        if region.len() as f64 > SPECK * names.len() as f64 {
            continue;
        }
        let mut around: Vec<&str> =
            region.iter().flat_map(|&cell| grid.neighbours(cell)).filter_map(|cell| names[cell]).collect();
        around.sort_unstable();
        let most = around.chunk_by(|a, b| a == b).max_by_key(|alike| alike.len()).map(|alike| alike[0]);
        let most = NAMES.into_iter().find(|&name| Some(name) == most);
        region.iter().for_each(|&cell| names[cell] = most);
    }
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
    use crate::curves::{Criticality, CurveMotion, CurvePoint, End, Kind, named};
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
