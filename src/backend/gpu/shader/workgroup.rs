//! The size of a workgroup, which the shaders declare and their dispatch counts with.

/// Invocations in one workgroup.
pub const WORKGROUP: u32 = 32;
