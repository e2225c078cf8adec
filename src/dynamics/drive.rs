//! A second harmonic force, on one coordinate: one more phasor beside the forcing's, so that flight stays exact.

use std::fmt::Debug;

use crate::model::vector::axpy;
use crate::model::{Drive as Constants, Lanes, Real, State};

/// What drives one coordinate besides the forcing: nothing, or a [`Phasor`].
pub trait Drive<T: Lanes, const N: usize>: Copy + Debug + PartialEq {
    /// The Taylor series of the drive within one flight.
    type Series: DriveSeries<T, N, Drive = Self>;

    /// `yes` where the mask holds, `no` elsewhere.
    #[must_use]
    fn select(mask: T::Mask, yes: Self, no: Self) -> Self;

    /// Accelerations with the drive's share.
    #[must_use]
    fn pushed(&self, acceleration: [T; N]) -> [T; N];

    /// Their derivatives with the drive's share.
    #[must_use]
    fn jerked(&self, jerk: [T; N]) -> [T; N];

    /// A bound on the fourth derivative of d·x along a normal, with the drive's share.
    #[must_use]
    fn bounded(&self, normal: usize, bound: T) -> T;

    /// The state after one step, with what the drive adds to it.
    #[must_use]
    fn carried(&self, state: State<T, N>) -> State<T, N>;

    /// The drive one step later.
    #[must_use]
    fn stepped(&self) -> Self;

    /// The drive a time `s` later, so short that its square is lost in rounding.
    #[must_use]
    fn nudged(&self, s: T) -> Self;

    /// The drive a time `s` later, so short that its cube is lost in rounding.
    #[must_use]
    fn slid(&self, s: T) -> Self;

    /// The series of a flight of length `s`.
    fn series(&self, s: T) -> Self::Series;
}

/// Derivatives of a drive, each multiplied by its power of the flight's length, and the sum of the series.
pub trait DriveSeries<T, const N: usize>: Copy {
    /// What the series sums up to.
    type Drive;

    /// A term of the velocities with what the present derivative forces, in a flight of length `s`.
    #[must_use]
    fn forced(&self, term: [T; N], s: T) -> [T; N];

    /// Goes on to the next derivative and adds it to the sum with its weight 1/k!.
    fn next(&mut self, weight: T);

    /// The drive at the end of the flight.
    fn end(&self) -> Self::Drive;
}

/// No drive, at no cost.
impl<T: Lanes, const N: usize> Drive<T, N> for () {
    type Series = ();

    #[inline(always)]
    fn select(_: T::Mask, (): Self, (): Self) -> Self {}

    #[inline(always)]
    fn pushed(&self, acceleration: [T; N]) -> [T; N] {
        acceleration
    }

    #[inline(always)]
    fn jerked(&self, jerk: [T; N]) -> [T; N] {
        jerk
    }

    #[inline(always)]
    fn bounded(&self, _: usize, bound: T) -> T {
        bound
    }

    #[inline(always)]
    fn carried(&self, state: State<T, N>) -> State<T, N> {
        state
    }

    #[inline(always)]
    fn stepped(&self) -> Self {}

    #[inline(always)]
    fn nudged(&self, _: T) -> Self {}

    #[inline(always)]
    fn slid(&self, _: T) -> Self {}

    #[inline(always)]
    fn series(&self, _: T) -> Self::Series {}
}

impl<T, const N: usize> DriveSeries<T, N> for () {
    type Drive = ();

    #[inline(always)]
    fn forced(&self, term: [T; N], _: T) -> [T; N] {
        term
    }

    #[inline(always)]
    fn next(&mut self, _: T) {}

    #[inline(always)]
    fn end(&self) -> Self::Drive {}
}

/// The force u = B sin θ on one coordinate, θ' = γω: the phasor (B sin θ, B cos θ), non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phasor<'a, T, const N: usize> {
    /// B sin θ, the force.
    pub sin: T,
    /// B cos θ.
    pub cos: T,
    /// |B|.
    pub amplitude: T,
    /// What the drive does to the flight, per unit of B.
    pub constants: &'a Constants<T, N>,
}

impl<'a, T: Real, const N: usize> Phasor<'a, T, N> {
    /// A force of amplitude `b` whose phase θ has the given sine and cosine.
    pub fn new(constants: &'a Constants<T, N>, b: T, [sin, cos]: [T; 2]) -> Self {
        Phasor { sin: b * sin, cos: b * cos, amplitude: b.abs(), constants }
    }
}

impl<'a, T: Real, const N: usize> Drive<T, N> for Phasor<'a, T, N> {
    type Series = PhasorSeries<'a, T, N>;

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn pushed(&self, acceleration: [T; N]) -> [T; N] {
        axpy(self.sin, &self.constants.push, &acceleration)
    }

    #[inline(always)]
    fn jerked(&self, jerk: [T; N]) -> [T; N] {
        axpy(self.constants.omega * self.cos, &self.constants.push, &jerk)
    }

    #[inline(always)]
    fn bounded(&self, normal: usize, bound: T) -> T {
        bound + self.constants.bound[normal] * self.amplitude
    }

    #[inline(always)]
    fn carried(&self, state: State<T, N>) -> State<T, N> {
        state.plus(self.sin, &self.constants.gamma_sin).plus(self.cos, &self.constants.gamma_cos)
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
    fn slid(&self, s: T) -> Self {
        let turn = self.constants.omega * s;
        let half = turn * T::of(0.5);
        Phasor {
            sin: self.sin + turn * (self.cos - half * self.sin),
            cos: self.cos - turn * (self.sin + half * self.cos),
            ..*self
        }
    }

    #[inline(always)]
    fn series(&self, s: T) -> Self::Series {
        PhasorSeries { sum: *self, term: [self.sin, self.cos], turn: self.constants.omega * s }
    }
}

/// See [`DriveSeries`].
#[derive(Clone, Copy, Debug)]
pub struct PhasorSeries<'a, T, const N: usize> {
    sum: Phasor<'a, T, N>,
    /// The derivatives of (sin, cos), multiplied by their power of the length.
    term: [T; 2],
    /// γω s.
    turn: T,
}

impl<'a, T: Real, const N: usize> DriveSeries<T, N> for PhasorSeries<'a, T, N> {
    type Drive = Phasor<'a, T, N>;

    #[inline(always)]
    fn forced(&self, term: [T; N], s: T) -> [T; N] {
        axpy(self.term[0] * s, &self.sum.constants.push, &term)
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
