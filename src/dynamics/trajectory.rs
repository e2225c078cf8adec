//! One trajectory: steps of flight, impacts, chatter, sticking, until it has gone as far as was asked.

use super::chatter::{self, Closure, Rebound};
use super::contact::{self, Reached};
use super::corner;
use super::drive::Drive;
use super::placing::{clamped, placed, rested};
use super::point::{Approach, Motion, Point};
use super::stop::{Contact, End, Stop};
use super::tangent::{Saltation, Variation};
use crate::model::vector::{added, applied, axpy, dot};
use crate::model::{Flight, Real, State};

/// The most kicks that are added to the end of one step; after more, the step is flown to its end instead.
pub const MOST_KICKS: u32 = 4;

/// Moves in one forcing period beyond which a trajectory is given up.
pub const MOST_MOVES: u32 = 1 << 24;

/// An impact: d·v+ = −r d·v− along its normal, v+ = v− + (d·v+ − d·v−) M⁻¹d/(dᵀM⁻¹d).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<T> {
    /// Where.
    pub stop: Stop,
    /// d·v−, d being the direction of the first stop on this normal.
    pub velocity_before: T,
    /// d·v+ = −r d·v−.
    pub velocity_after: T,
}

/// What ended a move of a trajectory.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event<T> {
    /// Nothing: a part of a step.
    Flight,
    /// The end of a step.
    StepEnd,
    /// Phase π, in the middle of the forcing period.
    HalfPeriod,
    /// Phase 0: a forcing period is complete.
    Strobe,
    /// An impact after which the masses part from the stop.
    Impact(Impact<T>),
    /// An impact that ends in sticking; `complete_chatter` if infinitely many rebounds were closed with it.
    Caught {
        /// The impact; its speed is 0 where a mass came to rest on the stop without one.
        impact: Impact<T>,
        /// Whether rebounds follow it, infinitely many in finite time.
        complete_chatter: bool,
        /// The stops beside this one that share these rebounds, and hold as well now; seldom any.
        beside: Contact,
    },
    /// What pressed on a contact vanished, and it opens.
    Released(Stop),
}

/// A move: how long it took, with what contacts, and what ended it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move<T> {
    /// Its duration; non-dimensional.
    pub time: T,
    /// The contacts that held during it.
    pub contact: Contact,
    /// What happened at its end.
    pub event: Event<T>,
}

/// A trajectory: where it is, and how it moves on.
///
/// Time is never summed up: the place is a step within the forcing period and an offset within the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<T, const N: usize, D = ()> {
    /// The present state and forcing phasor.
    pub point: Point<T, N, D>,
    /// Where the present step ends if nothing more is met on the way; known in free flight.
    ahead: Point<T, N, D>,
    /// Kicks that were added to it, each with its rounding.
    kicks: u32,
    /// What is in contact.
    pub contact: Contact,
    /// The step within the forcing period, 0 ≤ step < M.
    pub step: u32,
    /// The time since the beginning of the step, 0 ≤ offset < h.
    pub offset: T,
}

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// A trajectory that begins at forcing phase 0 with a state within the stops.
    pub fn new(flight: &Flight<T, N>, start: State<T, N>) -> Self {
        let contact = clamped(flight);
        let point = Point::at_phase_zero(rested(flight, &start, contact));
        Trajectory { point, ahead: point, kicks: 0, contact, step: 0, offset: T::zero() }
    }

    /// A trajectory that begins at forcing phase `phase`, 0 ≤ phase < 2π, with a state within the stops.
    pub fn at_phase(flight: &Flight<T, N>, state: State<T, N>, phase: f64) -> Self {
        let steps = phase / std::f64::consts::TAU * f64::from(flight.steps);
        let step = (steps as u32).min(flight.steps - 1);
        let (sin, cos) = phase.sin_cos();
        let contact = clamped(flight);
        let state = rested(flight, &state, contact);
        let point = Point { state, sin: T::of(sin), cos: T::of(cos), one: T::one(), drive: () };
        let offset = T::of((steps - f64::from(step)) * flight.h.widen());
        Trajectory::from_point(flight, point, contact, step, offset)
    }
}

