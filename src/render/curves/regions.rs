//! Where the paper's region names stand: in the widest place of each region.

use crate::analysis::{Regime, Verdict};
use crate::curves::{is_plane_of_paper, paper_region};
use crate::plane::RegionMap;
use crate::render::canvas::{Point, Rect};

/// A name, the middle of the widest place of its region, and how far the border is from there, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct RegionName {
    pub name: &'static str,
    pub at: Point,
    pub clearance: f64,
}

/// The paper's region names, on the paper's plane.
///
/// Regions of one motion are known by it. Where nothing repeats soon, or a cascade does, a connected region is known by
/// what it borders most on: R1 makes it R7, R2 makes it R3, and R5 makes it R6.
pub(super) fn region_names(map: &RegionMap, plot: Rect) -> Vec<RegionName> {
    if !is_plane_of_paper(&map.plane) {
        return Vec::new();
    }
    let grid = Grid { columns: map.plane.x.count as usize, rows: map.plane.y.count as usize };
    let mut names: Vec<Option<&'static str>> = map.verdicts.iter().map(known).collect();
    name_the_rest(&mut names, &map.verdicts.iter().map(is_open).collect::<Vec<_>>(), grid);
    ["R1", "R2", "R3", "R4", "R5", "R6", "R7"]
        .into_iter()
        .filter_map(|name| widest(name, &names, grid, plot))
        .collect()
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
}

fn name_the_rest(names: &mut [Option<&'static str>], open: &[bool], grid: Grid) {
    let mut seen = vec![false; names.len()];
    for start in 0..names.len() {
        if !open[start] || seen[start] {
            continue;
        }
        let mut region = Vec::new();
        let mut ahead = vec![start];
        let mut borders = [("R1", "R7", 0_u32), ("R2", "R3", 0), ("R5", "R6", 0)];
        seen[start] = true;
        while let Some(cell) = ahead.pop() {
            region.push(cell);
            for next in grid.neighbours(cell) {
                if let Some((_, _, count)) =
                    borders.iter_mut().find(|(known, _, _)| names[next] == Some(known))
                {
                    *count += 1;
                }
                if open[next] && !seen[next] {
                    seen[next] = true;
                    ahead.push(next);
                }
            }
        }
        let (_, name, count) = borders.into_iter().max_by_key(|&(_, _, count)| count).unwrap_or_default();
        // What is named in this pass is no border of what comes later.
        if count > 0 {
            region.iter().for_each(|&cell| names[cell] = Some(name));
        }
    }
}

/// The middle of the largest ellipse, round in pixels, that fits into the cells of a name.
fn widest(name: &'static str, names: &[Option<&str>], grid: Grid, plot: Rect) -> Option<RegionName> {
    let cell = [plot.width / grid.columns as f64, plot.height / grid.rows as f64];
    let inside: Vec<bool> = names.iter().map(|&other| other == Some(name)).collect();
    let distances = distances(&inside, grid, cell);
    let (best, &clearance) =
        distances.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1).then(b.0.cmp(&a.0)))?;
    let (column, row) = (best % grid.columns, best / grid.columns);
    let at = Point {
        x: plot.x + (column as f64 + 0.5) * cell[0],
        y: plot.bottom() - (row as f64 + 0.5) * cell[1],
    };
    (clearance > 0.0).then_some(RegionName { name, at, clearance })
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
    use crate::render::example;

    const PLOT: Rect = Rect { x: 0.0, y: 0.0, width: 200.0, height: 100.0 };

    /// Stripes of 20 columns: R1, chaos, no impact, R2, chaos, R5, 2-4-4 with chaos in it.
    fn stripes() -> RegionMap {
        let periodic = |counts, symmetric| example::verdict(Regime::Periodic, counts, symmetric);
        let chaos = example::verdict(Regime::Chaotic, [0; 3], false);
        example::of(140, 40, |column, row| match column / 20 {
            0 => periodic([1, 1, 1], true),
            2 => example::verdict(Regime::NoImpact, [0; 3], false),
            3 => periodic([1, 1, 1], false),
            5 => periodic([1, 2, 2], false),
            6 if row % 2 == 0 => periodic([2, 4, 4], false),
            _ => chaos,
        })
    }

    #[test]
    fn regions_are_named_by_motion_and_by_what_they_border_on() {
        let names = region_names(&stripes(), PLOT);
        let stripe = |at: Point| (at.x / (200.0 / 7.0)) as usize;
        let found: Vec<(&str, usize)> = names.iter().map(|n| (n.name, stripe(n.at))).collect();
        // The chaos between R2 and R5 touches both alike; the later one wins.
        assert_eq!(found, [("R1", 0), ("R2", 3), ("R5", 5), ("R6", 4), ("R7", 1)]);
        for name in &names {
            assert!((name.clearance - 14.0).abs() < 2.0, "{name:?}");
        }
    }

    #[test]
    fn other_planes_have_no_such_names() {
        let mut map = stripes();
        map.plane.parameters.r = 0.7;
        assert_eq!(region_names(&map, PLOT), []);
    }
}
