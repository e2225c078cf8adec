//! What a control method sees at a return to σ, and what it does there: it sets a correction or a force.

use super::components::Components;
use super::memory::Memory;
use super::section_point::SectionPoint;
use crate::model::Real;

/// What a method sees at a return to σ.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a, T, const N: usize> {
    /// F(X(n)), the point as it arrives.
    pub section: SectionPoint<T, N>,
    /// Forcing periods since the last return, as a real number.
    pub turns: T,
    /// Whole forcing periods since the start of the trajectory.
    pub periods: u32,
    /// Iterates since control was switched on; 0 at the first.
    pub controlled: u32,
    /// X(n), X(n−1), …
    pub memory: &'a Memory<T, N>,
}

/// What a method does at a return to σ; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action<T, const N: usize> {
    /// What is added to the point.
    pub correction: Components<T, N>,
    /// B of a force on one coordinate until the next return.
    pub force: T,
    /// The sine and cosine of its phase now.
    pub phase: [T; 2],
    /// The control signal: B, or the length of the correction.
    pub signal: T,
}

impl<T: Real, const N: usize> Action<T, N> {
    /// No correction and no force.
    pub fn none() -> Self {
        Action::correcting(Components::zero())
    }

    /// A correction and no force.
    pub fn correcting(correction: Components<T, N>) -> Self {
        let signal = correction.length();
        Action { correction, force: T::zero(), phase: [T::zero(), T::one()], signal }
    }
}
