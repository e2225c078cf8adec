//! What trajectories side by side do: clear steps together, contacts when several wait for one.

use std::hint::black_box;

use super::abreast::Abreast;
use super::along::{Along, Alongs, is_normal};
use super::clock::Clock;
use super::crossing::crossing;
use super::hull::Span;
use super::leg::Leg;
use super::point::Point;
use super::tangent::Tangent;
use super::trajectory::MOST_KICKS;
use crate::model::{Lanes, Mask, State};

/// What a round of contacts led to, lane by lane (bit k for lane k).
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// The contact is not certain: it must be approached from the safe side.
    pub uncertain: u32,
    /// The step was completed, with an impact or without, at phase 0 or π where the lane is to be seen there.
    pub phases: u32,
}

impl<L: Lanes, const N: usize> Abreast<L, N> {
    /// Steps of every trajectory that is at the beginning of one, where it clears the stops; the others wait from then on. Until
    /// none can step, `enough` of them wait, or lanes come to phase 0 or π where they are to be seen there: these lanes, a bit for
    /// each.
    #[inline(always)]
    pub fn fly(&mut self, enough: u32) -> u32 {
        // As a rule the compiler knows how many normals there are; see [`Alongs`].
        match self.flight.count {
            1 => self.fly_along(1, enough),
            count => self.fly_along(count, enough),
        }
    }

    /// The same, for so many normals.
    #[inline(always)]
    fn fly_along(&mut self, count: usize, enough: u32) -> u32 {
        // Copies: a load of all lanes soon after a store to some of them waits for that store to end.
        let (mut point, mut tangent, mut clock) = (self.point, self.tangent.0, self.clock);
        let (mut ready, mut waits) = (self.steps, self.waits);
        let (mut phases, mut made) = (0, 0);
        let (mut from, span) = (Alongs::of(&point, &self.flight, count), Span::of(self.flight.h));
        // From nowhere nothing clears, and what did not clear is the same leg again: no other mask stands between a step and the next.
        from.set(0, Along { place: L::select(ready, from[0].place, span.time.all(f64::NAN)), ..from[0] });
        while phases == 0 && ready.bits() != 0 && waits.bits().count_ones() < enough {
            let flight = &self.flight;
            let may = ready;
            let ahead = point.stepped(flight);
            let leg = Leg::new(from, &ahead, span, flight);
            let moves = leg.clears(flight);
            let carried = ready.and(self.carries);
            if carried.bits() != 0 {
                // The constants are read again: without this hint they are copied to the stack above, carried or not.
                let stepped = Tangent(tangent).stepped_freely(black_box(flight)).0;
                tangent = State::select(carried, &stepped, &tangent);
            }
            waits = waits.or(ready.and(moves.not()));
            ready = moves;
            made += moves.bits().count_ones();
            self.usage.step_slots += L::WIDTH as u64;
            from = Alongs::select(moves, &leg.to, &from);
            let end = clock.exact(&ahead);
            point = Point::select(moves, &end, &point);
            phases = self.complete(may, moves, &end, &tangent, &mut clock);
        }
        (self.point, self.tangent.0, self.clock) = (point, tangent, clock);
        (self.steps, self.waits) = (ready, waits);
        self.usage.steps += u64::from(made);
        phases
    }

    /// The contacts of all trajectories that wait for one, and the rest of their step where it clears the stops. Those at the
    /// beginning of a step are looked at along with them: it costs nothing more, but for tangents that are carried, and they
    /// step, or meet their contact.
    #[inline(always)]
    pub fn cross(&mut self) -> Round {
        match self.flight.count {
            1 => self.cross_along(1),
            count => self.cross_along(count),
        }
    }

