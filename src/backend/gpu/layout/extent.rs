//! What the kernel of extents reads and writes.

use bytemuck::{Pod, Zeroable};
use strum::VariantArray;

use super::record::Record;
use crate::analysis;
use crate::model::vector::MOST;

/// `ExtentDispatch` in shaders/kernels/extent.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct ExtentDispatch {
    pub count: u32,
    pub budget: u32,
    pub begin: u32,
    pub row: u32,
}

/// `Extent` in shaders/analysis/extent.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub struct Extent {
    pub code: u32,
    pub mean_squares: [f32; MOST],
    pub peaks: [f32; MOST],
}

/// How far a shader has come with an extent; the codes in shaders/analysis/extent.wgsl are generated from here.
#[derive(Clone, Copy, Debug, VariantArray)]
#[repr(u32)]
pub enum ExtentCode {
    Done,
    Failed,
    Followed,
}

impl Extent {
    /// The extent of a motion in so many coordinates.
    pub fn widen(&self, coordinates: usize) -> analysis::Extent {
        if self.code != ExtentCode::Done as u32 {
            return analysis::Extent::NONE;
        }
        let of =
            |values: &[f32; MOST]| values[..coordinates].iter().map(|&v| f64::from(v)).collect::<Vec<_>>();
        analysis::Extent::of(&of(&self.mean_squares), &of(&self.peaks))
    }
}

impl Record for Extent {
    const PENDING: Self = Extent { code: u32::MAX, mean_squares: [0.0; MOST], peaks: [0.0; MOST] };

    fn is_pending(&self) -> bool {
        self.code == Self::PENDING.code
    }
}
