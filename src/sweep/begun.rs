//! Cells that begin, and those that would begin beyond a stop.

use crate::backend::Job;
use crate::model::StateVector;
use crate::plane::Inadmissible;

/// The system of a cell and its start, where that lies between the stops.
pub type Begun = Result<Job, Inadmissible>;

/// Finds something of those of some cells that begin, one result for each job, and puts in the place of each of the others what
/// stands for it.
///
/// # Errors
/// Those of `found_of`.
pub fn of_begun<R, E>(
    begun: Vec<Begun>,
    found_of: impl FnOnce(&[Job]) -> Result<Vec<R>, E>,
    otherwise: impl Fn(StateVector) -> R,
) -> Result<Vec<R>, E> {
    let mut jobs = Vec::with_capacity(begun.len());
    let starts: Vec<Option<StateVector>> = (begun.into_iter())
        .map(|cell| match cell {
            Ok(job) => {
                jobs.push(job);
                None
            }
            Err(Inadmissible(start)) => Some(start),
        })
        .collect();
    let mut found = found_of(&jobs)?.into_iter();
    let mut of_job = || found.next().expect("something is found of each job");
    Ok(starts.into_iter().map(|beyond| beyond.map_or_else(&mut of_job, &otherwise)).collect())
}
