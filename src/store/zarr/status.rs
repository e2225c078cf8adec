//! How far a store is.

use std::collections::BTreeMap;

use serde::Serialize;

use super::log::{Event, now, read};
use super::{StoreError, ZarrStore};
use crate::plane::cost;

/// A process that was heard of not longer ago than this many of its tiles' times is at work.
const PATIENCE: f64 = 5.0;

/// At least this long ago, in seconds.
const RECENT: f64 = 60.0;

/// How far a store is.
#[derive(Clone, Debug, Serialize)]
pub struct Status {
    /// Cells of the plane.
    pub cells: u64,
    /// Cells that are there.
    pub cells_done: u64,
    /// Tiles of the plane.
    pub tiles: u32,
    /// Tiles that are there.
    pub done: u32,
    /// Tiles that are not, those that failed among them.
    pub missing: u32,
    /// Tiles that failed twice and are not there, with why.
    pub failed: Vec<Failure>,
    /// Processes that were heard of lately.
    pub processes: u32,
    /// Cells per second of those, together; none where there are none.
    pub cells_per_second: Option<f64>,
    /// The seconds in which those will have computed the rest; 0 where nothing is missing.
    pub seconds_left: Option<f64>,
    /// Side of a tile in cells.
    pub tile: u32,
    /// "cpu" or "gpu".
    pub backend: String,
    /// What computes it.
    pub adapter: String,
    /// The version of the program that does.
    pub version: String,
}

/// A tile that failed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// The tile.
    pub tile: u32,
    /// Why.
    pub message: String,
}

/// What one process does in a second.
struct Pace {
    cells: f64,
    cost: f64,
}

impl ZarrStore {
    /// How far the store is, from the tiles that are there and what processes noted.
    ///
    /// # Errors
    /// What the file system reports.
    pub fn status(&self) -> Result<Status, StoreError> {
        let there = self.tiles_there()?;
        let logs = read(&self.path);
        let cells_of = |tile: u32| self.tiling.window(tile).cells() as u64;
        let tiles = 0..self.tiling.count();
        let missing: Vec<u32> = tiles.clone().filter(|&tile| !there[tile as usize]).collect();
        let mut failed = BTreeMap::new();
        for event in logs.iter().flatten() {
            if let Event::Failed { tile, message, .. } = event {
                failed.insert(*tile, message.clone());
            }
        }
        failed.retain(|tile, _| missing.contains(tile));
        let paces: Vec<Pace> = logs.iter().filter_map(|log| self.pace(log, now())).collect();
        let sum = |of: fn(&Pace) -> f64| paces.iter().map(of).sum::<f64>();
        let left: u64 = missing.iter().map(|&tile| cost(&self.plane, &self.tiling, tile)).sum();
        let seconds_left = match paces[..] {
            _ if missing.is_empty() => Some(0.0),
            [] => None,
            _ => Some(left as f64 / sum(|pace| pace.cost)),
        };
        Ok(Status {
            cells: self.plane.cells(),
            cells_done: tiles.filter(|&tile| there[tile as usize]).map(cells_of).sum(),
            tiles: self.tiling.count(),
            done: self.tiling.count() - missing.len() as u32,
            missing: missing.len() as u32,
            failed: failed.into_iter().map(|(tile, message)| Failure { tile, message }).collect(),
            processes: paces.len() as u32,
            cells_per_second: (!paces.is_empty()).then(|| sum(|pace| pace.cells)),
            seconds_left,
            tile: self.tiling.side,
            backend: self.provenance.backend.clone(),
            adapter: self.provenance.adapter.clone(),
            version: self.provenance.version.clone(),
        })
    }

    /// The pace of a process that is at work.
    fn pace(&self, log: &[Event], now: f64) -> Option<Pace> {
        let done: Vec<(u32, u64, f64, f64)> = log
            .iter()
            .filter_map(|event| match *event {
                Event::Done { tile, cells, seconds, at } if tile < self.tiling.count() => {
                    Some((tile, cells, seconds, at))
                }
                _ => None,
            })
            .collect();
        let &(.., last) = done.last()?;
        let seconds: f64 = done.iter().map(|(_, _, seconds, _)| seconds).sum();
        let usual = seconds / done.len() as f64;
        if now - last > (PATIENCE * usual).max(RECENT) || seconds <= 0.0 {
            return None;
        }
        let cells: u64 = done.iter().map(|(_, cells, ..)| cells).sum();
        let cost: u64 = done.iter().map(|(tile, ..)| cost(&self.plane, &self.tiling, *tile)).sum();
        Some(Pace { cells: cells as f64 / seconds, cost: cost as f64 / seconds })
    }
}
