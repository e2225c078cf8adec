//! A point of the motion and its flight, as exact as the arithmetic.

use super::drive::{Drive, DriveSeries};
use super::series::{INVERSE_FACTORIALS, Series};
use super::stop::Contact;
use crate::model::vector::{MOST, added, applied, axpy, dot, dot_absolute, scaled};
use crate::model::{Flight, Real, State};

/// State and forcing phasor at one instant, and that of a second force where there is one; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T, const N: usize, D = ()> {
    /// Displacements and velocities.
    pub state: State<T, N>,
    /// Sine of the forcing phase.
    pub sin: T,
    /// Cosine of the forcing phase.
    pub cos: T,
    /// 1, the factor of the constant load; 0 for a deviation, which does not feel it.
    pub one: T,
    /// What else drives a coordinate; `()` is nothing.
    pub drive: D,
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
        Point { state, sin: T::zero(), cos: T::one(), one: T::one(), drive: () }
    }
}

impl<T: Real, const N: usize, D: Drive<T, N>> Point<T, N, D> {
    /// The point one whole step h of free flight later.
    #[inline(always)]
    pub fn stepped(&self, flight: &Flight<T, N>) -> Self {
        let mut state = flight.gamma_one.scaled(self.one);
        state = state.plus(self.sin, &flight.gamma_sin).plus(self.cos, &flight.gamma_cos);
        for (column, &x) in flight.phi_x.iter().zip(&self.state.x) {
            state = state.plus(x, column);
        }
        for (column, &v) in flight.phi_v.iter().zip(&self.state.v) {
            state = state.plus(v, column);
        }
        Point {
            state: self.drive.carried(state),
            sin: self.sin * flight.turn_cos + self.cos * flight.turn_sin,
            cos: self.cos * flight.turn_cos - self.sin * flight.turn_sin,
            one: self.one,
            drive: self.drive.stepped(),
        }
    }

    /// The point a time `s` ≤ h later with the contacts that hold, by the Taylor polynomial of the equations of motion.
    ///
    /// The terms are kept as Vₖ = v⁽ᵏ⁾ sᵏ, which obey a recurrence of second order; 1/k! comes from a table.
    #[inline(always)]
    pub fn flown(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let series = Series::new(flight, s);
        let turn = flight.omega * s;
        let force_sin = scaled(s, &flight.sin);
        let force_cos = scaled(s, &flight.cos);
        let mut drive = self.drive.series(s);
        let mut before = self.state.v;
        let first = series.first(flight, &self.state.x, &before);
        let first = axpy(self.cos, &force_cos, &axpy(self.sin, &force_sin, &first));
        let first = axpy(s * self.one, &flight.load, &first);
        let mut last = held(flight, contact, drive.forced(first, s)).0;
        let mut phasor = [self.cos * turn, -(self.sin * turn)];
        let mut velocity = before;
        let mut mean = before;
        let mut phase = [self.sin, self.cos];
        let mut power = T::one();
        for k in 1..=T::ORDER {
            let weight = T::of(INVERSE_FACTORIALS[k]);
            let lower = T::of(INVERSE_FACTORIALS[k + 1]);
            velocity = axpy(weight, &last, &velocity);
            mean = axpy(lower, &last, &mean);
            phase = axpy(weight, &phasor, &phase);
            drive.next(weight);
            let negligible;
            (power, negligible) = series.grow(power, k);
            if negligible {
                break;
            }
            let forced = axpy(phasor[1], &force_cos, &scaled(phasor[0], &force_sin));
            let next = series.next(&before, &last, &drive.forced(forced, s));
            before = last;
            last = held(flight, contact, next).0;
            phasor = [phasor[1] * turn, -(phasor[0] * turn)];
        }
        Point {
            state: State { x: axpy(s, &mean, &self.state.x), v: velocity },
            sin: phase[0],
            cos: phase[1],
            one: self.one,
            drive: drive.end(),
        }
    }

