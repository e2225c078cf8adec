//! Displacements and velocities.
//!
//! What happens to every trajectory again and again is done in loops and not by closures; see [`vector`](super::vector).

use super::real::Lanes;
use super::real::Real;
use super::vector::{MOST, added, axpy, dot, scaled, select};

/// Displacements and velocities of N coordinates, or a deviation of them; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<T, const N: usize> {
    /// Displacements.
    pub x: [T; N],
    /// Velocities.
    pub v: [T; N],
}

/// See [`BOUNDLESS`]: squares of what is shorter are numbers in either precision.
pub(crate) const BOUND: f64 = 1e18;

/// The square of the length of a state, 10¹⁸, from which on a motion counts as growing without bounds, and is followed no further.
pub const BOUNDLESS: f64 = BOUND * BOUND;

/// Whether the components of a state are bounded: see [`State::is_bounded`].
pub(crate) fn are_bounded<'a>(components: impl Iterator<Item = &'a f64>) -> bool {
    components.map(|value| value * value).sum::<f64>() < BOUNDLESS
}

impl<T: Real, const N: usize> State<T, N> {
    /// All zeros.
    #[inline(always)]
    pub fn zero() -> Self {
        State { x: [T::zero(); N], v: [T::zero(); N] }
    }

    /// From (x1 … xN, v1 … vN).
    ///
    /// # Panics
    /// If there are not 2N values.
    pub fn from_slice(values: &[T]) -> Self {
        assert_eq!(values.len(), 2 * N, "a state of {N} coordinates");
        State { x: std::array::from_fn(|i| values[i]), v: std::array::from_fn(|i| values[N + i]) }
    }

    /// x1 … xN, v1 … vN.
    #[inline(always)]
    pub fn values(&self) -> impl Iterator<Item = T> + '_ {
        self.x.iter().chain(&self.v).copied()
    }

    /// Component `i` of (x1 … xN, v1 … vN).
    #[inline(always)]
    pub fn get(&self, i: usize) -> T {
        if i < N { self.x[i] } else { self.v[i - N] }
    }

    /// The first coordinates.
    ///
    /// # Panics
    /// If there are fewer.
    #[inline(always)]
    pub fn first<const K: usize>(&self) -> State<T, K> {
        let mut first = State::zero();
        first.x.copy_from_slice(&self.x[..K]);
        first.v.copy_from_slice(&self.v[..K]);
        first
    }

    /// Whether every component is a finite number.
    #[inline(always)]
    pub fn is_finite(&self) -> bool {
        let mut finite = true;
        for i in 0..N {
            finite &= self.x[i].is_finite() & self.v[i].is_finite();
        }
        finite
    }

    /// Whether every component is a finite number, and together they are within [`BOUNDLESS`].
    #[inline(always)]
    pub fn is_bounded(&self) -> bool {
        self.is_finite() && self.square() < T::of(BOUNDLESS)
    }

    /// Each component by itself.
    #[inline(always)]
    pub fn map<U>(&self, f: impl Fn(T) -> U + Copy) -> State<U, N> {
        State { x: self.x.map(f), v: self.v.map(f) }
    }

    /// The Euclidean length.
    pub fn length(&self) -> T {
        self.square().sqrt()
    }
}

impl<L: Lanes, const N: usize> State<L, N> {
    /// self + a other.
    #[inline(always)]
    #[must_use]
    pub fn plus(&self, a: L, other: &Self) -> Self {
        State { x: axpy(a, &other.x, &self.x), v: axpy(a, &other.v, &self.v) }
    }

    /// self + other.
    #[inline(always)]
    #[must_use]
    pub fn added(&self, other: &Self) -> Self {
        State { x: added(&self.x, &other.x), v: added(&self.v, &other.v) }
    }

    /// a self.
    #[inline(always)]
    #[must_use]
    pub fn scaled(&self, a: L) -> Self {
        State { x: scaled(a, &self.x), v: scaled(a, &self.v) }
    }

    /// The square of the Euclidean length.
    #[inline(always)]
    pub fn square(&self) -> L {
        let mut squares = self.x[0].all(0.0);
        for i in 0..N {
            squares = squares + (self.x[i] * self.x[i] + self.v[i] * self.v[i]);
        }
        squares
    }

