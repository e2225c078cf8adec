//! One trajectory: steps of flight, impacts, chatter, sticking, until it has gone as far as was asked.

use std::fmt;

use super::chatter;
use super::contact;
use super::drive::Drive;
use super::point::{Motion, Point};
use super::tangent::Variation;
use crate::model::{Flight, Real};

/// The most kicks that are added to the end of one step; after more, the step is flown to its end instead.
pub const MOST_KICKS: u32 = 4;

/// Moves in one forcing period beyond which a trajectory is given up.
pub const MOST_MOVES: u32 = 1 << 24;

/// One of the two rigid stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stop {
    /// A, at x1 = +δ.
    A,
    /// Ā, at x1 = −δ.
    B,
}

impl Stop {
    /// +1 at A, −1 at Ā: the direction in which the stop is approached.
    #[inline(always)]
    pub fn side<T: Real>(self) -> T {
        match self {
            Stop::A => T::one(),
            Stop::B => -T::one(),
        }
    }
}

impl fmt::Display for Stop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Stop::A => "A",
            Stop::B => "B",
        })
    }
}

/// What the first mass touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// Nothing: free flight.
    Free,
    /// It rests on a stop, pressed.
    Stuck(Stop),
    /// Both stops at once: the limit δ = 0.
    Clamped,
}

/// An impact, Eq. (3).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<T> {
    /// Where.
    pub stop: Stop,
    /// v1−.
    pub velocity_before: T,
    /// v1+ = −r v1−.
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
    /// An impact after which the first mass flies on.
    Impact(Impact<T>),
    /// An impact that ends in sticking; `complete_chatter` if infinitely many rebounds were closed with it.
    Caught {
        /// The impact; its speed is 0 where the first mass came to rest on the stop without one.
        impact: Impact<T>,
        /// Whether rebounds follow it, infinitely many in finite time.
        complete_chatter: bool,
    },
    /// The pressing force vanished and the first mass leaves its stop.
    Released(Stop),
}

/// A move: how long it took, in what contact, and what ended it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Move<T> {
    /// Its duration; non-dimensional.
    pub time: T,
    /// 1 if the first mass flew, 0 if it rested.
    pub free: T,
    /// What happened at its end.
    pub event: Event<T>,
}

/// A trajectory: where it is, and how it moves on.
///
/// Time is never summed up: the place is a step within the forcing period and an offset within the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trajectory<T, D = ()> {
    /// The present state and forcing phasor.
    pub point: Point<T, D>,
    /// Where the present step ends if nothing more is met on the way; known while the first mass flies.
    ahead: Point<T, D>,
    /// Kicks that were added to it, each with its rounding.
    kicks: u32,
    /// What the first mass touches.
    pub contact: Contact,
    /// The step within the forcing period, 0 ≤ step < M.
    pub step: u32,
    /// The time since the beginning of the step, 0 ≤ offset < h.
    pub offset: T,
}

impl<T: Real> Trajectory<T> {
    /// A trajectory that begins at forcing phase 0 with (x1, x2, v1, v2), |x1| ≤ δ.
    pub fn new(flight: &Flight<T>, start: [T; 4]) -> Self {
        let mut point = Point::at_phase_zero(start);
        let clamped = flight.delta == T::zero();
        if clamped {
            point.x1 = T::zero();
            point.v1 = T::zero();
        }
        let contact = if clamped { Contact::Clamped } else { Contact::Free };
        Trajectory { point, ahead: point, kicks: 0, contact, step: 0, offset: T::zero() }
    }

    /// A trajectory that begins at forcing phase `phase`, 0 ≤ phase < 2π, with (x1, x2, v1, v2), |x1| ≤ δ > 0.
    pub fn at_phase(flight: &Flight<T>, [x1, x2, v1, v2]: [T; 4], phase: f64) -> Self {
        let steps = phase / std::f64::consts::TAU * f64::from(flight.steps);
        let step = (steps as u32).min(flight.steps - 1);
        let (sin, cos) = phase.sin_cos();
        let point = Point { x1, x2, v1, v2, sin: T::of(sin), cos: T::of(cos), drive: () };
        let offset = T::of((steps - f64::from(step)) * flight.h.widen());
        Trajectory::from_point(flight, point, Contact::Free, step, offset)
    }
}

