//! A picture without room for its figure.

use thiserror::Error;

/// A figure does not fit into a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "a picture of {width} × {height} pixels is too small for this figure: give at least \
     {least_width}x{least_height}"
)]
pub struct TooSmall {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Pixels across that are enough.
    pub least_width: u32,
    /// Pixels down that are enough.
    pub least_height: u32,
}