impl<T: Real, const N: usize, D: Drive<T, N>> Trajectory<T, N, D> {
    /// A trajectory that goes on from a point at a time `offset`, 0 ≤ offset < h, after the beginning of a step.
    ///
    /// The point's phasor must be that of this time.
    pub fn from_point(
        flight: &Flight<T, N>,
        point: Point<T, N, D>,
        contact: Contact,
        step: u32,
        offset: T,
    ) -> Self {
        let ahead = if contact.is_free() { point.flown(flight, flight.h - offset, contact) } else { point };
        Trajectory { point, ahead, kicks: 0, contact, step, offset }
    }

    /// Moves on to the next event, the end of the step at the latest, and carries a variation along; `()` is none.
    #[inline(always)]
    pub fn advance<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let taken =
            if self.contact.is_free() { self.fly(flight, variation) } else { self.rest(flight, variation) };
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    /// Moves on like [`Trajectory::advance`], but passes over the ends of steps at which nothing happens.
    #[inline(always)]
    pub fn advance_to_event<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
    ) -> Move<T> {
        loop {
            let taken = self.advance(flight, variation);
            if taken.event != Event::StepEnd {
                return taken;
            }
        }
    }

    /// Free flight: a whole step where it provably clears the stops, else as far as is safe.
    #[inline(always)]
    fn fly<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let window = flight.h - self.offset;
        let contact = Contact::FREE;
        if self.offset == T::zero() {
            self.ahead = self.point.stepped(flight);
            self.kicks = 0;
            if contact::clears(flight, &self.point, &self.ahead) {
                return self.go_ahead(flight, variation, window);
            }
        }
        let motion = self.point.motion(flight, contact);
        let time = contact::safe_time(flight, &self.point, &motion, contact, window);
        if time >= window {
            return self.go_ahead(flight, variation, window);
        }
        self.glide(flight, variation, time);
        match self.imminent(flight) {
            None => Move { time, contact, event: Event::Flight },
            Some(reached) => {
                let event = self.strike(flight, variation, reached);
                Move { time: time + reached.left, contact, event }
            }
        }
    }

    /// The stop that is reached in one straight line within the step; a contact beyond its end belongs to the next one.
    #[inline(always)]
    fn imminent(&self, flight: &Flight<T, N>) -> Option<Reached<T>> {
        contact::imminent(flight, &self.point, self.contact)
            .filter(|reached| self.offset + reached.left <= flight.h)
    }

    /// The rest of a step, known to clear the stops.
    #[inline(always)]
    fn go_ahead<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
        window: T,
    ) -> Move<T> {
        let contact = Contact::FREE;
        self.point =
            if self.kicks <= MOST_KICKS { self.ahead } else { self.point.flown(flight, window, contact) };
        *variation = if self.offset == T::zero() {
            variation.stepped(flight)
        } else {
            variation.flown(flight, window, contact)
        };
        Move { time: window, contact, event: self.end_step(flight) }
    }

    /// An impact, a time `left` ahead: restitution, and sticking where the rebounds that follow can be closed.
    #[inline(always)]
    fn strike<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
        Reached { end, left }: Reached<T>,
    ) -> Event<T> {
        let normal = &flight.normals[end.normal];
        let sign = end.sign::<T>();
        let speed = dot(&normal.direction, &self.point.state.v);
        if sign * speed < T::zero() {
            self.point.state.v = axpy(-speed, &normal.response, &self.point.state.v);
        }
        let held = self.contact;
        let arrived = self.point.nudged(flight, left, held);
        let before = arrived.motion(flight, held).acceleration;
        let velocity = dot(&normal.direction, &arrived.state.v);
        let rebound = -(normal.restitution[end.side] * velocity);
        let kick = rebound - velocity;
        self.point = Point { state: placed(flight, &arrived.state, end, rebound), ..arrived };
        self.offset = self.offset + left;
        if !held.is_free() {
            self.keep_pressed(flight, end.normal, kick);
        }
        let after = self.point.motion(flight, self.contact);
        if velocity != T::zero() {
            let contact = self.contact;
            let after = after.acceleration;
            *variation = variation
                .struck(flight, &Saltation { normal: end.normal, velocity, kick, before, after, contact });
        }
        let impact =
            Impact { stop: Stop(normal.stop[end.side]), velocity_before: velocity, velocity_after: rebound };
        let Some(closure) = self.closure(flight, end, rebound, &after) else {
            if let Some(corner) = corner::closes(flight, &self.point, self.contact, end) {
                let beside = corner.since(self.contact.with(end));
                self.contact = corner;
                self.point.state = rested(flight, &self.point.state, corner);
                *variation = variation.caught(flight, corner);
                return Event::Caught { impact, complete_chatter: true, beside };
            }
            let lost = contact::unresolved(normal, end.side, &self.point.state);
            if rebound.abs() <= lost {
                // Pulled off the stop as soon as it is met: rounding must not make that another impact.
                let parting = -(sign * (lost + lost));
                self.point.state = placed(flight, &self.point.state, end, parting);
            }
            self.bounce(flight, end.normal, kick, held);
            return Event::Impact(impact);
        };
        self.come_to_rest(flight, end, closure.gap_integral);
        *variation = variation.caught(flight, self.contact);
        Event::Caught { impact, complete_chatter: rebound.abs() > T::zero(), beside: Contact::FREE }
    }

    /// The closure of the rebounds that follow an impact, if that is as good as following them.
    #[inline(always)]
    fn closure(
        &self,
        flight: &Flight<T, N>,
        end: End,
        rebound: T,
        after: &Motion<T, N>,
    ) -> Option<Closure<T>> {
        let normal = &flight.normals[end.normal];
        let along = self.point.approach(flight, after, end.normal);
        let towards = Approach { acceleration: end.sign::<T>() * along.acceleration, ..along };
        let room = T::of(f64::from(flight.steps - self.step)) * flight.h - self.offset;
        let rebound = Rebound {
            speed: rebound.abs(),
            restitution: normal.restitution[end.side],
            unresolved: contact::unresolved(normal, end.side, &self.point.state),
            room,
        };
        let closure = chatter::close(flight, normal, &rebound, &towards)?;
        let resting = self.at_rest(flight, end, closure.gap_integral);
        let contact = self.contact.with(end);
        let Closure { height, lasts, .. } = closure;
        contact::clears_elsewhere(flight, &resting, contact, end, height, lasts).then_some(closure)
    }

    /// An impact that ends in flight: the end of the step is where the kick takes it.
    #[inline(always)]
    fn bounce(&mut self, flight: &Flight<T, N>, normal: usize, kick: T, held: Contact) {
        if !self.contact.is_free() {
            return;
        }
        if !held.is_free() {
            self.kicks = 0;
            self.ahead = self.point.flown(flight, flight.h - self.offset, self.contact);
            return;
        }
        self.kicks += 1;
        if self.kicks <= MOST_KICKS {
            self.ahead = self.ahead.kicked(flight, normal, kick, flight.h - self.offset);
        }
    }

    /// The end of a chatter sequence whose rebounds opened the gap for `gap_integral` in all: meanwhile springs and dampers
    /// acted on the masses that are free with the contact, and now it holds.
    #[inline(never)]
    fn come_to_rest(&mut self, flight: &Flight<T, N>, end: End, gap_integral: T) {
        self.point = self.at_rest(flight, end, gap_integral);
        self.contact = self.contact.with(end);
    }

    /// See [`Trajectory::come_to_rest`].
    #[inline(never)]
    fn at_rest(&self, flight: &Flight<T, N>, end: End, gap_integral: T) -> Point<T, N, D> {
        let contact = self.contact.with(end);
        let free = |v: [T; N]| super::point::held(flight, contact, v).0;
        let response = &flight.normals[end.normal].response;
        let push = free(applied(&flight.damping, response));
        let pull = free(added(&applied(&flight.stiffness, response), &applied(&flight.damping, &push)));
        let signed = -(end.sign::<T>() * gap_integral);
        let State { x, v } = self.point.state;
        let state = State { x: axpy(signed, &push, &x), v: axpy(signed, &pull, &v) };
        Point { state: rested(flight, &state, contact), ..self.point }
    }

    /// After an impact along the normal `struck`: a contact whose speed this changes, by more than is lost in rounding, no
    /// longer holds; where it is directed into the stop, the next move is an impact there, at the same instant.
    #[inline(never)]
    fn keep_pressed(&mut self, flight: &Flight<T, N>, struck: usize, kick: T) {
        let response = &flight.normals[struck].response;
        for (k, normal) in flight.normals().iter().enumerate() {
            let Some(end) = self.contact.end_along(k) else { continue };
            let change = kick * dot(&normal.direction, response);
            let lost = contact::unresolved(normal, end.side, &self.point.state)
                + T::of(4.0) * T::epsilon() * kick.abs();
            if !self.contact.is_clamped_along(k) && change.abs() > lost {
                self.contact = self.contact.without(k);
            }
        }
        self.point.state = rested(flight, &self.point.state, self.contact);
    }

    /// Sticking: the masses that are free move on until a stop is met, or what presses on a contact vanishes.
    #[inline(never)]
    fn rest<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V) -> Move<T> {
        let window = flight.h - self.offset;
        let contact = self.contact;
        let motion = self.point.motion(flight, contact);
        let least = flight.h * T::epsilon().sqrt();
        let clear = contact::safe_time(flight, &self.point, &motion, contact.with_opposite_ends(), window);
        if clear <= least
            && let Some(reached) = self.imminent(flight)
        {
            let event = self.strike(flight, variation, reached);
            return Move { time: reached.left, contact, event };
        }
        let mut time = clear;
        for k in 0..flight.count {
            let Some(end) = contact.end_along(k).filter(|_| !contact.is_clamped_along(k)) else { continue };
            let sign = end.sign::<T>();
            let (force, slope) = (sign * motion.pressing[k], sign * motion.pressing_rate[k]);
            let bound = self.point.bound(flight, k);
            let unresolved = contact::unresolved(&flight.normals[k], end.side, &self.point.state);
            if (force <= unresolved && slope < T::zero()) || force < -unresolved {
                return self.release(flight, variation, end, bound);
            }
            let pressed = contact::pressed_time(force, slope, bound, window);
            let pressed = if pressed > least { pressed } else { least };
            time = if pressed < time { pressed } else { time };
        }
        if time >= window {
            self.glide(flight, variation, window);
            return Move { time: window, contact, event: self.end_step(flight) };
        }
        self.glide(flight, variation, time);
        Move { time, contact, event: Event::Flight }
    }

    /// A contact opens, from rest and without acceleration; the jerk alone pulls the masses off.
    #[inline(never)]
    fn release<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
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
        self.glide(flight, variation, pulled);
        if self.contact.is_free() {
            self.ahead = self.point.flown(flight, flight.h - self.offset, contact);
            self.kicks = 0;
        }
        let stop = Stop(flight.normals[end.normal].stop[end.side]);
        Move { time: pulled, contact, event: Event::Released(stop) }
    }

    /// Moves on for a time within the step, with the present contacts.
    #[inline(always)]
    fn glide<V: Variation<T, N>>(&mut self, flight: &Flight<T, N>, variation: &mut V, time: T) {
        let point = self.point.flown(flight, time, self.contact);
        self.point = Point { state: rested(flight, &point.state, self.contact), ..point };
        *variation = variation.flown(flight, time, self.contact);
        self.offset = self.offset + time;
    }

    /// Begins the next step; the forcing phasor is exact at phases 0 and π.
    #[inline(always)]
    fn end_step(&mut self, flight: &Flight<T, N>) -> Event<T> {
        self.offset = T::zero();
        self.step += 1;
        if self.step == flight.steps {
            self.step = 0;
            self.point.sin = T::zero();
            self.point.cos = T::one();
            Event::Strobe
        } else if self.step + self.step == flight.steps {
            self.point.sin = T::zero();
            self.point.cos = -T::one();
            Event::HalfPeriod
        } else {
            Event::StepEnd
        }
    }
}
