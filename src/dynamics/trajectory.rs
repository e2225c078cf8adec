//! One trajectory: steps of flight, impacts, chatter, sticking, until it has gone as far as was asked.

use super::along::{Alongs, Met};
use super::clear::clear_time;
use super::crossing::crossing;
use super::hull::Span;
use super::imminent::{Reached, imminent};
use super::leg::Leg;
use super::placing::{clamped, rested};
use super::point::Point;
use super::stop::{Contact, Stop};
use super::tangent::{Tangent, fly_all};
use crate::model::{Flight, Real, State};

/// The most kicks that are added to the end of one step; after more, the step is flown to its end instead.
pub const MOST_KICKS: u32 = 24;

/// An impact: d·v+ = −r d·v− along its normal, v+ = v− + (d·v+ − d·v−) M⁻¹d/(dᵀM⁻¹d).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<T> {
    /// The stop that is struck.
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
    /// An impact that ends in sticking; `complete_chatter` if infinitely many rebounds were closed with it. Where two stops squeeze masses
    /// either contact may open at once.
    Caught {
        /// The impact; its speed is 0 where a mass came to rest on the stop without one.
        impact: Impact<T>,
        /// Whether rebounds follow it, infinitely many in finite time.
        complete_chatter: bool,
        /// The stops beside this one that share these rebounds; seldom any.
        beside: Contact,
        /// About how long these rebounds take; 0 in a corner, where they are over at once.
        rebounds: T,
    },
    /// What pressed on a contact vanished, and it opens.
    Released(Stop),
}

/// A move: how long it took, with what contacts, and what ended it; one that ends with [`Event::Released`] begins as the contact opens.
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
pub struct Trajectory<T, const N: usize> {
    /// The present state and forcing phasor, but after [`Trajectory::advance_blindly`]; within a step of free flight only to be read.
    pub point: Point<T, N>,
    /// Where the present step ends if nothing more is met on the way; known while a step of free flight is under way.
    pub(super) ahead: Point<T, N>,
    /// Kicks that were added to it, each with its rounding.
    pub(super) kicks: u32,
    /// What is in contact.
    pub contact: Contact,
    /// The step within the forcing period, 0 ≤ step < M.
    pub step: u32,
    /// The time since the beginning of the step, 0 ≤ offset < h.
    pub offset: T,
    /// Whether a step of free flight is under way: `ahead` is its end then, and a tangent that is carried along is that of
    /// its end.
    pub(super) under_way: bool,
    /// The contact that was met directly just now: the point follows from it, once somebody asks for it.
    pub(super) met: Option<Met<T>>,
}

impl<T: Real, const N: usize> Trajectory<T, N> {
    /// A trajectory that begins at forcing phase 0 with a state within the stops.
    pub fn new(flight: &Flight<T, N>, start: State<T, N>) -> Self {
        let contact = clamped(flight);
        let point = Point::at_phase_zero(rested(flight, &start, contact));
        Trajectory {
            point,
            ahead: point,
            kicks: 0,
            contact,
            step: 0,
            offset: T::zero(),
            under_way: false,
            met: None,
        }
    }

    /// A trajectory that begins at forcing phase `phase`, 0 ≤ phase < 2π, with a state within the stops.
    pub fn at_phase(flight: &Flight<T, N>, state: State<T, N>, phase: f64) -> Self {
        let steps = phase / std::f64::consts::TAU * f64::from(flight.steps);
        let step = (steps as u32).min(flight.steps - 1);
        let (sin, cos) = libm::sincos(phase);
        let contact = clamped(flight);
        let state = rested(flight, &state, contact);
        let point = Point { state, sin: T::of(sin), cos: T::of(cos) };
        let offset = T::of((steps - f64::from(step)) * flight.h.widen());
        Trajectory::from_point(flight, point, contact, step, offset)
    }

    /// A trajectory that goes on from a point at a time `offset`, 0 ≤ offset < h, after the beginning of a step.
    ///
    /// The point's phasor must be that of this time.
    pub fn from_point(
        flight: &Flight<T, N>,
        point: Point<T, N>,
        contact: Contact,
        step: u32,
        offset: T,
    ) -> Self {
        let mut trajectory =
            Trajectory { point, ahead: point, kicks: 0, contact, step, offset, under_way: false, met: None };
        if offset > T::zero() {
            trajectory.look_ahead(flight, &mut []);
        }
        trajectory
    }