impl<T: Real, D: Drive<T>> Trajectory<T, D> {
    /// A trajectory that goes on from a point at a time `offset`, 0 ≤ offset < h, after the beginning of a step.
    ///
    /// The point's phasor must be that of this time.
    pub fn from_point(
        flight: &Flight<T>,
        point: Point<T, D>,
        contact: Contact,
        step: u32,
        offset: T,
    ) -> Self {
        let ahead = match contact {
            Contact::Free => point.flown(flight, flight.h - offset, T::one()),
            Contact::Stuck(_) | Contact::Clamped => point,
        };
        Trajectory { point, ahead, kicks: 0, contact, step, offset }
    }

    /// Moves on to the next event, the end of the step at the latest, and carries a variation along; `()` is none.
    #[inline(always)]
    pub fn advance<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V) -> Move<T> {
        let taken = match self.contact {
            Contact::Free => self.fly(flight, variation),
            Contact::Stuck(stop) => self.rest(flight, variation, stop),
            Contact::Clamped => {
                let window = flight.h - self.offset;
                self.glide(flight, variation, window, T::zero());
                Move { time: window, free: T::zero(), event: self.end_step(flight) }
            }
        };
        debug_assert!(contact::holds(flight, &self.point), "beyond a stop after {taken:?}: {self:?}");
        taken
    }

    /// Moves on like [`Trajectory::advance`], but passes over the ends of steps at which nothing happens.
    #[inline(always)]
    pub fn advance_to_event<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V) -> Move<T> {
        loop {
            let taken = self.advance(flight, variation);
            if taken.event != Event::StepEnd {
                return taken;
            }
        }
    }

    /// Free flight: a whole step where it provably clears the stops, else as far as is safe.
    #[inline(always)]
    fn fly<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V) -> Move<T> {
        let window = flight.h - self.offset;
        let whole = self.offset == T::zero();
        let free = T::one();
        if whole {
            self.ahead = self.point.stepped(flight);
            self.kicks = 0;
            if contact::clears(flight, &self.point, &self.ahead) {
                return self.go_ahead(flight, variation, window);
            }
        }
        let motion = self.point.motion(flight, free);
        let time = contact::safe_time(flight, &self.point, &motion, window);
        if time >= window {
            return self.go_ahead(flight, variation, window);
        }
        self.glide(flight, variation, time, free);
        self.offset = self.offset + time;
        let stop = if self.point.x1 >= T::zero() { Stop::A } else { Stop::B };
        let side = stop.side::<T>();
        let imminent = contact::imminent(flight, &self.point, side);
        // A contact beyond the end of the step belongs to the next one.
        let Some(left) = imminent.filter(|&left| self.offset + left <= flight.h) else {
            return Move { time, free, event: Event::Flight };
        };
        if side * self.point.v1 < T::zero() {
            self.point.v1 = T::zero();
        }
        let event = self.strike(flight, variation, stop, left);
        Move { time: time + left, free, event }
    }

    /// The rest of a step, known to clear the stops.
    #[inline(always)]
    fn go_ahead<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V, window: T) -> Move<T> {
        self.point =
            if self.kicks <= MOST_KICKS { self.ahead } else { self.point.flown(flight, window, T::one()) };
        *variation = if self.offset == T::zero() {
            variation.stepped(flight)
        } else {
            variation.flown(flight, window, T::one())
        };
        Move { time: window, free: T::one(), event: self.end_step(flight) }
    }

    /// An impact, a time `left` ahead: restitution (3), and sticking where the rebounds that follow can be closed.
    #[inline(always)]
    fn strike<V: Variation<T>>(
        &mut self,
        flight: &Flight<T>,
        variation: &mut V,
        stop: Stop,
        left: T,
    ) -> Event<T> {
        let side = stop.side::<T>();
        let arrived = self.point.nudged(flight, left);
        let before = arrived.motion(flight, T::one());
        let velocity = arrived.v1;
        let rebound = -(flight.r * velocity);
        self.point = Point { x1: side * flight.delta, v1: rebound, ..arrived };
        self.offset = self.offset + left;
        let after = self.point.motion(flight, T::one());
        if velocity != T::zero() {
            let kick = rebound - velocity;
            *variation = variation.struck(flight, velocity, kick, before.acceleration, after.acceleration);
        }
        let impact = Impact { stop, velocity_before: velocity, velocity_after: rebound };
        let towards = Motion { acceleration: side * after.acceleration, ..after };
        let speed = rebound.abs();
        let room = T::of(f64::from(flight.steps - self.step)) * flight.h - self.offset;
        let Some(closure) = chatter::close(flight, speed, &towards, room) else {
            self.kicks += 1;
            if self.kicks <= MOST_KICKS {
                self.ahead = self.ahead.kicked(flight, rebound - velocity, flight.h - self.offset);
            }
            return Event::Impact(impact);
        };
        // The gap of the skipped rebounds lets the coupling's spring and damper act on the second mass.
        let push = side * flight.inverse_mass * closure.gap_integral;
        let drag =
            flight.coupling_damping * (flight.inverse_mass * flight.coupling_damping + flight.ground_damping);
        self.point.x2 = self.point.x2 - flight.coupling_damping * push;
        self.point.v2 = self.point.v2 - (T::one() - drag) * push;
        self.point.v1 = T::zero();
        self.contact = Contact::Stuck(stop);
        *variation = variation.caught();
        Event::Caught { impact, complete_chatter: speed > T::zero() }
    }

    /// Sticking: the second mass moves alone until the force on the first no longer presses it on the stop.
    #[inline(always)]
    fn rest<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V, stop: Stop) -> Move<T> {
        let window = flight.h - self.offset;
        let side = stop.side::<T>();
        let free = T::zero();
        let motion = self.point.motion(flight, free);
        let force = side * motion.acceleration;
        let slope = side * motion.jerk;
        if force <= contact::unresolved(flight) && slope < T::zero() {
            return self.release(flight, variation, stop, slope);
        }
        let least = flight.h * T::epsilon().sqrt();
        let time = contact::pressed_time(force, slope, motion.bound, window);
        let time = if time > least { time } else { least };
        if time >= window {
            self.glide(flight, variation, window, free);
            return Move { time: window, free, event: self.end_step(flight) };
        }
        self.glide(flight, variation, time, free);
        self.offset = self.offset + time;
        Move { time, free, event: Event::Flight }
    }

    /// The first mass leaves its stop, from rest and without acceleration; the jerk alone pulls it off, for as long as
    /// it surely outweighs what is left of the series, and the other stop is surely not reached.
    #[inline(always)]
    fn release<V: Variation<T>>(
        &mut self,
        flight: &Flight<T>,
        variation: &mut V,
        stop: Stop,
        slope: T,
    ) -> Move<T> {
        let free = T::one();
        let motion = self.point.motion(flight, free);
        let half_window = T::of(0.5) * (flight.h - self.offset);
        let least = flight.h * T::epsilon().sqrt();
        let pulled = -slope / (motion.bound + motion.bound);
        let pulled = if pulled > least { pulled } else { least };
        let pulled = if pulled < half_window { pulled } else { half_window };
        let pulled = contact::safe_across(flight, &self.point, &motion, stop.side(), pulled);
        self.contact = Contact::Free;
        self.glide(flight, variation, pulled, free);
        self.offset = self.offset + pulled;
        self.ahead = self.point.flown(flight, flight.h - self.offset, free);
        self.kicks = 0;
        Move { time: pulled, free, event: Event::Released(stop) }
    }

    #[inline(always)]
    fn glide<V: Variation<T>>(&mut self, flight: &Flight<T>, variation: &mut V, time: T, free: T) {
        self.point = self.point.flown(flight, time, free);
        *variation = variation.flown(flight, time, free);
    }

    /// Begins the next step; the forcing phasor is exact at phases 0 and π.
    #[inline(always)]
    fn end_step(&mut self, flight: &Flight<T>) -> Event<T> {
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
