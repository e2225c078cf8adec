//! Whether the computation of curves was cancelled.

/// Says whether the curves were cancelled; asked at every step of every path.
#[derive(Clone, Copy)]
pub(super) struct Until<'a>(pub &'a (dyn Fn() -> bool + Sync));

impl Until<'_> {
    /// Whether whoever follows a path should leave it.
    pub fn is_over(self) -> bool {
        (self.0)()
    }
}
