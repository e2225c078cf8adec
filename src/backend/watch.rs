//! What a run reports while it goes on.

use super::error::{BackendError, Result};

/// Is told how a run goes on, and may end it.
pub trait Watch: Sync {
    /// `cells` more trajectories are finished.
    fn finished(&self, _cells: u64) {}

    /// Whether the run should stop at the next chance.
    fn cancelled(&self) -> bool;

    /// Ends the run here if it should stop.
    ///
    /// # Errors
    /// [`BackendError::Cancelled`].
    fn check(&self) -> Result<()> {
        if self.cancelled() { Err(BackendError::Cancelled) } else { Ok(()) }
    }
}

/// A watch that ignores what it is told and lets everything run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn cancelled(&self) -> bool {
        false
    }
}

/// A watch that ends a run like another, and counts nothing there: for cells that are counted elsewhere.
#[derive(Clone, Copy)]
pub struct Silent<'a>(pub &'a dyn Watch);

impl Watch for Silent<'_> {
    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}