    /// The sum of the products of the components.
    #[inline(always)]
    pub fn dot(&self, other: &Self) -> L {
        dot(&self.x, &other.x) + dot(&self.v, &other.v)
    }

    /// `yes` where the mask holds, `no` elsewhere.
    #[inline(always)]
    #[must_use]
    pub fn select(mask: L::Mask, yes: &Self, no: &Self) -> Self {
        State { x: select(mask, &yes.x, &no.x), v: select(mask, &yes.v, &no.v) }
    }

    /// The state in one lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> State<L::Real, N> {
        let mut state = State { x: [self.x[0].lane(lane); N], v: [self.v[0].lane(lane); N] };
        for i in 0..N {
            (state.x[i], state.v[i]) = (self.x[i].lane(lane), self.v[i].lane(lane));
        }
        state
    }

    /// Puts a state into one lane.
    #[inline(always)]
    pub fn set_lane(&mut self, lane: usize, state: &State<L::Real, N>) {
        for i in 0..N {
            self.x[i].set_lane(lane, state.x[i]);
            self.v[i].set_lane(lane, state.v[i]);
        }
    }
}

/// A state (x1 … xn, v1 … vn) of a system whose number of coordinates is known at run time only; non-dimensional.
#[derive(Clone, Copy)]
pub struct StateVector {
    values: [f64; 2 * MOST],
    length: usize,
}

impl StateVector {
    /// A state of n coordinates at rest in the origin.
    pub fn zeros(coordinates: usize) -> Self {
        StateVector { values: [0.0; 2 * MOST], length: 2 * coordinates }
    }

    /// From x1 … xn, v1 … vn; none where there are not 2 to 8 values, in pairs.
    pub fn from_slice(values: &[f64]) -> Option<Self> {
        let fits = values.len().is_multiple_of(2) && (2..=2 * MOST).contains(&values.len());
        fits.then(|| {
            let mut state = StateVector::zeros(values.len() / 2);
            state.copy_from_slice(values);
            state
        })
    }

    /// From the state of a trajectory.
    pub fn of<T: Real, const N: usize>(state: &State<T, N>) -> Self {
        let mut vector = StateVector::zeros(N);
        for (value, from) in vector.iter_mut().zip(state.values()) {
            *value = from.widen();
        }
        vector
    }

    /// The state that a trajectory begins with.
    ///
    /// # Panics
    /// If there are not N coordinates.
    pub fn state<T: Real, const N: usize>(&self) -> State<T, N> {
        assert_eq!(self.length, 2 * N, "a state of {N} coordinates");
        State { x: std::array::from_fn(|i| T::of(self[i])), v: std::array::from_fn(|i| T::of(self[N + i])) }
    }

    /// See [`State::is_bounded`].
    pub fn is_bounded(&self) -> bool {
        are_bounded(self.iter())
    }

    /// The number of coordinates.
    pub fn coordinates(&self) -> usize {
        self.length / 2
    }
}

impl std::ops::Deref for StateVector {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.length]
    }
}

impl std::ops::DerefMut for StateVector {
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.values[..self.length]
    }
}

impl AsRef<[f64]> for StateVector {
    fn as_ref(&self) -> &[f64] {
        self
    }
}

impl PartialEq for StateVector {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl std::fmt::Debug for StateVector {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        (**self).fmt(f)
    }
}

impl From<[f64; 4]> for StateVector {
    fn from(values: [f64; 4]) -> Self {
        let mut state = StateVector::zeros(2);
        state.copy_from_slice(&values);
        state
    }
}

/// The four values of a state of two coordinates.
///
/// # Panics
/// If there are not two coordinates.
impl From<StateVector> for [f64; 4] {
    fn from(state: StateVector) -> [f64; 4] {
        (*state).try_into().expect("a state of two coordinates")
    }
}

impl serde::Serialize for StateVector {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de> serde::Deserialize<'de> for StateVector {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values = Vec::<f64>::deserialize(deserializer)?;
        StateVector::from_slice(&values)
            .ok_or_else(|| serde::de::Error::invalid_length(values.len(), &"2, 4, 6 or 8 values of a state"))
    }
}
