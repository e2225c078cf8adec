//! The size of a workgroup, which the shaders declare and their dispatch counts with.

/// Invocations in one workgroup: those of a warp, on NVIDIA's cards; others were not measured.
pub const WORKGROUP: u32 = 32;
