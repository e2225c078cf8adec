//! Whole planes and diagrams on one back end.

mod begun;
mod certify;
mod diagram;
mod extents;
mod map;
mod order;
mod prepared;
mod preparing;
mod sample;
mod stored;
mod swept;

use thiserror::Error;

use crate::backend::{Backend, BackendError};
use crate::control::ControlError;
use crate::diagram::DiagramError;
use crate::model::SystemError;
use crate::plane::{PlaneError, Provenance};

pub use begun::{Begun, of_begun};
pub use certify::{Certification, certify, certify_window};
pub use diagram::{diagram, traces};
pub use extents::measure_extents;
pub use map::{check, sweep, sweep_windows};
pub use sample::{sample, spread};
pub use stored::{Reopen, StoredError, StoredRun, sweep_stored};
pub use swept::Swept;

/// What a result of this back end is marked with.
pub fn provenance(backend: &dyn Backend) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        backend: backend.name().to_owned(),
        adapter: backend.adapter(),
    }
}

/// A plane or a diagram, or a part of it.
pub type Result<T, E = SweepError> = std::result::Result<T, E>;

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
    /// A cell cannot be controlled.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The verdicts do not fit into memory.
    #[error("the results of {0} cells do not fit into this machine's memory: compute fewer")]
    Memory(u64),
    /// The back end gave no verdicts.
    #[error(transparent)]
    Backend(#[from] BackendError),
}

impl SweepError {
    /// Whether it stands in the way of one cell alone: the motion that its control aims at does not exist, or cannot be held.
    fn is_of_one_cell(&self) -> bool {
        matches!(self, SweepError::Control(error) if error.is_of_one_system())
    }
}
