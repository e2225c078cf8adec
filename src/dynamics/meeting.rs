//! A trajectory within a step of free flight, up to and through a contact that is met directly.

use super::along::Met;
use super::crossing::Crossing;
use super::placing::placed;
use super::point::Point;
use super::stop::{Contact, Stop};
use super::tangent::{Tangent, strike_all};
use super::trajectory::{Event, Impact, Move, Trajectory};
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// A trajectory within a step of free flight that is under way, where it was left; `met` is the last contact that was met
    /// directly in it, if there were any.
    pub(super) fn resumed(
        point: Point<T, N>,
        (ahead, kicks): (Point<T, N>, u32),
        step: u32,
        offset: T,
        met: Met<T>,
    ) -> Self {
        let met = (kicks > 0).then_some(met);
        Trajectory { point, ahead, kicks, contact: Contact::FREE, step, offset, under_way: true, met }
    }

    /// The present point: just after a contact that was met directly, where the end of the step was so long before, and exactly on
    /// the stop.
    #[inline]
    pub fn present(&self, flight: &Flight<T, N>) -> Point<T, N> {
        let Some(Met { normal, along }) = self.met else { return self.point };
        let before = self.ahead.flown(flight, self.offset - flight.h, Contact::FREE);
        Point { state: placed(&flight.normals[normal], &before.state, along[normal]), ..before }
    }

    /// Up to and through a contact that is certain.
    #[inline(always)]
    pub(super) fn cross(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        crossing: &Crossing<T, N>,
    ) -> Move<T> {
        let Crossing { time, rest, after, ahead, impact, rebound, .. } = *crossing;
        let normal = crossing.normal.widen() as usize;
        strike_all(tangents, flight, normal, rest, &impact);
        self.ahead = ahead;
        self.kicks += 1;
        self.offset = self.offset + time;
        self.met = Some(Met { normal, along: after });
        let stop = Stop(flight.normals[normal].stop[usize::from(!crossing.upper)]);
        let impact = Impact { stop, velocity_before: impact.velocity, velocity_after: rebound };
        Move { time, contact: Contact::FREE, event: Event::Impact(impact) }
    }
}
