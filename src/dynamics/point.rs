//! A point of the motion and its free flight, as exact as the arithmetic.

use crate::model::{Flight, Real};

/// State and forcing phasor at one instant; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point<T> {
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
        Point { x1, x2, v1, v2, sin: T::zero(), cos: T::one() }
    }

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
            (c0[i] * self.x1 + c1[i] * self.x2)
                + (c2[i] * self.v1 + c3[i] * self.v2)
                + (flight.gamma_sin[i] * self.sin + flight.gamma_cos[i] * self.cos)
        };
        Point {
            x1: row(0),
            x2: row(1),
            v1: row(2),
            v2: row(3),
            sin: self.sin * flight.turn_cos + self.cos * flight.turn_sin,
            cos: self.cos * flight.turn_cos - self.sin * flight.turn_sin,
        }
    }

    /// The point a time `s` ≤ h later, by the Taylor polynomial of Eq. (2).
    ///
    /// `free` is 1 in free flight and 0 while the first mass rests on a stop.
    #[inline(always)]
    pub fn flown(&self, flight: &Flight<T>, s: T, free: T) -> Self {
        let c = flight.coupling_damping;
        let turn = flight.omega * s;
        let reach = flight.rate * s;
        let negligible = T::of(T::TRUNCATION);
        let mut term = *self;
        let mut sum = *self;
        let mut size = T::one();
        for &inverse in &INVERSES[..T::ORDER] {
            let inverse = T::of(inverse);
            let coupling = (term.x2 - term.x1) + c * (term.v2 - term.v1);
            let a1 = coupling + flight.force1 * term.sin;
            let a2 = (flight.force2 * term.sin - flight.ground_stiffness * term.x2)
                - (flight.ground_damping * term.v2 + flight.inverse_mass * coupling);
            let scale = s * inverse;
            let turned = turn * inverse;
            term = Point {
                x1: term.v1 * scale,
                x2: term.v2 * scale,
                v1: a1 * (scale * free),
                v2: a2 * scale,
                sin: term.cos * turned,
                cos: -(term.sin * turned),
            };
            sum.x1 = sum.x1 + term.x1;
            sum.x2 = sum.x2 + term.x2;
            sum.v1 = sum.v1 + term.v1;
            sum.v2 = sum.v2 + term.v2;
            sum.sin = sum.sin + term.sin;
            sum.cos = sum.cos + term.cos;
            size = size * (reach * inverse);
            if size < negligible {
                break;
            }
        }
        sum
    }

    /// What decides when a stop can be reached (`free` = 1), or left (`free` = 0): in contact the acceleration
    /// is the contact force's, and the derivatives are along the motion that rests.
    #[inline(always)]
    pub fn motion(&self, flight: &Flight<T>, free: T) -> Motion<T> {
        let c = flight.coupling_damping;
        let coupling = (self.x2 - self.x1) + c * (self.v2 - self.v1);
        let acceleration = coupling + flight.force1 * self.sin;
        let a2 = (flight.force2 * self.sin - flight.ground_stiffness * self.x2)
            - (flight.ground_damping * self.v2 + flight.inverse_mass * coupling);
        Motion {
            acceleration,
            jerk: ((self.v2 - self.v1) + c * (a2 - free * acceleration))
                + flight.force1 * flight.omega * self.cos,
            bound: self.bound(flight),
        }
    }

    /// A bound on |x1''''| (in contact: on the second derivative of the contact force) for the rest of the step.
    #[inline(always)]
    pub fn bound(&self, flight: &Flight<T>) -> T {
        let [b0, b1, b2, b3] = flight.bound;
        (b0 * self.x1.abs() + b1 * self.x2.abs())
            + (b2 * self.v1.abs() + b3 * self.v2.abs())
            + flight.bound_forcing
    }
}

/// 1, 1/2, 1/3, …, the ratios of successive factorials in a Taylor series.
pub(super) const INVERSES: [f64; 24] = {
    let mut inverses = [0.0; 24];
    let mut k = 0;
    while k < inverses.len() {
        inverses[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    inverses
};
