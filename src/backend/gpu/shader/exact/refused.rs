//! What the pass does not take.

/// Why a kernel cannot be computed exactly.
pub type Refused = String;
