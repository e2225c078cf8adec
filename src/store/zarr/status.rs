//! How far a store is.

use std::collections::BTreeMap;
use std::time::Duration;

use serde::Serialize;

use super::log::{Event, now, read};
use super::{StoreError, ZarrStore};
use crate::plane::cost;

/// A process that was heard of not longer ago than this many of its tiles' times is at work.
const PATIENCE: f64 = 5.0;

/// At least this long ago, in seconds …
const RECENT: f64 = 60.0;
/// … and this long, where it has not finished any tile; see [`Status::SILENCE`].
const FIRST: f64 = Status::SILENCE.as_secs() as f64;

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
    /// Processes at work, as far as is known: those heard of lately, and not of their end; one that is killed does not say so.
    pub processes: u32,
    /// Cells per second of those, together; none where none of them has finished a tile.
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

impl Status {
    /// For so long a process that began, and was not heard of since, counts as at work: nobody tells whether it was killed.
    pub const SILENCE: Duration = Duration::from_secs(600);
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
        let at_work: Vec<&Vec<Event>> = logs.iter().filter(|log| is_at_work(log, now())).collect();
        let paces: Vec<Pace> = at_work.iter().filter_map(|log| self.pace(log)).collect();
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
            processes: at_work.len() as u32,
            cells_per_second: (!paces.is_empty()).then(|| sum(|pace| pace.cells)),
            seconds_left,
            tile: self.tiling.side,
            backend: self.provenance.backend.clone(),
            adapter: self.provenance.adapter.clone(),
            version: self.provenance.version.clone(),
        })
    }

    /// The pace of a process, if it has finished a tile.
    fn pace(&self, log: &[Event]) -> Option<Pace> {
        let (mut seconds, mut cells, mut work) = (0.0, 0, 0);
        for event in log {
            match *event {
                Event::Done { tile, cells: of_tile, seconds: taken, .. } if tile < self.tiling.count() => {
                    seconds += taken;
                    cells += of_tile;
                    work += cost(&self.plane, &self.tiling, tile);
                }
                _ => {}
            }
        }
        (seconds > 0.0).then(|| Pace { cells: cells as f64 / seconds, cost: work as f64 / seconds })
    }
}

/// Whether a process that noted some events has not come to its end, as far as is known: one that was killed says nothing.
fn is_at_work(log: &[Event], now: f64) -> bool {
    let Some(last) = log.last() else { return false };
    let taken = log.iter().filter_map(|event| match event {
        Event::Done { seconds, .. } => Some(*seconds),
        _ => None,
    });
    let taken: Vec<f64> = taken.collect();
    let usual = taken.iter().sum::<f64>() / taken.len().max(1) as f64;
    let least = if taken.is_empty() { FIRST } else { RECENT };
    !matches!(last, Event::Ended { .. }) && now - last.at() <= (PATIENCE * usual).max(least)
}
