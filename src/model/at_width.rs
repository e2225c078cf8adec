//! What is computed in as many lanes as the processor has, whatever there is to compute.

#[cfg(target_arch = "x86_64")]
use pulp::NullaryFnOnce;

#[cfg(target_arch = "x86_64")]
use super::pack::Pack;
use super::real::Lanes;

/// A computation in lanes, which must give the same at every width.
pub(super) trait AtWidth {
    /// What it gives.
    type Output;

    /// Computes it in lanes, of which 0 is given.
    fn call<L: Lanes<Real = f64>>(self, zero: L) -> Self::Output;
}

/// Computes something in as many lanes as the processor has.
pub(super) fn at_width<C: AtWidth>(computation: C) -> C::Output {
    #[cfg(target_arch = "x86_64")]
    {
        if let Some(simd) = pulp::x86::V4::try_new() {
            return simd.vectorize(Wide { computation, zero: Pack::zero(simd) });
        }
        if let Some(simd) = pulp::x86::V3::try_new() {
            return simd.vectorize(Wide { computation, zero: Pack::zero(simd) });
        }
    }
    computation.call(0.0)
}

/// A computation at a width, with the instructions that it is compiled for.
#[cfg(target_arch = "x86_64")]
struct Wide<C, L> {
    computation: C,
    zero: L,
}

#[cfg(target_arch = "x86_64")]
impl<C: AtWidth, L: Lanes<Real = f64>> NullaryFnOnce for Wide<C, L> {
    type Output = C::Output;

    #[inline(always)]
    fn call(self) -> C::Output {
        self.computation.call(self.zero)
    }
}

/// What a computation gives at every width that the processor has, in one lane last.
#[cfg(test)]
pub(super) fn at_every_width<C: AtWidth + Copy>(computation: C) -> Vec<C::Output> {
    let mut found = Vec::new();
    #[cfg(target_arch = "x86_64")]
    {
        found.extend(
            pulp::x86::V4::try_new().map(|simd| simd.vectorize(Wide { computation, zero: Pack::zero(simd) })),
        );
        found.extend(
            pulp::x86::V3::try_new().map(|simd| simd.vectorize(Wide { computation, zero: Pack::zero(simd) })),
        );
    }
    found.push(computation.call(0.0));
    found
}
