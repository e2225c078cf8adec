//! Placeholder of the choice of a back end.

use serde::Serialize;

use super::{Backend, BackendError};

/// Which back end is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Choice {
    /// The fastest one.
    Auto,
    /// The GPU's kernel.
    Gpu,
    /// The CPU's reference.
    Cpu,
}

/// An adapter.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[allow(missing_docs)]
pub struct AdapterReport {
    pub name: String,
    pub driver: String,
    pub api: String,
    pub kind: String,
}

/// Opens a back end.
///
/// # Errors
/// There is none yet.
pub fn open(_choice: Choice, _adapter: Option<&str>) -> Result<Box<dyn Backend>, BackendError> {
    Err(BackendError::NoAdapter("no back end is there yet".to_owned()))
}

/// Lists the adapters.
pub fn adapters() -> Vec<AdapterReport> {
    Vec::new()
}
