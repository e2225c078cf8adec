//! What a back end is given for one tile.

use std::sync::atomic::{AtomicBool, Ordering};

use rayon::prelude::*;

use super::preparing::made;
use super::swept::Swept;
use super::{Result, SweepError};
use crate::model::Flows;
use crate::plane::Plane;

/// What a back end is given for some cells.
pub(super) struct Prepared<J> {
    /// In the order of the cells.
    pub jobs: Vec<J>,
    /// The cell of each of them, by its place among the cells.
    pub places: Vec<u32>,
    /// Why a cell without a job has none, where that is an error.
    pub missing: Option<SweepError>,
}

impl<J: Send + Sync> Prepared<J> {
    /// Of some cells of a plane, flow by flow, counted row by row; `flows` are those of cells before.
    ///
    /// # Errors
    /// What stands in the way of all of them.
    pub fn of<T: Swept<Job = J>>(plane: &Plane<T>, cells: &[u64], flows: &Flows) -> Result<Self> {
        let some_have_none = AtomicBool::new(false);
        let found = made(plane, cells, flows, |preparing, cell| {
            let job = preparing.asked_of(cell);
            if !matches!(job, Ok(Some(_))) {
                some_have_none.store(true, Ordering::Relaxed);
            }
            job
        });
        // As a rule every cell has a job.
        if !some_have_none.into_inner() {
            let jobs = found.into_par_iter().map(|job| match job {
                Ok(Some(job)) => job,
                _ => unreachable!("every cell was seen to have one"),
            });
            return Ok(Prepared {
                jobs: jobs.collect(),
                places: (0..cells.len() as u32).collect(),
                missing: None,
            });
        }
        let (mut places, mut missing) = (Vec::with_capacity(cells.len()), None);
        let jobs = found.into_iter().zip(0..).filter_map(|(job, place)| match job {
            Ok(job) => {
                places.extend(job.is_some().then_some(place));
                job.map(Ok)
            }
            Err(why) if why.is_of_one_cell() => {
                missing.get_or_insert(why);
                None
            }
            Err(why) => Some(Err(why)),
        });
        let jobs = jobs.collect::<Result<Vec<_>>>()?;
        Ok(Prepared { jobs, places, missing })
    }
}
