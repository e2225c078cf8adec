//! Sticking: masses resting on stops, until what presses on a contact vanishes.

use super::contact;
use super::stop::{End, Stop};
use super::tangent::Tangent;
use super::trajectory::{Event, Move, Trajectory};
use crate::model::vector::dot;
use crate::model::{Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Sticking: the masses that are free move on until a stop is met, or what presses on a contact vanishes.
    #[inline(always)]
    pub(super) fn rest_inlined(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        let window = flight.h - self.offset;
        let contact = self.contact;
        let motion = self.point.motion(flight, contact);
        let least = flight.h * T::epsilon().sqrt();
        let clear = contact::safe_time(flight, &self.point, &motion, contact.with_opposite_ends(), window);
        if clear <= least
            && let Some(reached) = self.imminent(flight)
        {
            let event = self.strike(flight, tangents, reached);
            return Move { time: reached.left, contact, event };
        }
        let mut time = clear;
        for k in 0..flight.count {
            let Some(end) = contact.end_along(k).filter(|_| !contact.is_clamped_along(k)) else { continue };
            let sign = end.sign::<T>();
            let (force, slope) = (sign * motion.pressing[k], sign * motion.pressing_rate[k]);
            let bound = self.point.bound(flight, k);
            let unresolved = contact::unresolved(&flight.normals[k], end.side, &self.point.state);
            // What would open just before the step's end opens in the next one.
            if window > least && ((force <= unresolved && slope < T::zero()) || force < -unresolved) {
                return self.release(flight, tangents, end, bound);
            }
            let pressed = contact::pressed_time(force, slope, bound, window);
            let pressed = if pressed > least { pressed } else { least };
            time = if pressed < time { pressed } else { time };
        }
        if time >= window {
            self.glide(flight, tangents, window);
            return Move { time: window, contact, event: self.end_step(flight) };
        }
        self.glide(flight, tangents, time);
        Move { time, contact, event: Event::Flight }
    }

    /// A contact opens, from rest and without acceleration; the jerk alone pulls the masses off.
    #[inline(always)]
    fn release(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
        end: End,
        bound: T,
    ) -> Move<T> {
        let half_window = T::of(0.5) * (flight.h - self.offset);
        let least = flight.h * T::epsilon().sqrt();
        let before = self.contact;
        self.contact = before.without(end.normal);
        let motion = self.point.motion(flight, self.contact);
        let slope = end.sign::<T>() * dot(&flight.normals[end.normal].direction, &motion.jerk);
        let pulled = if slope < T::zero() { -slope / (bound + bound) } else { least };
        let pulled = if pulled > least { pulled } else { least };
        let ignored = self.contact.with_opposite_ends().with(end);
        let clear = contact::safe_time(flight, &self.point, &motion, ignored, half_window);
        let pulled = if pulled < clear { pulled } else { clear };
        let contact = self.contact;
        self.glide(flight, tangents, pulled);
        self.look_ahead(flight, tangents);
        let stop = Stop(flight.normals[end.normal].stop[end.side]);
        Move { time: pulled, contact, event: Event::Released(stop) }
    }
}

#[cfg(test)]
mod tests;