    /// The same, for so many normals.
    #[inline(always)]
    fn cross_along(&mut self, count: usize) -> Round {
        let (begin, carries) = (self.steps, self.carries);
        let waits = self.waits.or(begin);
        // Copies, here and below: a blend with what is stored already becomes a store where a mask holds, which takes some
        // processors ten times as long.
        let (mut point, kicks, offset, mut clock) = (self.point, self.kicks, self.offset, self.clock);
        let mut tangent = self.tangent;
        let flight = &self.flight;
        let carried = begin.and(carries);
        if carried.bits() != 0 {
            tangent.0 = State::select(carried, &tangent.stepped_freely(flight).0, &tangent.0);
        }
        let window = flight.h - offset;
        let (zero, one) = (window.all(0.0), window.all(1.0));
        let begins = kicks.below(one);
        let ahead = Point::select(begins, &point.stepped(flight), &self.ahead);
        let from = Alongs::select(begins, &Alongs::of(&point, flight, count), &self.along);
        let leg = Leg::new(from, &ahead, Span::of(window), flight);
        let clearances = leg.clearances(flight);
        let met = crossing(&leg, &clearances, flight);
        let few = kicks.below(window.all(f64::from(MOST_KICKS)));
        let clears = begin.and(clearances.all(count)).or(waits.and(met.passes).and(few));
        let struck = waits.and(met.certain).and(few);
        if struck.and(carries).bits() != 0 {
            let mut back = flight.normals[0].look_back(met.rest);
            for k in 1..count {
                back = State::select(is_normal(met.normal, k), &flight.normals[k].look_back(met.rest), &back);
            }
            let changed = tangent.struck_ahead(flight, &back, &met.impact);
            tangent.0 = State::select(struck.and(carries), &changed.0, &tangent.0);
        }
        self.tangent = tangent;
        let from = Alongs::select(struck, &met.after, &from);
        let normal = L::select(struck, met.normal, self.met);
        let ahead = Point::select(struck, &met.ahead, &ahead);
        let kicks = kicks + L::select(struck, one, zero);
        let offset = offset + L::select(struck, met.time, zero);
        let leg = Leg::new(from, &ahead, Span::of(flight.h - offset), flight);
        let moves = struck.and(leg.clears(flight)).or(clears);
        self.tally.count(flight, struck, carries, &met);
        let uncertain = waits.and(struck.or(clears).not()).bits();
        self.usage.contact_slots += L::WIDTH as u64;
        self.usage.contacts += u64::from(struck.bits().count_ones());
        self.usage.fallbacks += u64::from(uncertain.count_ones());
        (self.ahead, self.along, self.met) = (ahead, from, normal);
        (self.waits, self.steps) = (waits.and(moves.not()), moves);
        (self.offset, self.kicks) = (L::select(moves, zero, offset), L::select(moves, zero, kicks));
        let end = clock.exact(&ahead);
        point = Point::select(moves, &end, &point);
        let phases = self.complete(waits, moves, &end, &tangent.0, &mut clock);
        (self.point, self.clock) = (point, clock);
        Round { uncertain, phases }
    }

    /// Counts the step of some lanes, of those that may make it, which ends at a point with a deviation. Those that come to phase 0
    /// or π where they are to be seen there.
    #[inline(always)]
    fn complete(
        &mut self,
        may: L::Mask,
        moves: L::Mask,
        end: &Point<L, N>,
        tangent: &State<L, N>,
        clock: &mut Clock<L>,
    ) -> u32 {
        let comes_to_zero = clock.comes_to_zero();
        let halts = clock.arrives().and(self.halts);
        clock.count(moves);
        // Asked of all that may come there, not of those that do: the processor need not wait to know how it goes on.
        if may.and(comes_to_zero.or(halts)).bits() == 0 {
            return 0;
        }
        let (at_zero, halted) = (moves.and(comes_to_zero), moves.and(halts));
        let unseen = self.passing.pass(at_zero, &end.state, (tangent, self.carries), &mut self.tally);
        halted.or(at_zero.and(unseen.not())).bits()
    }
}
