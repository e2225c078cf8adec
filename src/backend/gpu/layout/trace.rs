//! What the kernel `trace` reads and writes beyond what `follow` does.

use bytemuck::{Pod, Zeroable};

use super::follow::Schedule;

/// `TraceDispatch` in shaders/kernels/trace.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct TraceDispatch {
    pub schedule: Schedule,
    pub count: u32,
    pub budget: u32,
    pub begin: u32,
    pub row: u32,
    pub section: u32,
    pub reading: u32,
    pub capacity: u32,
    pub unused: u32,
}

/// `Rebounds` in shaders/analysis/rebounds.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Rebounds {
    pub last: f32,
    pub stop: u32,
    pub run: u32,
    pub longest: u32,
}

/// `Trace` in shaders/analysis/trace.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Trace {
    pub rebounds: Rebounds,
    pub passages: u32,
}
