//! One move of a trajectory, with the processor's instructions that multiply and add at once.
//!
//! Each way of a move is compiled once, with these instructions, and not wherever a trajectory moves.

use pulp::NullaryFnOnce;

use super::contact;
use super::tangent::Tangent;
use super::trajectory::{Event, Move, Trajectory};
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Moves on to the next event, the end of the step at the latest, and carries any number of tangents along. What these are at
    /// the present point, [`Trajectory::bring_back`] says.
    #[inline]
    pub fn advance(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        let taken = self.advance_blindly(flight, tangents);
        self.point = self.present(flight);
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    /// Moves on like [`Trajectory::advance`], but leaves the point of an impact to [`Trajectory::present`]: who goes on does not need
    /// it.
    #[inline]
    pub fn advance_blindly(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        if self.contact.is_free() { self.fly(flight, tangents) } else { self.rest(flight, tangents) }
    }

    /// Moves on like [`Trajectory::advance`], but passes over the ends of steps at which nothing happens.
    pub fn advance_to_event(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        loop {
            let taken = self.advance(flight, tangents);
            if taken.event != Event::StepEnd {
                return taken;
            }
        }
    }

    /// A move in free flight.
    #[inline(never)]
    fn fly(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        T::fused(Advance::<_, _, FLIGHT> { trajectory: self, flight, tangents })
    }

    /// A move in free flight where the contact ahead is known not to be certain: only as far as is safe.
    #[inline(never)]
    pub(crate) fn approach(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        T::fused(Advance::<_, _, APPROACH> { trajectory: self, flight, tangents })
    }

    /// A move in contact.
    #[inline(never)]
    fn rest(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        T::fused(Advance::<_, _, REST> { trajectory: self, flight, tangents })
    }
}

/// The way of a move in free flight.
const FLIGHT: u8 = 0;
/// The way of one towards a contact that is not certain.
const APPROACH: u8 = 1;
/// The way of one in contact.
const REST: u8 = 2;

/// A move that is yet to be made, in one of these ways; a type of its own, as [`Flown`](super::series::Flown) is.
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
            FLIGHT => trajectory.fly_inlined(flight, tangents),
            APPROACH => trajectory.approach_inlined(flight, tangents),
            REST => trajectory.rest_inlined(flight, tangents),
            _ => unreachable!("there are three ways"),
        }
    }
}
