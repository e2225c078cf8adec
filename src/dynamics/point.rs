//! A point of the motion and its flight, as exact as the arithmetic.

use pulp::NullaryFnOnce;

use super::held::{held, spared};
use super::series::{Flown, INVERSE_FACTORIALS, Series};
use super::stop::{Contact, End};
use crate::model::vector::{MOST, applied_onto, axpy, dot, scaled};
use crate::model::{Bound, Flight, Lanes, Real, State, Step, others};

/// State and forcing phasor at one instant; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T, const N: usize> {
    /// Displacements and velocities.
    pub state: State<T, N>,
    /// Sine of the forcing phase.
    pub sin: T,
    /// Cosine of the forcing phase.
    pub cos: T,
}

/// How the masses move for the next instants, with the contacts that hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<T, const N: usize> {
    /// x''.
    pub acceleration: [T; N],
    /// x'''.
    pub jerk: [T; N],
    /// What presses on each contact that holds, as an acceleration along its normal; 0 for the others.
    pub pressing: [T; MOST],
    /// Its derivative.
    pub pressing_rate: [T; MOST],
}

/// How a motion goes on along one normal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Approach<T> {
    /// (d·x)''.
    pub acceleration: T,
    /// (d·x)'''.
    pub jerk: T,
    /// A bound on |(d·x)''''| for the rest of the step.
    pub bound: T,
}

impl<T: Real, const N: usize> Point<T, N> {
    /// A point at forcing phase 0.
    pub fn at_phase_zero(state: State<T, N>) -> Self {
        Point { state, sin: T::zero(), cos: T::one() }
    }
}

impl<L: Lanes, const N: usize> Point<L, N> {
    /// The point in one lane.
    #[inline(always)]
    pub(super) fn lane(&self, lane: usize) -> Point<L::Real, N> {
        Point { state: self.state.lane(lane), sin: self.sin.lane(lane), cos: self.cos.lane(lane) }
    }

    /// Puts a point into one lane.
    pub(super) fn set_lane(&mut self, lane: usize, point: &Point<L::Real, N>) {
        self.state.set_lane(lane, &point.state);
        self.sin.set_lane(lane, point.sin);
        self.cos.set_lane(lane, point.cos);
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        Point {
            state: State::select(mask, &yes.state, &no.state),
            sin: L::select(mask, yes.sin, no.sin),
            cos: L::select(mask, yes.cos, no.cos),
        }
    }

    /// The point one whole step h of free flight later.
    #[inline(always)]
    pub fn stepped(&self, flight: &Flight<L, N>) -> Self {
        self.stepped_by(&flight.step, flight)
    }

    /// The same under what a step does.
    #[inline(always)]
    pub fn stepped_by(&self, step: &Step<L, N>, flight: &Flight<L, N>) -> Self {
        Point {
            state: step.of_state(&self.state, self.sin, self.cos),
            sin: self.sin.times_plus(flight.turn_cos, self.cos * flight.turn_sin),
            cos: self.cos.times_plus(flight.turn_cos, -(self.sin * flight.turn_sin)),
        }
    }

    /// The point with a speed changed by `kick` some time ago, `wake` being what a change by 1 has become: flight is linear, so
    /// the change just adds.
    #[inline(always)]
    pub fn kicked(&self, kick: L, wake: &State<L, N>) -> Self {
        Point { state: self.state.plus(kick, wake), ..*self }
    }

    /// A bound on |(d·x)''''| along a normal (in contact: on the second derivative of what presses on it) for less
    /// than a step before the point, or after it.
    #[inline(always)]
    pub fn bound(&self, flight: &Flight<L, N>, normal: usize) -> L {
        let bound = &flight.normals[normal].bound;
        bound.of(&self.state.x, &self.state.v, bound.forcing)
    }
}

impl<T: Real, const N: usize> Motion<T, N> {
    /// How it goes on along a direction, with a bound on |(d·x)''''|.
    #[inline(always)]
    pub fn approach(&self, direction: &[T; N], bound: T) -> Approach<T> {
        Approach { acceleration: dot(direction, &self.acceleration), jerk: dot(direction, &self.jerk), bound }
    }

    /// What presses masses on the stop at an end where they rest, as an acceleration towards it, and its derivative.
    #[inline(always)]
    pub fn pressure(&self, end: End) -> [T; 2] {
        let sign = end.sign::<T>();
        [sign * self.pressing[end.normal], sign * self.pressing_rate[end.normal]]
    }

    /// A bound on the fourth derivative of what presses on a contact, for less than a step before or after, while those hold: x''
    /// flows like x, forced by −ω² times as much.
    #[inline(always)]
    pub fn pressed_bound(&self, flight: &Flight<T, N>, contact: Contact, normal: usize) -> T {
        self.bounded(flight, pressed(flight, contact, normal))
    }

    /// What a bound says of x'' in place of x.
    #[inline(always)]
    pub fn bounded(&self, flight: &Flight<T, N>, bound: &Bound<T, N>) -> T {
        bound.of(&self.acceleration, &self.jerk, bound.forcing * (flight.omega * flight.omega))
    }
}

/// What bounds the second derivative of what presses on a contact, of those that hold.
#[inline(always)]
fn pressed<T, const N: usize>(flight: &Flight<T, N>, contact: Contact, normal: usize) -> &Bound<T, N> {
    &flight.normals[normal].pressed[others(contact.held(), normal)]
}

