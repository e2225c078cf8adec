//! What is asked of an instruction set beyond what `pulp` has for all of them.

use std::fmt::Debug;

use pulp::Simd;

/// An instruction set with its truth values as bits: one instruction.
pub trait Registers: Simd {
    /// What lies on a boundary of a register's size.
    type Boundary: Copy + Debug + Send + Sync + 'static;

    /// A bit for each lane.
    fn bits(self, mask: Self::m64s) -> u32;
}

/// See [`Registers::Boundary`].
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
#[repr(align(32))]
pub struct OfFour;

/// See [`Registers::Boundary`].
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct OfEight;

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V3 {
    type Boundary = OfFour;

    #[inline(always)]
    fn bits(self, mask: Self::m64s) -> u32 {
        self.avx._mm256_movemask_pd(bytemuck::cast(mask)) as u32
    }
}

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V4 {
    type Boundary = OfEight;

    #[inline(always)]
    fn bits(self, mask: Self::m64s) -> u32 {
        u32::from(mask.0)
    }
}
