//! Motions to begin with, out of a region map.

use std::collections::{HashMap, HashSet};

use rayon::prelude::*;

use super::curve::CurveMotion;
use super::regions::Shown;
use super::symmetry::among;
use crate::model::{Setting, System};
use crate::plane::{Cell, RegionMap};
use crate::theory::{PeriodicMotion, StopSet, settled_motion};

/// The fewest cells of a motion that is followed, and of its regions from which it is: on a large map, so many in a million.
/// Of a motion with no such region, all regions count.
const FEWEST: usize = 4;
const FEWEST_IN_A_MILLION: u64 = 20;
/// Of the places of a motion in each of so many parts of either axis one is enough.
const PARTS: u32 = 32;
/// The most impacts of a motion.
pub(super) const MOST_IMPACTS: u32 = 40;
/// Seeds of a region: in so many of its rows.
const ROWS: usize = 6;
/// Cells of a motion that are tried where none of the entries of its regions leads to it.
const TRIED: usize = 24;

/// The fewest cells that a motion of a map must have for its curves to be computed.
pub(super) fn fewest(map: &RegionMap) -> usize {
    FEWEST.max((map.plane.cells() * FEWEST_IN_A_MILLION / 1_000_000) as usize)
}

/// A motion at a point of the plane.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub parameters: Setting,
    pub motion: PeriodicMotion,
}

/// A shown motion at points of its regions, refined by Newton's method.
///
/// A region is entered in the middle of its longest run of cells in some of its rows, and at other cells where none of those
/// of any region leads to the motion.
pub(super) fn seeds(map: &RegionMap, shown: &Shown, stops: &StopSet) -> Vec<Seed> {
    let large = shown.regions.iter().filter(|region| region.len() >= fewest(map)).count();
    let regions = if large > 0 { &shown.regions[..large] } else { &shown.regions[..] };
    let solved = |cells: &[Cell]| -> Vec<Seed> {
        cells.par_iter().filter_map(|&cell| seed(map, cell, &shown.motion, stops)).collect()
    };
    // The largest regions come first.
    let mut parts = HashSet::new();
    let [columns, rows] = [map.plane.x.count, map.plane.y.count].map(u64::from);
    let part = |at: u32, count: u64| u64::from(at) * u64::from(PARTS) / count;
    let mut is_new = |&(column, row): &Cell| parts.insert((part(column, columns), part(row, rows)));
    let entered: Vec<Cell> =
        regions.iter().flat_map(|region| entries(region)).filter(|cell| is_new(cell)).collect();
    let found = solved(&entered);
    if !found.is_empty() {
        return found;
    }
    let all: Vec<Cell> = regions.iter().flatten().copied().collect();
    let some: Vec<Cell> = all.iter().copied().step_by(all.len().div_ceil(TRIED).max(1)).collect();
    solved(&some)
}

/// The motion of a cell, the way round that it is named.
fn seed(map: &RegionMap, (column, row): Cell, named: &CurveMotion, stops: &StopSet) -> Option<Seed> {
    let parameters = map.plane.parameters_at(column, row);
    let system = System::new(parameters).ok()?;
    let verdict = map.at(column, row);
    let motion = settled_motion(&system, &verdict.state[..], u32::from(verdict.n)).ok()?;
    let motion = among(stops, &system, motion);
    let found = CurveMotion::of(&motion.pattern);
    if found == *named {
        return Some(Seed { parameters, motion });
    }
    let image = motion.mirror_image(&system).filter(|_| found.mirror_image() == *named)?;
    Some(Seed { parameters, motion: image })
}

/// Cells of a region from which it is entered.
fn entries(region: &[Cell]) -> Vec<Cell> {
    let mut by_row: HashMap<u32, Vec<u32>> = HashMap::new();
    for &(column, row) in region {
        by_row.entry(row).or_default().push(column);
    }
    let mut rows: Vec<u32> = by_row.keys().copied().collect();
    rows.sort_unstable();
    let mut chosen: Vec<u32> = (0..ROWS).map(|k| rows[(2 * k + 1) * rows.len() / (2 * ROWS)]).collect();
    chosen.dedup();
    chosen.into_iter().map(|row| (middle_of_longest_run(&mut by_row[&row].clone()), row)).collect()
}

fn middle_of_longest_run(columns: &mut [u32]) -> u32 {
    columns.sort_unstable();
    let runs = columns.chunk_by(|a, b| a + 1 == *b);
    let longest = runs.max_by_key(|run| run.len()).unwrap_or_default();
    longest.get(longest.len() / 2).copied().unwrap_or_default()
}
