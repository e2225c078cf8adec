//! What every kernel's results have in common.

use bytemuck::Pod;

/// What a kernel writes for a trajectory when it is done.
pub trait Record: Pod {
    /// What the buffer holds until then.
    const PENDING: Self;

    /// Whether the shader has not written it yet.
    fn is_pending(&self) -> bool;
}
