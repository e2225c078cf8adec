//! One move of a trajectory, with the processor's instructions that multiply and add at once.

use pulp::NullaryFnOnce;

use super::contact;
use super::tangent::Variation;
use super::trajectory::{Event, Move, Trajectory};
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Moves on to the next event, the end of the step at the latest, and carries a variation along; `()` is none. What the
    /// variation is at the present point, [`Trajectory::present`] says.
    #[inline(never)]
    pub fn advance<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let taken = T::fused(Advance::<_, _, _, false> { trajectory: self, flight, variation });
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    /// Moves on like [`Trajectory::advance`] where the contact ahead is known not to be certain.
    #[inline(never)]
    pub(crate) fn advance_warily<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
    ) -> Move<T> {
        T::fused(Advance::<_, _, _, true> { trajectory: self, flight, variation })
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

/// A move that is yet to be made, towards a contact that is known not to be certain if `WARILY`.
struct Advance<'a, T, const N: usize, V, const WARILY: bool> {
    trajectory: &'a mut Trajectory<T, N>,
    flight: &'a Flight<T, N>,
    variation: &'a mut V,
}

impl<T: Real, const N: usize, V: Variation<T, N>, const WARILY: bool> NullaryFnOnce
    for Advance<'_, T, N, V, WARILY>
{
    type Output = Move<T>;

    #[inline(always)]
    fn call(self) -> Move<T> {
        let Advance { trajectory, flight, variation } = self;
        if WARILY {
            trajectory.approach(flight, variation)
        } else if trajectory.contact.is_free() {
            trajectory.fly(flight, variation)
        } else {
            trajectory.rest(flight, variation)
        }
    }
}
