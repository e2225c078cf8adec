//! Trajectories in free flight side by side, one in each lane: clear steps together, contacts when several wait for one.

use std::hint::black_box;

use super::along::{Along, Met, is_normal};
use super::clock::Clock;
use super::crossing::crossing;
use super::hull::Span;
use super::leg::Leg;
use super::moves::Moves;
use super::passing::{Passing, Unseen};
use super::point::Point;
use super::tally::Tally;
use super::tangent::Tangent;
use super::trajectory::{MOST_KICKS, Trajectory};
use super::usage::Usage;
use crate::model::vector::MOST;
use crate::model::{Flight, Lanes, Mask, Real, State};

/// As many trajectories as there are lanes, each of them in free flight, or none in its lane.
///
/// What [`Trajectory::advance`] does to one of them happens here to all that are ready for it, operation by operation, so
/// that the bits are the same.
#[derive(Debug)]
pub struct Abreast<L: Lanes, const N: usize> {
    flight: Flight<L, N>,
    /// The beginning of the step under way.
    point: Point<L, N>,
    /// The end of the step under way, where something was met in it.
    ahead: Point<L, N>,
    /// Where it is along each normal then: `point` is the beginning of the step still.
    along: [Along<L>; MOST],
    /// The number of the normal that was met last.
    met: L,
    tangent: Tangent<L, N>,
    offset: L,
    /// Impacts in the step under way; where there was none it is at its beginning, and its end is found again for a contact.
    kicks: L,
    clock: Clock<L>,
    /// Where a trajectory is at the beginning of a step.
    steps: L::Mask,
    /// Where the rest of the step does not clear the stops; the tangent is that of the end of the step there.
    waits: L::Mask,
    /// Where the tangent is carried along.
    carries: L::Mask,
    /// Where the trajectory is to be seen at phase π too.
    halts: L::Mask,
    passing: Passing<L, N>,
    tally: Tally<L>,
    usage: Usage,
}

/// What a round of contacts led to, lane by lane (bit k for lane k).
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// The contact is not certain: it must be approached from the safe side.
    pub uncertain: u32,
    /// The step was completed, with an impact or without, at phase 0 or π where the lane is to be seen there.
    pub phases: u32,
}

impl<L: Lanes, const N: usize> Abreast<L, N> {
    /// Empty lanes for cells of so many contact normals.
    pub fn new(zero: L, normals: usize) -> Self {
        let vector = [zero; N];
        let state = State { x: vector, v: vector };
        let point = Point { state, sin: zero, cos: zero };
        let never = zero.below(zero);
        Abreast {
            flight: Flight::blank(normals, zero),
            point,
            ahead: point,
            along: [Along { place: zero, speed: zero }; MOST],
            met: zero,
            tangent: Tangent(state),
            offset: zero,
            kicks: zero,
            clock: Clock::stopped(zero),
            steps: never,
            waits: never,
            carries: never,
            halts: never,
            passing: Passing::none(zero),
            tally: Tally::none(zero),
            usage: Usage::default(),
        }
    }

    /// Puts the constants of a cell into a lane.
    pub fn prepare(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        self.flight.set_lane(lane, flight);
        self.clock.prepare(lane, flight.steps);
    }

    /// Puts the stops of a cell into a lane that has the constants of another with the same flow.
    pub fn restop(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        self.flight.restop_lane(lane, flight);
    }

    /// Puts a trajectory at the beginning of a step of free flight into a lane.
    pub fn seat(&mut self, lane: usize, flight: &Flight<L::Real, N>, trajectory: &Trajectory<L::Real, N>) {
        debug_assert!(trajectory.begins_free_step());
        let number = |value: f64| L::Real::of(value);
        self.point.set_lane(lane, &trajectory.point);
        self.offset.set_lane(lane, number(0.0));
        self.kicks.set_lane(lane, number(0.0));
        self.clock.set_lane(lane, flight.steps, trajectory.step);
        self.steps.set_lane(lane, true);
        self.waits.set_lane(lane, false);
    }

    /// Sums up in a lane what impacts come to from here, on top of what they came to before.
    #[inline(always)]
    pub fn begin_tally(&mut self, lane: usize, fastest: L::Real, energy: L::Real, moves: Moves) {
        self.tally.begin(lane, fastest, energy, L::Real::of(f64::from(moves.count())));
    }

    /// What the impacts in a lane came to, and how often it passed phase 0 unseen; all that is counted anew from here.
    #[inline(always)]
    pub fn take_tally(&mut self, lane: usize) -> Tally<L::Real> {
        self.tally.take(lane, self.flight.count)
    }

    /// Carries a tangent along in a lane, or none.
    #[inline(always)]
    pub fn set_tangent(&mut self, lane: usize, tangent: Option<&Tangent<L::Real, N>>) {
        self.carries.set_lane(lane, tangent.is_some());
        if let Some(tangent) = tangent {
            self.tangent.0.set_lane(lane, &tangent.0);
        }
    }

    /// Sees a lane at phase π too, or at phase 0 alone.
    #[inline(always)]
    pub fn set_halt(&mut self, lane: usize, halts: bool) {
        self.halts.set_lane(lane, halts);
    }

