//! What a tile of trajectories is followed with, and one dispatch of it.

use crate::backend::gpu::shader;

/// Workgroups in one row of a dispatch; every adapter takes at least 65,535.
pub const ROW: u32 = 1 << 15;

/// What a tile of trajectories is followed with.
pub struct Program<'a, D> {
    pub kernel: shader::Kernel,
    /// Loop iterations in one move.
    pub iterations: u32,
    /// Buffers beyond those that every kernel has, in the order of their bindings.
    pub more: &'a [&'a wgpu::Buffer],
    /// The parameters of one dispatch: of so many trajectories, so many moves, the first or a later one.
    pub dispatch: &'a dyn Fn(Portion) -> D,
}

/// One dispatch of a tile.
#[derive(Clone, Copy)]
pub struct Portion {
    /// Trajectories.
    pub count: u32,
    /// Moves of each.
    pub budget: u32,
    /// 1 in the first dispatch, 0 in those that resume it.
    pub begin: u32,
}
