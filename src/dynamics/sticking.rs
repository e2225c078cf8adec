//! Sticking: masses resting on stops, until what presses on a contact vanishes.

use super::contact;
use super::holding::{HELD_FLIGHTS, Pressed};
use super::point::{Motion, Point};
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
        let (time, point) = self.held_flight(flight, &motion, [time, clear], least);
        self.glide_to(flight, tangents, point, time);
        let event = if time >= window { self.end_step(flight) } else { Event::Flight };
        Move { time, contact, event }
    }

    /// A flight under the present contacts, as long as is found: `sure` ≤ `clear` is for how long they surely hold, reckoned from
    /// here alone, and `clear` for how long nothing else is met. They may hold up to `late` longer than they should.
    #[inline(always)]
    fn held_flight(
        &self,
        flight: &Flight<T, N>,
        motion: &Motion<T, N>,
        [sure, clear]: [T; 2],
        late: T,
    ) -> (T, Point<T, N>) {
        let (mut reach, mut tries) = (clear, 0);
        loop {
            let there = self.glided(flight, reach);
            tries += 1;
            if reach <= sure {
                return (reach, there);
            }
            let then = there.motion(flight, self.contact);
            let (mut next, mut lasts) = (clear, true);
            for k in 0..flight.count {
                let Some(pressed) = self.pressed(flight, [motion, &then], k, reach) else { continue };
                let (own, holds) = pressed.next(sure, late);
                next = if own < next { own } else { next };
                lasts &= holds;
            }
            let last = tries == HELD_FLIGHTS;
            if lasts && (last || next <= reach + late) {
                return (reach, there);
            }
            reach = if last { sure } else { next };
        }
    }

    /// What presses on the contact along a normal at both ends of a flight of length `time`; none where none holds, or both do.
    #[inline(always)]
    fn pressed(
        &self,
        flight: &Flight<T, N>,
        motions: [&Motion<T, N>; 2],
        k: usize,
        time: T,
    ) -> Option<Pressed<T>> {
        let end = self.contact.end_along(k).filter(|_| !self.contact.is_clamped_along(k))?;
        let sign = end.sign::<T>();
        Some(Pressed {
            forces: motions.map(|motion| sign * motion.pressing[k]),
            slopes: motions.map(|motion| sign * motion.pressing_rate[k]),
            bound: motions[0].bound(flight, k),
            time,
        })
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
