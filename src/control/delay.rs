//! Delayed feedback: Eq. (30), with the sign that stabilises.

use super::memory::Memory;
use super::method::{Action, Method, Seen};
use crate::model::Real;

/// Delayed feedback at work: X(n+1) = F(X(n)) + G (X(n) − X(n−p)).
///
/// Print has G (X(n−p) − X(n)), which is this with negative gains.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Delay<T> {
    /// The diagonal of G; its sign is the one above.
    pub gains: [T; 4],
    /// p, in iterates.
    pub delay: u32,
}

impl<T: Real> Method<T> for Delay<T> {
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T>) -> Action<T> {
        if seen.memory.seen <= self.delay {
            return Action::none();
        }
        Action::correcting(self.feedback(&seen.memory.points[0].minus(&self.past(seen.memory))))
    }
}

impl<T: Real> Delay<T> {
    fn past(&self, memory: &Memory<T>) -> super::Section<T> {
        memory.points[self.delay as usize]
    }

    /// G times a difference.
    pub fn feedback(&self, difference: &[T; 4]) -> [T; 4] {
        std::array::from_fn(|i| self.gains[i] * difference[i])
    }
}
