//! What all kernels have in common: which trajectories are finished.

/// What a kernel writes over the number of a trajectory that it has finished.
pub const FINISHED: u32 = u32::MAX;
