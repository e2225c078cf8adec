//! What is asked of an instruction set beyond what `pulp` has for all of them.

use pulp::Simd;

/// An instruction set with its truth values as bits: one instruction.
pub trait Registers: Simd {
    /// A bit for each lane.
    fn bits(self, mask: Self::m64s) -> u32;
}

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V3 {
    #[inline(always)]
    fn bits(self, mask: Self::m64s) -> u32 {
        self.avx._mm256_movemask_pd(bytemuck::cast(mask)) as u32
    }
}

#[cfg(target_arch = "x86_64")]
impl Registers for pulp::x86::V4 {
    #[inline(always)]
    fn bits(self, mask: Self::m64s) -> u32 {
        u32::from(mask.0)
    }
}
