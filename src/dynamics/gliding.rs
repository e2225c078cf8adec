//! A part of a step, with the contacts that hold.

use super::placing::rested;
use super::point::Point;
use super::tangent::{Tangent, fly_all};
use super::trajectory::Trajectory;
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Moves on for a time within the step, with the present contacts.
    #[inline(always)]
    pub(super) fn glide(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>], time: T) {
        let point = self.glided(flight, time);
        self.glide_to(flight, tangents, point, time);
    }

    /// Where it is a time later within the step, with the present contacts.
    #[inline(always)]
    pub(super) fn glided(&self, flight: &Flight<T, N>, time: T) -> Point<T, N> {
        let point = self.point.flown(flight, time, self.contact);
        Point { state: rested(flight, &point.state, self.contact), ..point }
    }

    /// Moves on to where it is a time later within the step, with the present contacts.
    #[inline(always)]
    pub(super) fn glide_to(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        point: Point<T, N>,
        time: T,
    ) {
        self.point = point;
        if !self.under_way {
            fly_all(tangents, flight, time, self.contact);
        }
        self.offset = self.offset + time;
    }
}
