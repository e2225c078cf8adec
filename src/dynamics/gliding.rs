//! A part of a step, with the contacts that hold.

use super::placing::rested;
use super::point::Point;
use super::stop::Contact;
use super::tangent::{Tangent, fly_all};
use super::trajectory::Trajectory;
use crate::model::{Flight, Real, Step};

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
        let point = match whole_step(flight, self.contact, time) {
            Some(step) => self.point.stepped_by(step, flight),
            None => self.point.flown(flight, time, self.contact),
        };
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
            match whole_step(flight, self.contact, time) {
                Some(step) => {
                    for tangent in tangents {
                        *tangent = Tangent(step.of_deviation(&tangent.0));
                    }
                }
                None => fly_all(tangents, flight, time, self.contact),
            }
        }
        self.offset = self.offset + time;
    }
}

/// What a flight of such a length does at once: a whole step under contacts along one normal.
#[inline(always)]
fn whole_step<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
    time: T,
) -> Option<&Step<T, N>> {
    let held = contact.held();
    (held.is_power_of_two() && time == flight.h).then(|| &flight.normals[held.trailing_zeros() as usize].held)
}

#[cfg(test)]
mod tests;
