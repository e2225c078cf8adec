//! Whole planes and diagrams on one back end.

mod certify;
mod control;
mod diagram;
mod extents;
mod map;
mod sample;
mod stored;

use thiserror::Error;

use crate::backend::{Backend, BackendError};
use crate::diagram::DiagramError;
use crate::model::SystemError;
use crate::plane::{PlaneError, Provenance};

pub use certify::{Certification, certify, certify_window};
pub use control::{ControlSweepError, sweep_control};
pub use diagram::diagram;
pub use extents::measure_extents;
pub use map::{sweep, sweep_window};
pub use sample::{sample, sample_control, spread};
pub use stored::{Reopen, StoredError, StoredRun, sweep_stored};

/// What a result of this back end is marked with.
pub fn provenance(backend: &dyn Backend) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        backend: backend.name().to_owned(),
        adapter: backend.adapter(),
    }
}

/// Why a plane or a diagram was not computed.
#[derive(Debug, Error)]
pub enum SweepError {
    /// The plane cannot be used.
    #[error(transparent)]
    Plane(#[from] PlaneError),
    /// The diagram cannot be used.
    #[error(transparent)]
    Diagram(#[from] DiagramError),
    /// A cell's system cannot be used.
    #[error(transparent)]
    System(#[from] SystemError),
    /// The verdicts do not fit into memory.
    #[error("the results of {cells} cells do not fit into this machine's memory: compute fewer")]
    Memory {
        /// The cells of the plane.
        cells: u64,
    },
    /// The back end gave no verdicts.
    #[error(transparent)]
    Backend(#[from] BackendError),
}
