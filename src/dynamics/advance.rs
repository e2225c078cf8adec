//! One move of a trajectory, with the processor's instructions that multiply and add at once.

use pulp::NullaryFnOnce;

use super::contact;
use super::tangent::Variation;
use super::trajectory::{Event, Move, Trajectory};
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Moves on to the next event, the end of the step at the latest, and carries a variation along; `()` is none. What the
    /// variation is at the present point, [`Trajectory::present`] says.
    #[inline]
    pub fn advance<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let taken = if self.contact.is_free() {
            self.advance_freely(flight, variation)
        } else {
            self.advance_resting(flight, variation)
        };
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    #[inline(never)]
    fn advance_freely<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        T::fused(Advance::<_, _, _, FLIGHT> { trajectory: self, flight, variation })
    }

    #[inline(never)]
    fn advance_resting<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        T::fused(Advance::<_, _, _, REST> { trajectory: self, flight, variation })
    }

    /// Moves on like [`Trajectory::advance`] where the contact ahead is known not to be certain.
    #[inline(never)]
    pub(crate) fn advance_warily<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
    ) -> Move<T> {
        T::fused(Advance::<_, _, _, APPROACH> { trajectory: self, flight, variation })
    }

    /// Moves on like [`Trajectory::advance`], but passes over the ends of steps at which nothing happens.
    pub fn advance_to_event<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
    ) -> Move<T> {
        loop {
            let taken = self.advance(flight, variation);
            if taken.event != Event::StepEnd {
                return taken;
            }
        }
    }
}

/// The ways of a move: flight, flight towards a contact that is not certain, or rest on stops.
const FLIGHT: u8 = 0;
const APPROACH: u8 = 1;
const REST: u8 = 2;

/// A move that is yet to be made, in one of these ways.
struct Advance<'a, T, const N: usize, V, const WAY: u8> {
    trajectory: &'a mut Trajectory<T, N>,
    flight: &'a Flight<T, N>,
    variation: &'a mut V,
}

impl<T: Real, const N: usize, V: Variation<T, N>, const WAY: u8> NullaryFnOnce for Advance<'_, T, N, V, WAY> {
    type Output = Move<T>;

    #[inline(always)]
    fn call(self) -> Move<T> {
        let Advance { trajectory, flight, variation } = self;
        match WAY {
            FLIGHT => trajectory.fly(flight, variation),
            APPROACH => trajectory.approach(flight, variation),
            _ => trajectory.rest(flight, variation),
        }
    }
}
