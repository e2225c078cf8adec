//! How many numbers a core computes with at once, and what is computed so, whatever there is to compute.

#[cfg(target_arch = "x86_64")]
use pulp::NullaryFnOnce;
#[cfg(target_arch = "x86_64")]
use pulp::x86::{V3, V4};

#[cfg(target_arch = "x86_64")]
use super::pack::Pack;
#[cfg(target_arch = "x86_64")]
use super::pair::Pair;
use super::real::{Lanes, Real};
#[cfg(target_arch = "x86_64")]
use super::registers::Packed;

/// How many numbers one core computes with at once, and so how many trajectories it follows; the bits of each are the same at every
/// width.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// One by one.
    One,
    /// One register of AVX2, with FMA: four numbers of f64, eight of f32. There are sixteen registers: of two side by side so much
    /// would lie in memory that a contact took longer by two fifths (Zen 3).
    #[cfg(target_arch = "x86_64")]
    Avx2,
    /// Two registers of AVX-512, of which there are thirty-two: sixteen numbers of f64, thirty-two of f32. A contact is a chain of
    /// operations that wait for each other, so that with one register the processor would wait, too.
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// A computation in lanes, which must give the same at every width.
pub(crate) trait AtWidth<T: Real> {
    /// What it gives.
    type Output;
    /// Whether it fills two registers side by side, where a width has them; else it has one, and half as many lanes.
    const PAIRED: bool = true;

    /// Computes it in lanes, of which 0 is given. To be inlined always: the instructions that it is compiled for are the caller's.
    fn call<L: Lanes<Real = T>>(self, zero: L) -> Self::Output;
}

/// A precision that is computed in at any width.
#[cfg(target_arch = "x86_64")]
pub(crate) trait AnyWidth: Packed<V3> + Packed<V4> {}

/// See there.
#[cfg(not(target_arch = "x86_64"))]
pub(crate) trait AnyWidth: Real {}

impl AnyWidth for f64 {}
impl AnyWidth for f32 {}

impl Width {
    /// All of them, the widest first.
    const ALL: &[Width] = &[
        #[cfg(target_arch = "x86_64")]
        Width::Avx512,
        #[cfg(target_arch = "x86_64")]
        Width::Avx2,
        Width::One,
    ];

    /// Whether this processor has it.
    fn is_available(self) -> bool {
        match self {
            Width::One => true,
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => V3::is_available(),
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => V4::is_available(),
        }
    }

    /// Every width that this processor has, the widest first.
    pub fn available() -> impl Iterator<Item = Width> {
        Width::ALL.iter().copied().filter(|width| width.is_available())
    }

    /// The widest of them.
    pub fn widest() -> Width {
        Width::available().next().unwrap_or(Width::One)
    }

    /// How many numbers of a precision at once.
    pub fn lanes<T: Real>(self) -> usize {
        match self {
            Width::One => 1,
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => 32 / size_of::<T>(),
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => 128 / size_of::<T>(),
        }
    }

    /// How many numbers of a precision at once, and the instructions that it needs.
    pub fn description<T: Real>(self) -> String {
        match self {
            Width::One => "one lane".to_owned(),
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => format!("{} lanes, AVX2", self.lanes::<T>()),
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => format!("{} lanes, AVX-512", self.lanes::<T>()),
        }
    }

    /// Computes something in as many lanes, in one register of them where it is not [`AtWidth::PAIRED`]; in one lane where the
    /// processor has not so many.
    #[inline]
    pub(crate) fn compute<T: AnyWidth, C: AtWidth<T>>(self, computation: C) -> C::Output {
        match self {
            Width::One => {}
            #[cfg(target_arch = "x86_64")]
            Width::Avx2 => {
                if let Some(simd) = V3::try_new() {
                    return simd
                        .vectorize(Wide::<_, _, false> { computation, zero: Pack::<_, T>::zero(simd) });
                }
            }
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => {
                if let Some(simd) = V4::try_new() {
                    return simd
                        .vectorize(Wide::<_, _, true> { computation, zero: Pack::<_, T>::zero(simd) });
                }
            }
        }
        computation.call(T::zero())
    }
}

/// A computation at a width, with the instructions that it is compiled for, in one register or in `TWO` if it fills them.
#[cfg(target_arch = "x86_64")]
struct Wide<C, P, const TWO: bool> {
    computation: C,
    /// In one register.
    zero: P,
}

#[cfg(target_arch = "x86_64")]
impl<C: AtWidth<P::Real>, P: Lanes, const TWO: bool> NullaryFnOnce for Wide<C, P, TWO> {
    type Output = C::Output;

    #[inline(always)]
    fn call(self) -> C::Output {
        if TWO && C::PAIRED {
            self.computation.call(Pair::both(self.zero))
        } else {
            self.computation.call(self.zero)
        }
    }
}

/// What a computation gives at every width that the processor has, in one lane last.
#[cfg(test)]
pub(super) fn at_every_width<T: AnyWidth, C: AtWidth<T> + Copy>(computation: C) -> Vec<C::Output> {
    Width::available().map(|width| width.compute(computation)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many lanes it is computed in.
    #[derive(Clone, Copy)]
    struct Counted<const PAIRED: bool>;

    impl<T: Real, const PAIRED: bool> AtWidth<T> for Counted<PAIRED> {
        type Output = usize;
        const PAIRED: bool = PAIRED;

        #[inline(always)]
        fn call<L: Lanes<Real = T>>(self, _: L) -> usize {
            L::WIDTH
        }
    }

    fn check<T: AnyWidth>() {
        let widths: Vec<Width> = Width::available().collect();
        let lanes: Vec<usize> = widths.iter().map(|width| width.lanes::<T>()).collect();
        println!("{}", widths.iter().map(|width| width.description::<T>()).collect::<Vec<_>>().join("; "));
        assert_eq!(at_every_width::<T, _>(Counted::<true>), lanes);
        let of_one_register = |width: &Width| match width {
            #[cfg(target_arch = "x86_64")]
            Width::Avx512 => 64 / size_of::<T>(),
            _ => width.lanes::<T>(),
        };
        let of_one_register: Vec<usize> = widths.iter().map(of_one_register).collect();
        assert_eq!(at_every_width::<T, _>(Counted::<false>), of_one_register);
        assert!(lanes.is_sorted_by(|a, b| a > b) && lanes.ends_with(&[1]), "{lanes:?}");
        let widest = Width::widest().compute::<T, _>(Counted::<true>);
        assert_eq!((Width::widest(), widest), (widths[0], lanes[0]));
    }

    #[test]
    fn as_many_lanes_as_a_width_has_are_computed_in() {
        check::<f64>();
        check::<f32>();
    }
}
