//! Delayed feedback: Eq. (30), with the sign that stabilises.
//!
//! After K. Pyragas, Phys. Lett. A 170 (1992) 421–428, doi:10.1016/0375-9601(92)90745-8.

use super::action::{Action, Method, Seen};
use super::components::Components;
use super::memory::Memory;
use super::section_point::SectionPoint;
use super::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::Real;

/// Delayed feedback at work: X(n+1) = F(X(n)) + G (X(n) − X(n−p)).
///
/// Print has G (X(n−p) − X(n)), which is this with negative gains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// The diagonal of G, one for each component; its sign is the one above.
    pub gains: SectionValues<T>,
    /// p, in iterates.
    pub delay: u32,
}

impl<T: Real, const N: usize> Method<T, N> for Delay<T> {
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        if seen.memory.seen <= self.delay {
            return Action::none();
        }
        Action::correcting(self.feedback(&seen.memory.points[0].minus(&self.past(seen.memory))))
    }
}

impl<T: Real> Delay<T> {
    fn past<const N: usize>(&self, memory: &Memory<T, N>) -> SectionPoint<T, N> {
        memory.points[self.delay as usize]
    }

    /// G times a difference.
    #[inline(always)]
    pub fn feedback<const N: usize>(&self, difference: &Components<T, N>) -> Components<T, N> {
        Components::from_fn(|i| self.gains[i] * difference[i])
    }
}
