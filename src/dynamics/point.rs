//! A point of the motion and its free flight, as exact as the arithmetic.

use super::drive::{Drive, DriveSeries};
use super::series::{INVERSE_FACTORIALS, Series, axpy};
use crate::model::{Flight, Real};

/// State and forcing phasor at one instant, and that of a second force where there is one; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T, D = ()> {
    /// Displacement of the first mass.
    pub x1: T,
    /// Displacement of the second mass.
    pub x2: T,
    /// Velocity of the first mass.
    pub v1: T,
    /// Velocity of the second mass.
    pub v2: T,
    /// Sine of the forcing phase.
    pub sin: T,
    /// Cosine of the forcing phase.
    pub cos: T,
    /// What else drives the first mass; `()` is nothing.
    pub drive: D,
}

/// How the first mass moves for the next instants.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<T> {
    /// x1''.
    pub acceleration: T,
    /// x1'''.
    pub jerk: T,
    /// A bound on |x1''''| for the rest of the step.
    pub bound: T,
}

impl<T: Real> Point<T> {
    /// A point at forcing phase 0.
    pub fn at_phase_zero([x1, x2, v1, v2]: [T; 4]) -> Self {
        Point { x1, x2, v1, v2, sin: T::zero(), cos: T::one(), drive: () }
    }
}

impl<T: Real, D: Drive<T>> Point<T, D> {
    /// (x1, x2, v1, v2).
    #[inline(always)]
    pub fn state(&self) -> [T; 4] {
        [self.x1, self.x2, self.v1, self.v2]
    }

    /// The point one whole step h of free flight later.
    #[inline(always)]
    pub fn stepped(&self, flight: &Flight<T>) -> Self {
        let [c0, c1, c2, c3] = &flight.phi;
        let row = |i: usize| {
            let value = (c0[i] * self.x1 + c1[i] * self.x2)
                + (c2[i] * self.v1 + c3[i] * self.v2)
                + (flight.gamma_sin[i] * self.sin + flight.gamma_cos[i] * self.cos);
            self.drive.carried(i, value)
        };
        Point {
            x1: row(0),
            x2: row(1),
            v1: row(2),
            v2: row(3),
            sin: self.sin * flight.turn_cos + self.cos * flight.turn_sin,
            cos: self.cos * flight.turn_cos - self.sin * flight.turn_sin,
            drive: self.drive.stepped(),
        }
    }

    /// The point a time `s` ≤ h later, by the Taylor polynomial of Eq. (2).
    ///
    /// `free` is 1 in free flight and 0 while the first mass rests on a stop. The terms are kept as
    /// Vₖ = v⁽ᵏ⁾ sᵏ, which obey a recurrence of second order; 1/k! comes from a table.
    #[inline(always)]
    pub fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self {
        let series = Series::new(flight, s, free);
        let turn = flight.omega * s;
        let force = [flight.force1 * (s * free), flight.force2 * s];
        let mut before = [self.v1, self.v2];
        let first = series.first(flight, [self.x1, self.x2], before);
        let mut last = axpy(self.sin, force, first);
        let mut drive = self.drive.series(s);
        last[0] = drive.forced(last[0], s * free);
        let mut phasor = [self.cos * turn, -(self.sin * turn)];
        let mut velocity = before;
        let mut mean = before;
        let mut phase = [self.sin, self.cos];
        let mut power = T::one();
        for k in 1..=T::ORDER {
            let weight = T::of(INVERSE_FACTORIALS[k]);
            let lower = T::of(INVERSE_FACTORIALS[k + 1]);
            velocity = axpy(weight, last, velocity);
            mean = axpy(lower, last, mean);
            phase = axpy(weight, phasor, phase);
            drive.next(weight);
            let negligible;
            (power, negligible) = series.grow(power, k);
            if negligible {
                break;
            }
            let forced = [drive.forced(phasor[0] * force[0], s * free), phasor[0] * force[1]];
            let next = series.next(before, last, forced);
            before = last;
            last = next;
            phasor = [phasor[1] * turn, -(phasor[0] * turn)];
        }
        Point {
            x1: self.x1 + mean[0] * s,
            x2: self.x2 + mean[1] * s,
            v1: velocity[0],
            v2: velocity[1],
            sin: phase[0],
            cos: phase[1],
            drive: drive.end(),
        }
    }

    /// The point with v1 changed by `kick` a time `s` ≤ h ago: flight is linear, so the change just adds.
    #[inline(always)]
    pub fn kicked(&self, flight: &Flight<T>, kick: T, s: T) -> Self {
        let u = s * flight.inverse_h;
        let mut sum = flight.kick[T::ORDER];
        for k in (0..T::ORDER).rev() {
            for (sum, term) in sum.iter_mut().zip(flight.kick[k]) {
                *sum = *sum * u + term;
            }
        }
        let [x1, x2, v1, v2] = sum;
        Point {
            x1: self.x1 + kick * x1,
            x2: self.x2 + kick * x2,
            v1: self.v1 + kick * v1,
            v2: self.v2 + kick * v2,
            ..*self
        }
    }

    /// The point a time `s` later, so short that its square is lost in rounding.
    #[inline(always)]
    pub fn nudged(&self, flight: &Flight<T>, s: T) -> Self {
        let (a1, a2) = self.accelerations(flight);
        let turn = flight.omega * s;
        Point {
            x1: self.x1 + self.v1 * s,
            x2: self.x2 + self.v2 * s,
            v1: self.v1 + a1 * s,
            v2: self.v2 + a2 * s,
            sin: self.sin + self.cos * turn,
            cos: self.cos - self.sin * turn,
            drive: self.drive.nudged(s),
        }
    }

    /// x1'' and x2'' of Eq. (2).
    #[inline(always)]
    pub fn accelerations(&self, flight: &Flight<T>) -> (T, T) {
        let coupling = (self.x2 - self.x1) + flight.coupling_damping * (self.v2 - self.v1);
        let a1 = self.drive.pushed(coupling + flight.force1 * self.sin);
        let a2 = (flight.force2 * self.sin - flight.ground_stiffness * self.x2)
            - (flight.ground_damping * self.v2 + flight.inverse_mass * coupling);
        (a1, a2)
    }

    /// What decides when a stop can be reached (`free` = 1), or left (`free` = 0): in contact the acceleration
    /// is the contact force's, and the derivatives are along the motion that rests.
    #[inline(always)]
    pub fn motion(&self, flight: &Flight<T>, free: T) -> Motion<T> {
        let (acceleration, a2) = self.accelerations(flight);
        Motion {
            acceleration,
            jerk: self.drive.jerked(
                ((self.v2 - self.v1) + flight.coupling_damping * (a2 - free * acceleration))
                    + flight.force1 * flight.omega * self.cos,
            ),
            bound: self.bound(flight),
        }
    }

    /// A bound on |x1''''| (in contact: on the second derivative of the contact force) for the rest of the step.
    #[inline(always)]
    pub fn bound(&self, flight: &Flight<T>) -> T {
        let [b0, b1, b2, b3] = flight.bound;
        let bound = (b0 * self.x1.abs() + b1 * self.x2.abs())
            + (b2 * self.v1.abs() + b3 * self.v2.abs())
            + flight.bound_forcing;
        self.drive.bounded(bound)
    }
}
