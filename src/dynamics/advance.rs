//! One move of a trajectory, with the processor's instructions that multiply and add at once.

use pulp::NullaryFnOnce;

use super::contact;
use super::tangent::{Tangent, Variation};
use super::trajectory::{Event, Move, Trajectory};
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Moves on to the next event, the end of the step at the latest, and carries a variation along; `()` is none. What the
    /// variation is at the present point, [`Trajectory::present`] says.
    #[inline]
    pub fn advance<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let tangents = variation.tangents();
        let taken = if self.contact.is_free() {
            self.advance_freely(flight, tangents)
        } else {
            self.advance_resting(flight, tangents)
        };
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    /// Moves on like [`Trajectory::advance`] where the contact ahead is known not to be certain.
    #[inline]
    pub(crate) fn advance_warily<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
    ) -> Move<T> {
        self.approach_warily(flight, variation.tangents())
    }

    #[inline(never)]
    fn advance_freely(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        T::fused(Advance::<_, _, FLIGHT> { trajectory: self, flight, tangents })
    }

    #[inline(never)]
    fn advance_resting(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        T::fused(Advance::<_, _, REST> { trajectory: self, flight, tangents })
    }

    #[inline(never)]
    pub(super) fn approach_warily(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
    ) -> Move<T> {
        T::fused(Advance::<_, _, APPROACH> { trajectory: self, flight, tangents })
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
struct Advance<'a, T, const N: usize, const WAY: u8> {
    trajectory: &'a mut Trajectory<T, N>,
    flight: &'a Flight<T, N>,
    tangents: &'a mut [Tangent<T, N>],
}

impl<T: Real, const N: usize, const WAY: u8> NullaryFnOnce for Advance<'_, T, N, WAY> {
    type Output = Move<T>;

    #[inline(always)]
    fn call(self) -> Move<T> {
        let Advance { trajectory, flight, tangents } = self;
        match WAY {
            FLIGHT => trajectory.fly(flight, tangents),
            APPROACH => trajectory.approach(flight, tangents),
            _ => trajectory.rest(flight, tangents),
        }
    }
}
