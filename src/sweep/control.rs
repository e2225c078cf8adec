//! A plane under control on one back end, tile by tile.

use rayon::prelude::*;
use thiserror::Error;

use super::map::check_border;
use super::provenance;
use crate::analysis::{Counts, Measures, Regime, Verdict};
use crate::backend::{Backend, BackendError, ControlJob, Job, Watch};
use crate::control::{ControlError, NEVER, Outcome};
use crate::model::{StateVector, System, SystemError};
use crate::plane::{ControlMap, ControlPlane, ControlPlaneError};

/// Computes every cell of a plane under control on a back end.
///
/// A cell without impacts to control at (δ = 0), or whose target motion does not exist, is unresolved after 0 iterates.
///
/// # Errors
/// A plane, a system or a method that cannot be used, a target that exists in no cell, or what the back end could not do.
pub fn sweep_control(
    plane: &ControlPlane,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<ControlMap, ControlSweepError> {
    plane.check()?;
    check_border(&plane.plane())?;
    let cells = plane.plane().cells();
    let tile = backend.tile().max(1);
    let mut outcomes = Vec::new();
    outcomes.try_reserve_exact(cells as usize).map_err(|_| ControlSweepError::Memory { cells })?;
    let mut missing = None;
    let mut any = false;
    for first in (0..cells).step_by(tile) {
        if watch.cancelled() {
            return Err(BackendError::Cancelled.into());
        }
        let range = first..cells.min(first + tile as u64);
        let jobs = range.into_par_iter().map(|cell| job(plane, cell)).collect::<Result<Vec<_>, _>>()?;
        let wanted: Vec<ControlJob> = jobs.iter().filter_map(|job| job.as_ref().ok()).cloned().collect();
        any |= !wanted.is_empty();
        let mut computed = backend.control(&wanted, &plane.iterates, watch)?.into_iter();
        for job in jobs {
            match job {
                Ok(_) => outcomes.extend(computed.next()),
                Err(why) => {
                    watch.finished(1);
                    missing = missing.or(why);
                    outcomes.push(uncontrolled(plane.parameters.family().n()));
                }
            }
        }
    }
    match missing {
        Some(why) if !any => Err(why.into()),
        _ => Ok(ControlMap { plane: plane.clone(), provenance: provenance(backend), outcomes }),
    }
}

/// The job of a cell; within, what stands in the way of controlling it.
pub(super) fn job(
    plane: &ControlPlane,
    cell: u64,
) -> Result<Result<ControlJob, Option<ControlError>>, ControlSweepError> {
    let columns = u64::from(plane.x.count);
    let (column, row) = ((cell % columns) as u32, (cell / columns) as u32);
    let cells = plane.plane();
    let system = System::new(cells.parameters_at(column, row))?;
    if system.is_clamped() {
        return Ok(Err(None));
    }
    let scheme = plane.scheme_at(column, row);
    if let Some(ratio) = scheme.force_ratio() {
        system.following(ratio)?;
    }
    let controller = match scheme.resolve(&system) {
        Ok(controller) => controller,
        Err(why @ ControlError::NoTarget { .. }) => return Ok(Err(Some(why))),
        Err(why) => return Err(why.into()),
    };
    let start = cells.start_at(column, row).state(&system);
    Ok(Ok(ControlJob { job: Job { system, start }, controller }))
}

/// A cell that cannot be controlled.
fn uncontrolled(coordinates: usize) -> Outcome {
    Outcome {
        verdict: Verdict {
            regime: Regime::Unresolved,
            n: 0,
            counts: Counts::default(),
            symmetric: false,
            lyapunov: f32::NAN,
            state: StateVector::zeros(coordinates),
            impacts: 0,
            impacts_total: 0,
            peak_impact_velocity: 0.0,
            periods: 0,
            returning: 0,
            measures: Measures::default(),
        },
        period: 0,
        iterates: 0,
        converged_at: NEVER,
        signal: 0.0,
        runaway: false,
        escapes: 0,
        effort: 0.0,
    }
}

/// Why a plane under control was not computed.
#[derive(Debug, Error)]
pub enum ControlSweepError {
    /// The plane cannot be used.
    #[error(transparent)]
    Plane(#[from] ControlPlaneError),
    /// A cell's system cannot be used.
    #[error(transparent)]
    System(#[from] SystemError),
    /// A cell's control method cannot be used.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The outcomes do not fit into memory.
    #[error("the results of {cells} cells do not fit into this machine's memory: compute fewer")]
    Memory {
        /// The cells of the plane.
        cells: u64,
    },
    /// The back end gave no outcomes.
    #[error(transparent)]
    Backend(#[from] BackendError),
}
