//! Placeholder of the choice of a back end.

use serde::Serialize;

use super::{Backend, BackendError, Cpu};

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
/// No adapter is there.
pub fn open(choice: Choice, adapter: Option<&str>) -> Result<Box<dyn Backend>, BackendError> {
    match (choice, adapter) {
        (Choice::Gpu, None) => Err(BackendError::NoAdapter("no adapter was found".to_owned())),
        (_, Some(text)) => {
            Err(BackendError::NoAdapter(format!("no adapter matches `{text}`; there is none")))
        }
        _ => Ok(Box::new(Cpu)),
    }
}

/// Lists the adapters.
pub fn adapters() -> Vec<AdapterReport> {
    Vec::new()
}
