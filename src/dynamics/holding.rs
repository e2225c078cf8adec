//! How long a mass surely stays on its stop: what presses on the contact, looked at from both ends of a flight under it.

use super::hull::{Hull, SWELLING, Span};
use super::point::Motion;
use super::pressing::Pressing;
use super::quintic::Quintic;
use super::stop::End;
use crate::model::{FAR, Real};

/// Flights that are tried in one move under contacts, before the one for which they surely hold as reckoned from its beginning
/// alone: as long as nothing else is met, to where a contact seems to open, and there again from nearer.
pub const HELD_FLIGHTS: u32 = 4;

/// How much of a force what is not known of it may take, for the force to be seen to last.
pub const SEEN: f64 = 0.875;

/// What presses on a contact at the beginning and at the end of a flight under it, as an acceleration towards the stop.
#[derive(Clone, Copy, Debug)]
pub struct Pressed<T> {
    /// At the two ends.
    pub forces: [T; 2],
    /// Their derivatives.
    pub slopes: [T; 2],
    /// A bound on the fourth derivative in between.
    pub bound: T,
    /// How long the flight takes.
    pub time: T,
}

impl<T: Real> Pressed<T> {
    /// On the stop at an end, between what presses on it now and a motion a time later; by the slack more than it does.
    #[inline(always)]
    pub fn over<const N: usize>(
        time: T,
        pressing: &Pressing<T>,
        then: &Motion<T, N>,
        bound: T,
        end: End,
    ) -> Self {
        let Pressing { force, slope, slack, .. } = *pressing;
        let [force_then, slope_then] = then.pressure(end);
        Pressed { forces: [force + slack, force_then + slack], slopes: [slope, slope_then], bound, time }
    }

    /// Whether it surely presses all the time, but for about the last `late` of it, as it does at the beginning: its [`Hull`]
    /// does.
    #[inline(always)]
    pub fn lasts(&self, late: T) -> bool {
        let Pressed { forces, slopes, bound, time } = *self;
        let hull = Hull::of(forces, slopes, bound, &Span::of(time));
        hull.lowest() > T::zero() && forces[1] >= -(late * slopes[1].abs())
    }

    /// About when it vanishes: where the cubic through both ends does, by Newton's method, before the end where it does not press
    /// there, else after it. [`FAR`] where it presses there and does not fall.
    #[inline(always)]
    pub fn vanishes(&self) -> T {
        let Pressed { forces, slopes, time, .. } = *self;
        let opens = forces[1] < T::zero();
        if !opens && slopes[1] >= T::zero() {
            return T::of(FAR);
        }
        let start = if opens { Quintic::chord(forces, -(slopes[0] * time)) } else { T::one() };
        Quintic::cubic(forces, slopes, time).root(start) * time
    }

    /// About for how long it would be seen to press if it went on as between both ends of this time: until what its bound says of the
    /// way is as much as there is. 0 where it does not press between them.
    #[inline(always)]
    fn seen(&self) -> T {
        let Pressed { forces, slopes, bound, time } = *self;
        let lowest = Hull::of(forces, slopes, T::zero(), &Span::of(time)).lowest();
        let lowest = if forces[0] < lowest { forces[0] } else { lowest };
        let square = lowest * T::of(SEEN / SWELLING) / bound;
        if square > T::zero() { square.sqrt().sqrt() } else { T::zero() }
    }

    /// How long a flight is to be tried next, and whether this one may be made: `sure` is for how long the contact is known to hold,
    /// `late` about how long it may after nothing presses.
    #[inline(always)]
    pub fn next(&self, sure: T, late: T) -> (T, bool) {
        // A little beyond, for the contact to open there whatever rounding adds.
        let vanishes = self.vanishes() + late * T::of(0.5);
        if self.lasts(late) {
            return (if vanishes > self.time { vanishes } else { self.time }, true);
        }
        if vanishes > sure && vanishes < self.time {
            return (vanishes, false);
        }
        // What bounds the force may be too far from it to see that it lasts.
        let seen = self.seen();
        let next = if seen > sure { seen } else { (sure * self.time).sqrt() };
        (if next > sure && next < self.time { next } else { sure }, false)
    }
}

#[cfg(test)]
mod tests;
