//! What a back end is given for one tile.

use std::sync::atomic::{AtomicBool, Ordering};

use parking_lot::Mutex;
use rustc_hash::FxHashMap;

use super::preparing::made;
use super::swept::{Swept, Without};
use super::{Result, SweepError};
use crate::model::{Flows, StateVector};
use crate::plane::Plane;

/// What a back end is given for some cells.
pub(super) struct Prepared<J> {
    /// In the order of the cells.
    pub jobs: Vec<J>,
    /// The cell of each of them, by its place among the cells.
    pub places: Vec<u32>,
    /// The cells that would begin beyond a stop, by their places, and where.
    pub inadmissible: Vec<(u32, StateVector)>,
    /// Why a cell without a job has none, where that is an error.
    pub missing: Option<SweepError>,
}

impl<J: Send + Sync> Prepared<J> {
    /// Of some cells of a plane, flow by flow, counted row by row; `flows` are those of cells before.
    ///
    /// # Errors
    /// What stands in the way of all of them.
    pub fn of<T: Swept<Job = J>>(plane: &Plane<T>, cells: &[u64], flows: &Flows) -> Result<Self> {
        let (some_have_none, without) = (AtomicBool::new(false), Mutex::new(FxHashMap::default()));
        let found = made(plane, cells, flows, |preparing, cell| {
            let job = preparing.asked_of(cell).unwrap_or_else(|why| {
                without.lock().insert(cell, why);
                None
            });
            if job.is_none() {
                some_have_none.store(true, Ordering::Relaxed);
            }
            job
        });
        // As a rule every cell has a job; then the jobs stay where they are.
        let (mut without, count) = (without.into_inner(), cells.len());
        if !some_have_none.into_inner() {
            let jobs = found.into_iter().map(|job| job.expect("every cell was seen to have one"));
            let (jobs, places) = (jobs.collect(), (0..count as u32).collect());
            return Ok(Prepared { jobs, places, inadmissible: Vec::new(), missing: None });
        }
        let (mut jobs, mut places) = (Vec::with_capacity(count), Vec::with_capacity(count));
        let (mut inadmissible, mut missing) = (Vec::new(), None);
        for ((place, &cell), job) in (0..).zip(cells).zip(found) {
            match (job, without.remove(&cell)) {
                (Some(job), _) => {
                    jobs.push(job);
                    places.push(place);
                }
                (None, Some(Without::Inadmissible(start))) => inadmissible.push((place, start)),
                (None, Some(Without::Refused(why))) if why.is_of_one_cell() => {
                    missing.get_or_insert(why);
                }
                (None, Some(Without::Refused(why))) => return Err(why),
                (None, None) => {}
            }
        }
        Ok(Prepared { jobs, places, inadmissible, missing })
    }
}
