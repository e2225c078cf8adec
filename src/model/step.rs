//! A whole step of flight: one matrix.

use nalgebra::SVector;

use super::equations::Equations;
use super::flow::{self, Augmented, mechanical};
use super::real::{Lanes, Real};
use super::state::State;

/// What a step of the length h makes of a state: y(t + h) = Φ y(t) + Γs sin φ + Γc cos φ + Γ₁ with y = (x1 … xN, v1 … vN).
///
/// The flow is linear, with any contacts that hold all the time as without; everything is non-dimensional. Φ and Γ come from the
/// exponential of the forced generator, so resonance without damping is no special case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step<T, const N: usize> {
    /// Φ's first N columns: what it makes of unit displacements.
    pub phi_x: [State<T, N>; N],
    /// Φ's last N columns: what it makes of unit velocities.
    pub phi_v: [State<T, N>; N],
    /// Γs, what it adds per unit of sin φ at its beginning.
    pub gamma_sin: State<T, N>,
    /// Γc, what it adds per unit of cos φ at its beginning.
    pub gamma_cos: State<T, N>,
    /// Γ₁, what the constant load adds.
    pub gamma_one: State<T, N>,
}

impl<const N: usize> Step<f64, N> {
    /// That of some equations.
    pub(super) fn of(equations: &Equations<N>, h: f64) -> Self {
        let unit = |i: usize| SVector::<f64, N>::from_fn(|j, _| if i == j { 1.0 } else { 0.0 });
        let zero = Augmented::<N>::zeros();
        let stepped = |z: Augmented<N>| mechanical(&flow::over(equations, h, z));
        Step {
            phi_x: std::array::from_fn(|i| stepped(Augmented { x: unit(i), ..zero })),
            phi_v: std::array::from_fn(|i| stepped(Augmented { v: unit(i), ..zero })),
            gamma_sin: stepped(Augmented { sin: 1.0, ..zero }),
            gamma_cos: stepped(Augmented { cos: 1.0, ..zero }),
            gamma_one: stepped(Augmented { one: 1.0, ..zero }),
        }
    }

    /// Rounded to another precision.
    pub(super) fn round<T: Real>(&self) -> Step<T, N> {
        let state = |s: State<f64, N>| s.map(T::of);
        Step {
            phi_x: self.phi_x.map(state),
            phi_v: self.phi_v.map(state),
            gamma_sin: state(self.gamma_sin),
            gamma_cos: state(self.gamma_cos),
            gamma_one: state(self.gamma_one),
        }
    }
}

impl<T: Copy, const N: usize> Step<T, N> {
    pub(super) fn blank(zero: T) -> Self {
        let state = State { x: [zero; N], v: [zero; N] };
        Step { phi_x: [state; N], phi_v: [state; N], gamma_sin: state, gamma_cos: state, gamma_one: state }
    }
}

impl<L: Lanes, const N: usize> Step<L, N> {
    /// The state after it, from that before it and the forcing phasor then.
    #[inline(always)]
    pub fn of_state(&self, state: &State<L, N>, sin: L, cos: L) -> State<L, N> {
        let mut after = self.gamma_one.plus(sin, &self.gamma_sin).plus(cos, &self.gamma_cos);
        for i in 0..N {
            after = after.plus(state.x[i], &self.phi_x[i]);
        }
        for i in 0..N {
            after = after.plus(state.v[i], &self.phi_v[i]);
        }
        after
    }

    /// The deviation after it, from that before it.
    #[inline(always)]
    pub fn of_deviation(&self, deviation: &State<L, N>) -> State<L, N> {
        let mut after = self.phi_x[0].scaled(deviation.x[0]);
        for i in 1..N {
            after = after.plus(deviation.x[i], &self.phi_x[i]);
        }
        for i in 0..N {
            after = after.plus(deviation.v[i], &self.phi_v[i]);
        }
        after
    }

    /// Puts a step into one lane.
    pub(super) fn set_lane(&mut self, lane: usize, step: &Step<L::Real, N>) {
        for i in 0..N {
            self.phi_x[i].set_lane(lane, &step.phi_x[i]);
            self.phi_v[i].set_lane(lane, &step.phi_v[i]);
        }
        self.gamma_sin.set_lane(lane, &step.gamma_sin);
        self.gamma_cos.set_lane(lane, &step.gamma_cos);
        self.gamma_one.set_lane(lane, &step.gamma_one);
    }
}
