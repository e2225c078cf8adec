//! Motions to begin with, out of a region map.

use std::collections::HashMap;

use rayon::prelude::*;

use crate::analysis::Regime;
use crate::model::{Parameters, System};
use crate::plane::RegionMap;
use crate::theory::{PeriodicMotion, settled_motion};

/// Connected regions smaller than this share of the plane are left out.
const SMALLEST: f64 = 5e-4;
/// The most impacts of a motion.
const MOST_IMPACTS: u32 = 40;
/// Seeds of a region: in so many of its rows.
const ROWS: usize = 6;

/// A motion at a point of the plane.
#[derive(Clone, Debug)]
pub(super) struct Seed {
    pub parameters: Parameters,
    pub motion: PeriodicMotion,
}

/// Motions of every connected region of the map whose period is at most `max_period`, refined by Newton's method.
///
/// A region is entered in the middle of its longest run of cells in some of its rows.
pub(super) fn seeds(map: &RegionMap, max_period: u32) -> Vec<Seed> {
    let cells: Vec<(u32, u32)> = regions(map, max_period).iter().flat_map(|region| entries(region)).collect();
    cells.into_par_iter().filter_map(|(column, row)| seed(map, column, row)).collect()
}

fn seed(map: &RegionMap, column: u32, row: u32) -> Option<Seed> {
    let parameters = map.plane.parameters_at(column, row);
    let system = System::new(parameters).ok()?;
    let verdict = map.at(column, row);
    let motion = settled_motion(&system, verdict.state, u32::from(verdict.n)).ok()?;
    Some(Seed { parameters, motion })
}

/// The connected regions of one label and symmetry, as lists of cells.
fn regions(map: &RegionMap, max_period: u32) -> Vec<Vec<(u32, u32)>> {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    let key = |column: u32, row: u32| {
        let v = map.at(column, row);
        let wanted = v.regime == Regime::Periodic
            && u32::from(v.n) <= max_period
            && u32::from(v.p) + u32::from(v.q) <= MOST_IMPACTS;
        wanted.then_some((v.n, v.p, v.q, v.symmetric))
    };
    let least = (SMALLEST * map.plane.cells() as f64).max(4.0) as usize;
    let mut taken = vec![false; map.verdicts.len()];
    let mut found = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let Some(own) = key(column, row) else { continue };
            let mut region = Vec::new();
            let mut open = vec![(column, row)];
            while let Some((column, row)) = open.pop() {
                let index = (row * columns + column) as usize;
                if taken[index] || key(column, row) != Some(own) {
                    continue;
                }
                taken[index] = true;
                region.push((column, row));
                open.extend(
                    [(column + 1, row), (column, row + 1)]
                        .into_iter()
                        .filter(|&(c, r)| c < columns && r < rows),
                );
                open.extend(column.checked_sub(1).map(|c| (c, row)));
                open.extend(row.checked_sub(1).map(|r| (column, r)));
            }
            if region.len() >= least {
                found.push(region);
            }
        }
    }
    found
}

/// Cells of a region from which it is entered.
fn entries(region: &[(u32, u32)]) -> Vec<(u32, u32)> {
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