impl<T: Real, const N: usize> Point<T, N> {
    /// The point a time `s` ≤ h later with the contacts that hold, by the Taylor polynomial of the equations of motion; in free flight
    /// `s` may be negative.
    ///
    /// The terms are kept as Vₖ = v⁽ᵏ⁾ sᵏ, which obey a recurrence of second order; 1/k! comes from a table.
    #[inline(never)]
    pub fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        T::fused(Flown { from: self, flight, s, contact })
    }

    /// x'' in free flight.
    #[inline(always)]
    pub fn accelerations(&self, flight: &Flight<T, N>) -> [T; N] {
        self.accelerations_under(flight, &flight.load)
    }

    /// The same under another load.
    #[inline(always)]
    fn accelerations_under(&self, flight: &Flight<T, N>, load: &[T; N]) -> [T; N] {
        let forced = axpy(self.sin, &flight.sin, load);
        let forced = axpy(self.cos, &flight.cos, &forced);
        let pulled = applied_onto(&flight.stiffness, &self.state.x, &forced);
        applied_onto(&flight.damping, &self.state.v, &pulled)
    }

    /// x''' in free flight, from x''.
    #[inline(always)]
    pub fn jerks(&self, flight: &Flight<T, N>, acceleration: &[T; N]) -> [T; N] {
        let turned = scaled(-(flight.omega * self.sin), &flight.cos);
        let forced = axpy(flight.omega * self.cos, &flight.sin, &turned);
        let pulled = applied_onto(&flight.stiffness, &self.state.v, &forced);
        applied_onto(&flight.damping, acceleration, &pulled)
    }

    /// The point a time `s` later, so short that its square is lost in rounding.
    #[inline(always)]
    pub fn nudged(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let acceleration = spared(flight, contact, self.accelerations(flight));
        let turn = flight.omega * s;
        Point {
            state: State {
                x: axpy(s, &self.state.v, &self.state.x),
                v: axpy(s, &acceleration, &self.state.v),
            },
            sin: self.sin + self.cos * turn,
            cos: self.cos - self.sin * turn,
        }
    }

    /// What decides when a stop can be reached, or left.
    #[inline(always)]
    pub fn motion(&self, flight: &Flight<T, N>, contact: Contact) -> Motion<T, N> {
        self.motion_under(flight, contact, &flight.load)
    }

    /// The same under another load.
    #[inline(always)]
    pub(super) fn motion_under(
        &self,
        flight: &Flight<T, N>,
        contact: Contact,
        load: &[T; N],
    ) -> Motion<T, N> {
        let (acceleration, pressing) = held(flight, contact, self.accelerations_under(flight, load));
        let (jerk, pressing_rate) = held(flight, contact, self.jerks(flight, &acceleration));
        Motion { acceleration, jerk, pressing, pressing_rate }
    }

    /// A bound on the second derivative of what presses on a contact, likewise, while those hold.
    #[inline(always)]
    pub fn pressed_bound(&self, flight: &Flight<T, N>, contact: Contact, normal: usize) -> T {
        let bound = pressed(flight, contact, normal);
        bound.of(&self.state.x, &self.state.v, bound.forcing)
    }

    /// How a motion from here goes on along a normal.
    #[inline(always)]
    pub fn approach(&self, flight: &Flight<T, N>, motion: &Motion<T, N>, normal: usize) -> Approach<T> {
        motion.approach(&flight.normals[normal].direction, self.bound(flight, normal))
    }
}

impl<T: Real, const N: usize> NullaryFnOnce for Flown<'_, Point<T, N>, T, N> {
    type Output = Point<T, N>;

    #[inline(always)]
    fn call(self) -> Point<T, N> {
        let Flown { from, flight, s, contact } = self;
        let series = Series::new(flight, s, contact);
        let turn = flight.omega * s;
        let force_sin = scaled(s, &spared(flight, contact, flight.sin));
        let force_cos = scaled(s, &spared(flight, contact, flight.cos));
        let mut before = from.state.v;
        let first = series.first(flight, contact, &from.state.x, &before);
        let first = axpy(from.cos, &force_cos, &axpy(from.sin, &force_sin, &first));
        let mut last = axpy(s, &spared(flight, contact, flight.load), &first);
        let mut phasor = [from.cos * turn, -(from.sin * turn)];
        let mut velocity = before;
        let mut mean = before;
        let mut phase = [from.sin, from.cos];
        let mut power = T::one();
        for k in 1..=T::ORDER {
            let weight = T::of(INVERSE_FACTORIALS[k]);
            let lower = T::of(INVERSE_FACTORIALS[k + 1]);
            velocity = axpy(weight, &last, &velocity);
            mean = axpy(lower, &last, &mean);
            phase = axpy(weight, &phasor, &phase);
            let negligible;
            (power, negligible) = series.grow(power, k);
            if negligible {
                break;
            }
            let forced = axpy(phasor[1], &force_cos, &scaled(phasor[0], &force_sin));
            let next = series.next(&before, &last, &forced);
            (before, last) = (last, next);
            phasor = [phasor[1] * turn, -(phasor[0] * turn)];
        }
        Point { state: State { x: axpy(s, &mean, &from.state.x), v: velocity }, sin: phase[0], cos: phase[1] }
    }
}