    /// The point with the speed along a normal changed by `kick` a time `s` ≤ h ago: flight is linear, so the change
    /// just adds.
    #[inline(always)]
    pub fn kicked(&self, flight: &Flight<T, N>, normal: usize, kick: T, s: T) -> Self {
        let u = s * flight.inverse_h;
        let terms = &flight.normals[normal].kick;
        let mut sum = terms[T::ORDER];
        for k in (0..T::ORDER).rev() {
            sum = terms[k].plus(u, &sum);
        }
        Point { state: self.state.plus(kick, &sum), ..*self }
    }

    /// The point a time `s` later, so short that its square is lost in rounding.
    #[inline(always)]
    pub fn nudged(&self, flight: &Flight<T, N>, s: T, contact: Contact) -> Self {
        let acceleration = held(flight, contact, self.accelerations(flight)).0;
        let turn = flight.omega * s;
        Point {
            state: State {
                x: axpy(s, &self.state.v, &self.state.x),
                v: axpy(s, &acceleration, &self.state.v),
            },
            sin: self.sin + self.cos * turn,
            cos: self.cos - self.sin * turn,
            one: self.one,
            drive: self.drive.nudged(s),
        }
    }

    /// x'' in free flight.
    #[inline(always)]
    pub fn accelerations(&self, flight: &Flight<T, N>) -> [T; N] {
        let inner =
            added(&applied(&flight.stiffness, &self.state.x), &applied(&flight.damping, &self.state.v));
        let load = scaled(self.one, &flight.load);
        let outer = axpy(self.cos, &flight.cos, &axpy(self.sin, &flight.sin, &load));
        self.drive.pushed(added(&inner, &outer))
    }

    /// What decides when a stop can be reached, or left.
    #[inline(always)]
    pub fn motion(&self, flight: &Flight<T, N>, contact: Contact) -> Motion<T, N> {
        let (acceleration, pressing) = held(flight, contact, self.accelerations(flight));
        let inner =
            added(&applied(&flight.stiffness, &self.state.v), &applied(&flight.damping, &acceleration));
        let outer =
            axpy(flight.omega * self.cos, &flight.sin, &scaled(-(flight.omega * self.sin), &flight.cos));
        let jerk = self.drive.jerked(added(&inner, &outer));
        let (jerk, pressing_rate) = held(flight, contact, jerk);
        Motion { acceleration, jerk, pressing, pressing_rate }
    }

    /// A bound on |(d·x)''''| along a normal (in contact: on the second derivative of what presses on it) for the rest
    /// of the step.
    #[inline(always)]
    pub fn bound(&self, flight: &Flight<T, N>, normal: usize) -> T {
        let along = &flight.normals[normal];
        let bound = dot_absolute(&along.bound_x, &self.state.x)
            + dot_absolute(&along.bound_v, &self.state.v)
            + along.bound_forcing;
        self.drive.bounded(normal, bound)
    }

    /// How a motion from here goes on along a normal.
    #[inline(always)]
    pub fn approach(&self, flight: &Flight<T, N>, motion: &Motion<T, N>, normal: usize) -> Approach<T> {
        let direction = &flight.normals[normal].direction;
        Approach {
            acceleration: dot(direction, &motion.acceleration),
            jerk: dot(direction, &motion.jerk),
            bound: self.bound(flight, normal),
        }
    }
}

/// Accelerations (or their derivatives) with what the contacts that hold take from them, and what presses on each.
#[inline(always)]
pub fn held<T: Real, const N: usize>(
    flight: &Flight<T, N>,
    contact: Contact,
    free: [T; N],
) -> ([T; N], [T; MOST]) {
    let mut pressing = [T::zero(); MOST];
    if contact.is_free() {
        return (free, pressing);
    }
    let matrix = &flight.pressing[contact.held() as usize];
    for (t, normal) in flight.normals().iter().enumerate() {
        let along = dot(&normal.direction, &free);
        for s in 0..flight.count {
            pressing[s] = pressing[s] + matrix[s][t] * along;
        }
    }
    let mut rest = free;
    for (s, normal) in flight.normals().iter().enumerate() {
        rest = axpy(-pressing[s], &normal.response, &rest);
    }
    (rest, pressing)
}