    /// Lets a lane pass phase 0 unseen from here on, so often.
    #[inline(always)]
    pub fn set_unseen(&mut self, lane: usize, unseen: &Unseen<L::Real, N>) {
        self.passing.set_lane(lane, unseen);
    }

    /// Leaves a lane empty.
    pub fn vacate(&mut self, lane: usize) {
        self.steps.set_lane(lane, false);
        self.waits.set_lane(lane, false);
    }

    /// The trajectory in a lane that waits for a contact, `flight` being its cell's.
    pub fn trajectory(&self, lane: usize, flight: &Flight<L::Real, N>) -> Trajectory<L::Real, N> {
        debug_assert!((self.waits.bits() >> lane) & 1 == 1);
        let normal = self.met.lane(lane).widen() as usize;
        Trajectory::resumed(
            self.point.lane(lane),
            (self.ahead.lane(lane), self.kicks.lane(lane).widen() as u32),
            self.clock.step(lane, flight.steps),
            self.offset.lane(lane),
            Met { normal, along: self.along.map(|along| along.lane(lane)) },
        )
    }

    /// The point in a lane.
    #[inline(always)]
    pub fn point(&self, lane: usize) -> Point<L::Real, N> {
        self.point.lane(lane)
    }

    /// Whether the last of the phases 0 and π that a lane's trajectory passed was π.
    #[inline(always)]
    pub fn is_past_half(&self, lane: usize) -> bool {
        self.clock.is_past_half(lane)
    }

    /// The tangent in a lane, as its trajectory there is resumed with it.
    #[inline(always)]
    pub fn tangent(&self, lane: usize) -> Tangent<L::Real, N> {
        Tangent(self.tangent.0.lane(lane))
    }

    /// How well the lanes were used so far.
    pub fn usage(&self) -> Usage {
        self.usage
    }

    /// Steps of every trajectory that is at the beginning of one, where it clears the stops; the others wait from then on. Until
    /// none can step, `enough` of them wait, or lanes come to phase 0 or π where they are to be seen there: these lanes, a bit for
    /// each.
    #[inline(always)]
    pub fn fly(&mut self, enough: u32) -> u32 {
        // Copies: a load of all lanes soon after a store to some of them waits for that store to end.
        let (mut point, mut tangent, mut clock) = (self.point, self.tangent.0, self.clock);
        let (mut ready, mut waits) = (self.steps, self.waits);
        let (mut phases, mut made) = (0, 0);
        let (mut from, span) = (Along::each(&point, &self.flight), Span::of(self.flight.h));
        // From nowhere nothing clears, and what did not clear is the same leg again: no other mask stands between a step and the next.
        from[0].place = L::select(ready, from[0].place, span.time.all(f64::NAN));
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
            from = Along::select_each(moves, &leg.to, &from, flight.count);
            let end = clock.exact(&ahead);
            point = Point::select(moves, &end, &point);
            phases = self.complete(may, moves, &end, &mut clock);
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
        let from = Along::select_each(begins, &Along::each(&point, flight), &self.along, flight.count);
        let leg = Leg::new(from, &ahead, Span::of(window), flight);
        let clearances = leg.clearances(flight);
        let met = crossing(&leg, &clearances, flight);
        let few = kicks.below(window.all(f64::from(MOST_KICKS)));
        let clears = begin.and(clearances.all(flight.count)).or(waits.and(met.passes).and(few));
        let struck = waits.and(met.certain).and(few);
        if struck.and(carries).bits() != 0 {
            let mut back = flight.normals[0].look_back(met.rest);
            for k in 1..flight.count {
                back = State::select(is_normal(met.normal, k), &flight.normals[k].look_back(met.rest), &back);
            }
            let changed = tangent.struck_ahead(flight, &back, &met.impact);
            tangent.0 = State::select(struck.and(carries), &changed.0, &tangent.0);
        }
        self.tangent = tangent;
        let from = Along::select_each(struck, &met.after, &from, flight.count);
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
        let phases = self.complete(waits, moves, &end, &mut clock);
        (self.point, self.clock) = (point, clock);
        Round { uncertain, phases }
    }

    /// Counts the step of some lanes, of those that may make it, which ends at a point. Those that come to phase 0 or π where they
    /// are to be seen there.
    #[inline(always)]
    fn complete(&mut self, may: L::Mask, moves: L::Mask, end: &Point<L, N>, clock: &mut Clock<L>) -> u32 {
        let comes_to_zero = clock.comes_to_zero();
        let halts = clock.arrives().and(self.halts);
        clock.count(moves);
        // Asked of all that may come there, not of those that do: the processor need not wait to know how it goes on.
        if may.and(comes_to_zero.or(halts)).bits() == 0 {
            return 0;
        }
        let (at_zero, halted) = (moves.and(comes_to_zero), moves.and(halts));
        let unseen = self.passing.pass(at_zero, &end.state, &mut self.tally);
        halted.or(at_zero.and(unseen.not())).bits()
    }
}
