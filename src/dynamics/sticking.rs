//! Sticking: masses resting on stops, until what presses on a contact vanishes.

use super::clear::clear_time;
use super::holding::{HELD_FLIGHTS, Pressed};
use super::point::{Motion, Point};
use super::pressing::Pressing;
use super::stop::{End, Stop};
use super::tangent::Tangent;
use super::trajectory::{Event, Move, Trajectory};
use crate::model::vector::dot;
use crate::model::{FAR, Flight, Real};

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// Sticking: the masses that are free move on until a stop is met, or what presses on a contact vanishes.
    #[inline(always)]
    pub(super) fn rest_inlined(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        let window = flight.h - self.offset;
        let contact = self.contact;
        let motion = self.point.motion(flight, contact);
        let least = flight.least();
        let clear = clear_time(flight, &self.point, &motion, [contact, contact.with_opposite_ends()], window);
        if clear <= least
            && let Some(reached) = self.imminent(flight)
        {
            let event = self.strike(flight, tangents, reached);
            return Move { time: reached.left, contact, event };
        }
        if clear >= flight.h
            && let Some(point) = self.rested_step(flight, &motion, least)
        {
            self.glide_to(flight, tangents, point, flight.h);
            return Move { time: flight.h, contact, event: self.end_step(flight) };
        }
        // What would open just before the step's end opens in the next one.
        if window > least
            && let Some(end) = self.opening(flight, &motion)
        {
            return self.release(flight, tangents, end);
        }
        let sure = self.surely_held(flight, &motion, clear, least);
        let (time, point) = self.held_flight(flight, &motion, [sure, clear], least);
        self.glide_to(flight, tangents, point, time);
        let event = if time >= window { self.end_step(flight) } else { Event::Flight };
        Move { time, contact, event }
    }

    /// Where a whole step under the present contacts leads, in which no other stop is met, if the contacts surely last: what
    /// [`Trajectory::held_flight`] comes to then. `late` is as there.
    #[inline(always)]
    fn rested_step(&self, flight: &Flight<T, N>, motion: &Motion<T, N>, late: T) -> Option<Point<T, N>> {
        let there = self.glided(flight, flight.h);
        let then = there.motion(flight, self.contact);
        let mut lasts = true;
        for k in 0..flight.count {
            let Some(end) = self.contact.opening_along(k) else { continue };
            let pressing = Pressing::on(flight, &self.point, motion, self.contact, end);
            let bound = motion.pressed_bound(flight, self.contact, k);
            let pressed = Pressed::over(flight.h, &pressing, &then, bound, end);
            lasts &= !pressing.opens & pressed.lasts(late);
        }
        lasts.then_some(there)
    }

    /// The first contact that opens now.
    #[inline(always)]
    fn opening(&self, flight: &Flight<T, N>, motion: &Motion<T, N>) -> Option<End> {
        (0..flight.count)
            .filter_map(|k| self.contact.opening_along(k))
            .find(|&end| Pressing::on(flight, &self.point, motion, self.contact, end).opens)
    }

    /// For how long, and no longer than `time`, the present contacts surely hold, reckoned from here alone; `least` where they do
    /// for less.
    #[inline(always)]
    fn surely_held(&self, flight: &Flight<T, N>, motion: &Motion<T, N>, time: T, least: T) -> T {
        let mut sure = time;
        for k in 0..flight.count {
            let Some(end) = self.contact.opening_along(k) else { continue };
            let pressing = Pressing::on(flight, &self.point, motion, self.contact, end);
            let bound = self.point.pressed_bound(flight, self.contact, k);
            let pressed = pressing.lasts(bound, time);
            let pressed = if pressed > least { pressed } else { least };
            sure = if pressed < sure { pressed } else { sure };
        }
        sure
    }

    /// A flight under the present contacts, as long as is found: `sure` ≤ `clear` is for how long they surely hold, reckoned from
    /// here alone, and `clear` for how long nothing else is met. They may hold about `late` longer than they should.
    #[inline(always)]
    fn held_flight(
        &self,
        flight: &Flight<T, N>,
        motion: &Motion<T, N>,
        [sure, clear]: [T; 2],
        late: T,
    ) -> (T, Point<T, N>) {
        // The longest flight that is known to last, and the shortest that is not.
        let (mut sure, mut failed) = (sure, T::of(FAR));
        let (mut reach, mut tries) = (clear, 0);
        loop {
            let there = self.glided(flight, reach);
            tries += 1;
            if reach <= sure || tries > HELD_FLIGHTS {
                return (reach, there);
            }
            let then = there.motion(flight, self.contact);
            let (mut next, mut lasts) = (clear, true);
            for k in 0..flight.count {
                let Some(end) = self.contact.opening_along(k) else { continue };
                let pressing = Pressing::on(flight, &self.point, motion, self.contact, end);
                let bound = motion.pressed_bound(flight, self.contact, k);
                let pressed = Pressed::over(reach, &pressing, &then, bound, end);
                let (own, holds) = pressed.next(sure, late);
                next = if own < next { own } else { next };
                lasts &= holds;
            }
            let last = tries == HELD_FLIGHTS;
            if lasts && (last || next <= reach + late || next >= failed) {
                return (reach, there);
            }
            (sure, failed) = if lasts { (reach, failed) } else { (sure, reach) };
            reach = if last { sure } else { next };
        }
    }

    /// A contact opens, from rest and without acceleration; the jerk alone pulls the masses off.
    #[inline(always)]
    fn release(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>], end: End) -> Move<T> {
        let bound = self.point.bound(flight, end.normal);
        let half_window = T::of(0.5) * (flight.h - self.offset);
        let least = flight.least();
        let before = self.contact;
        self.contact = before.without(end.normal);
        let motion = self.point.motion(flight, self.contact);
        let slope = end.sign::<T>() * dot(&flight.normals[end.normal].direction, &motion.jerk);
        let pulled = if slope < T::zero() { -slope / (bound + bound) } else { least };
        let pulled = if pulled > least { pulled } else { least };
        let ignored = self.contact.with_opposite_ends().with(end);
        let clear = clear_time(flight, &self.point, &motion, [self.contact, ignored], half_window);
        let pulled = if pulled < clear { pulled } else { clear };
        // What presses on the other contacts may vanish soon without this one.
        let pulled = self.surely_held(flight, &motion, pulled, least);
        let contact = self.contact;
        self.glide(flight, tangents, pulled);
        self.look_ahead(flight, tangents);
        let stop = Stop(flight.normals[end.normal].stop[end.side]);
        Move { time: pulled, contact, event: Event::Released(stop) }
    }
}

#[cfg(test)]
mod tests;
