//! A second harmonic force, on the first mass: one more phasor beside the forcing's, so that flight stays exact.

use std::fmt::Debug;

use crate::model::{Drive as Constants, Real};

/// What drives the first mass besides the forcing: nothing, or a [`Phasor`].
pub trait Drive<T>: Copy + Debug + PartialEq {
    /// The Taylor series of the drive within one flight.
    type Series: DriveSeries<T, Drive = Self>;

    /// `acceleration` of the first mass with the drive's share.
    #[must_use]
    fn pushed(&self, acceleration: T) -> T;

    /// `jerk` of the first mass with the drive's share.
    #[must_use]
    fn jerked(&self, jerk: T) -> T;

    /// A bound on |x1''''| with the drive's share.
    #[must_use]
    fn bounded(&self, bound: T) -> T;

    /// Component `i` of the state after one step, with what the drive adds to it.
    #[must_use]
    fn carried(&self, i: usize, value: T) -> T;

    /// The drive one step later.
    #[must_use]
    fn stepped(&self) -> Self;

    /// The drive a time `s` later, so short that its square is lost in rounding.
    #[must_use]
    fn nudged(&self, s: T) -> Self;

    /// The series of a flight of length `s`.
    fn series(&self, s: T) -> Self::Series;
}

/// Derivatives of a drive, each multiplied by its power of the flight's length, and the sum of the series.
pub trait DriveSeries<T>: Copy {
    /// What the series sums up to.
    type Drive;

    /// A term of the first mass's velocity with what the present derivative forces, `time` being s in free flight.
    #[must_use]
    fn forced(&self, term: T, time: T) -> T;

    /// Goes on to the next derivative and adds it to the sum with its weight 1/k!.
    fn next(&mut self, weight: T);

    /// The drive at the end of the flight.
    fn end(&self) -> Self::Drive;
}

/// No drive, at no cost.
impl<T> Drive<T> for () {
    type Series = ();

    #[inline(always)]
    fn pushed(&self, acceleration: T) -> T {
        acceleration
    }

    #[inline(always)]
    fn jerked(&self, jerk: T) -> T {
        jerk
    }

    #[inline(always)]
    fn bounded(&self, bound: T) -> T {
        bound
    }

    #[inline(always)]
    fn carried(&self, _: usize, value: T) -> T {
        value
    }

    #[inline(always)]
    fn stepped(&self) -> Self {}

    #[inline(always)]
    fn nudged(&self, _: T) -> Self {}

    #[inline(always)]
    fn series(&self, _: T) -> Self::Series {}
}

impl<T> DriveSeries<T> for () {
    type Drive = ();

    #[inline(always)]
    fn forced(&self, term: T, _: T) -> T {
        term
    }

    #[inline(always)]
    fn next(&mut self, _: T) {}

    #[inline(always)]
    fn end(&self) -> Self::Drive {}
}

/// The force u = B sin θ on the first mass, θ' = γω: the phasor (B sin θ, B cos θ), non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phasor<'a, T> {
    /// B sin θ, the force.
    pub sin: T,
    /// B cos θ.
    pub cos: T,
    /// |B|.
    pub amplitude: T,
    /// What the drive does to the flight, per unit of B.
    pub constants: &'a Constants<T>,
}

impl<'a, T: Real> Phasor<'a, T> {
    /// A force of amplitude `b` whose phase θ has the given sine and cosine.
    pub fn new(constants: &'a Constants<T>, b: T, [sin, cos]: [T; 2]) -> Self {
        Phasor { sin: b * sin, cos: b * cos, amplitude: b.abs(), constants }
    }
}

impl<'a, T: Real> Drive<T> for Phasor<'a, T> {
    type Series = PhasorSeries<'a, T>;

    #[inline(always)]
    fn pushed(&self, acceleration: T) -> T {
        acceleration + self.sin
    }

    #[inline(always)]
    fn jerked(&self, jerk: T) -> T {
        jerk + self.constants.omega * self.cos
    }

    #[inline(always)]
    fn bounded(&self, bound: T) -> T {
        bound + self.constants.bound * self.amplitude
    }

    #[inline(always)]
    fn carried(&self, i: usize, value: T) -> T {
        value + (self.constants.gamma_sin[i] * self.sin + self.constants.gamma_cos[i] * self.cos)
    }

    #[inline(always)]
    fn stepped(&self) -> Self {
        let Constants { turn_sin, turn_cos, .. } = *self.constants;
        Phasor {
            sin: self.sin * turn_cos + self.cos * turn_sin,
            cos: self.cos * turn_cos - self.sin * turn_sin,
            ..*self
        }
    }

    #[inline(always)]
    fn nudged(&self, s: T) -> Self {
        let turn = self.constants.omega * s;
        Phasor { sin: self.sin + self.cos * turn, cos: self.cos - self.sin * turn, ..*self }
    }

    #[inline(always)]
    fn series(&self, s: T) -> Self::Series {
        PhasorSeries { sum: *self, term: [self.sin, self.cos], turn: self.constants.omega * s }
    }
}

/// See [`DriveSeries`].
#[derive(Clone, Copy, Debug)]
pub struct PhasorSeries<'a, T> {
    sum: Phasor<'a, T>,
    term: [T; 2],
    turn: T,
}

impl<'a, T: Real> DriveSeries<T> for PhasorSeries<'a, T> {
    type Drive = Phasor<'a, T>;

    #[inline(always)]
    fn forced(&self, term: T, time: T) -> T {
        term + self.term[0] * time
    }

    #[inline(always)]
    fn next(&mut self, weight: T) {
        self.term = [self.term[1] * self.turn, -(self.term[0] * self.turn)];
        self.sum.sin = self.sum.sin + weight * self.term[0];
        self.sum.cos = self.sum.cos + weight * self.term[1];
    }

    #[inline(always)]
    fn end(&self) -> Self::Drive {
        self.sum
    }
}
