//! What the kernel of extents reads and writes.

use strum::VariantArray;

use crate::analysis;
use crate::model::vector::MOST;

shared_struct! {
    /// What the kernel of extents is told.
    pub struct ExtentDispatch {
        /// Trajectories in this dispatch.
        pub count: u32,
        /// Moves that each of them may make.
        pub budget: u32,
        /// 1 in the first dispatch of a tile, which begins the trajectories; 0 in those that resume them.
        pub begin: u32,
        /// Invocations in one row of workgroups.
        pub row: u32,
    }
}

shared_struct! {
    /// How far a motion goes.
    pub struct Extent {
        /// An [`ExtentCode`].
        pub code: u32,
        pub mean_squares: [f32; MOST],
        pub peaks: [f32; MOST],
    }
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
