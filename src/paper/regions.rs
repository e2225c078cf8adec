//! The regions R1 to R7, cell by cell.

use super::names::{is_plane_of_paper, region_name};
use super::naming::Named;
use crate::analysis::{Regime, Verdict};
use crate::curves::Curve;
use crate::plane::{Adjacency, Axis, Cell, RegionMap, beside, connected};

/// A cell so near to a curve, in cells, lies along it.
const NEAR: i64 = 2;

/// Smaller windows in a region belong to it; as a share of the plane.
const SPECK: f64 = 1e-3;

/// The names of the regions.
pub const REGIONS: [&str; 7] = ["R1", "R2", "R3", "R4", "R5", "R6", "R7"];

/// The region that each cell of a map lies in, row by row; none for some cells, and for all of another plane.
///
/// Regions of one motion are known by it. Where nothing repeats soon, or a cascade does, a connected region is known by
/// the curves that it lies along: L4 and L5 make it R3, L7 makes it R6, L1 and L2 make it R7.
pub fn regions(map: &RegionMap, curves: &[Curve], stretches: &[Named]) -> Vec<Option<&'static str>> {
    if !is_plane_of_paper(&map.plane) {
        return vec![None; map.verdicts.len()];
    }
    let known = |verdict: &Verdict| region_name(verdict).filter(|&name| name != "R6");
    let mut names: Vec<Option<&'static str>> = map.verdicts.iter().map(known).collect();
    name_the_rest(map, &mut names, &lying_along(map, curves, stretches));
    adopt_specks(map, &mut names);
    names
}

fn index(map: &RegionMap, (column, row): Cell) -> usize {
    row as usize * map.plane.x.count as usize + column as usize
}

/// The sets of cells of which something holds that are connected by their sides.
fn sets(map: &RegionMap, holds: impl Iterator<Item = bool>) -> Vec<Vec<Cell>> {
    let keys: Vec<Option<()>> = holds.map(|holds| holds.then_some(())).collect();
    connected(&keys, map.plane.x.count, map.plane.y.count, Adjacency::Sides)
}

/// For every cell near one of the paper's curves, the region that would lie along it there.
fn lying_along(map: &RegionMap, curves: &[Curve], stretches: &[Named]) -> Vec<Option<&'static str>> {
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
                if (0..i64::from(map.plane.x.count)).contains(&c)
                    && (0..i64::from(map.plane.y.count)).contains(&r)
                {
                    near[index(map, (c as u32, r as u32))] = Some(name);
                }
            }
        }
    }
    near
}

/// Whether a cell's name depends on its surroundings.
fn is_open(verdict: &Verdict) -> bool {
    matches!(verdict.regime, Regime::Chaotic | Regime::QuasiPeriodic | Regime::Unresolved)
        || region_name(verdict) == Some("R6")
}

fn name_the_rest(map: &RegionMap, names: &mut [Option<&'static str>], near: &[Option<&'static str>]) {
    for region in sets(map, map.verdicts.iter().map(is_open)) {
        let count = |name| region.iter().filter(|&&cell| near[index(map, cell)] == Some(name)).count();
        let most = ["R7", "R6", "R3"].into_iter().max_by_key(|&name| count(name));
        let most = most.filter(|&name| count(name) > 0);
        region.iter().for_each(|&cell| names[index(map, cell)] = most);
    }
}

/// Specks without a name take that of most cells around them.
fn adopt_specks(map: &RegionMap, names: &mut [Option<&'static str>]) {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    for region in sets(map, names.iter().map(Option::is_none)) {
        if region.len() as f64 > SPECK * names.len() as f64 {
            continue;
        }
        let mut around: Vec<&str> = (region.iter())
            .flat_map(|&cell| beside(cell, columns, rows, Adjacency::Sides))
            .filter_map(|cell| names[index(map, cell)])
            .collect();
        around.sort_unstable();
        let most = around.chunk_by(|a, b| a == b).max_by_key(|alike| alike.len()).map(|alike| alike[0]);
        let most = REGIONS.into_iter().find(|&name| Some(name) == most);
        region.iter().for_each(|&cell| names[index(map, cell)] = most);
    }
}