    /// Is at a point at phase 0, in free flight.
    #[inline(always)]
    pub(crate) fn come_to_phase_zero(&mut self, point: Point<T, N>) {
        self.point = point;
        (self.contact, self.step, self.offset, self.under_way) = (Contact::FREE, 0, T::zero(), false);
        self.met = None;
    }

    /// Within a step: finds its end where flight is free, and what deviations of the present point are there.
    #[inline(always)]
    pub(super) fn look_ahead(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) {
        if self.contact.is_free() {
            self.ahead = self.point.flown(flight, flight.h - self.offset, self.contact);
            self.kicks = 0;
            self.under_way = true;
            self.carry(flight, tangents);
        }
    }

    /// Deviations of the present point become those that are carried along from here.
    #[inline(always)]
    pub fn carry(&self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) {
        if self.under_way {
            fly_all(tangents, flight, flight.h - self.offset, self.contact);
        }
    }

    /// Deviations that are carried along become those of the present point.
    #[inline(always)]
    pub fn bring_back(&self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) {
        if self.under_way {
            fly_all(tangents, flight, self.offset - flight.h, self.contact);
        }
    }

    /// Whether it is at the beginning of a step of free flight.
    pub fn begins_free_step(&self) -> bool {
        self.contact.is_free() && !self.under_way
    }

    /// Free flight: the rest of the step where it provably clears the stops, else up to the contact where that is found directly, else as far
    /// as is safe.
    #[inline(always)]
    pub(super) fn fly_inlined(&mut self, flight: &Flight<T, N>, tangents: &mut [Tangent<T, N>]) -> Move<T> {
        let window = flight.h - self.offset;
        if !self.under_way {
            self.ahead = self.point.stepped(flight);
            self.kicks = 0;
            self.under_way = true;
            for tangent in tangents.iter_mut() {
                *tangent = tangent.stepped_freely(flight);
            }
        }
        if self.kicks <= MOST_KICKS {
            let from = match self.met {
                Some(met) => met.along,
                None => Alongs::of(&self.point, flight, flight.count),
            };
            let leg = Leg::new(from, &self.ahead, Span::of(window), flight);
            let clearances = leg.clearances(flight);
            if clearances.all(from.count) {
                return self.go_ahead(flight, window);
            }
            if self.kicks < MOST_KICKS {
                let crossing = crossing(&leg, &clearances, flight);
                if crossing.certain {
                    return self.cross(flight, tangents, &crossing);
                }
                if crossing.passes {
                    return self.go_ahead(flight, window);
                }
            }
        }
        self.approach(flight, tangents)
    }

    /// Free flight towards a stop, as far as is safe.
    #[inline(always)]
    pub(super) fn approach_inlined(
        &mut self,
        flight: &Flight<T, N>,
        tangents: &mut [Tangent<T, N>],
    ) -> Move<T> {
        self.point = self.present(flight);
        self.met = None;
        let window = flight.h - self.offset;
        let contact = Contact::FREE;
        let motion = self.point.motion(flight, contact);
        let time = clear_time(flight, &self.point, &motion, [contact; 2], window);
        if time >= window {
            return self.go_ahead(flight, window);
        }
        self.glide(flight, tangents, time);
        match self.imminent(flight) {
            None => Move { time, contact, event: Event::Flight },
            Some(reached) => {
                let event = self.strike(flight, tangents, reached);
                Move { time: time + reached.left, contact, event }
            }
        }
    }

    /// The stop that is reached in one straight line within the step; a contact beyond its end belongs to the next one.
    #[inline(always)]
    pub(super) fn imminent(&self, flight: &Flight<T, N>) -> Option<Reached<T>> {
        imminent(flight, &self.point, self.contact).filter(|reached| self.offset + reached.left <= flight.h)
    }

    /// The rest of a step, known to clear the stops.
    #[inline(always)]
    fn go_ahead(&mut self, flight: &Flight<T, N>, window: T) -> Move<T> {
        let contact = Contact::FREE;
        self.point =
            if self.kicks <= MOST_KICKS { self.ahead } else { self.point.flown(flight, window, contact) };
        Move { time: window, contact, event: self.end_step(flight) }
    }

    /// Begins the next step; the forcing phasor is exact at phases 0 and π.
    #[inline(always)]
    pub(super) fn end_step(&mut self, flight: &Flight<T, N>) -> Event<T> {
        self.offset = T::zero();
        self.under_way = false;
        self.met = None;
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
