//! What flying under a second harmonic force needs, computed once per cell in f64.

use nalgebra::SVector;

use super::contact_normal::bound;
use super::equations::Equations;
use super::flight::Flight;
use super::flow::{self, Augmented, mechanical};
use super::real::Real;
use super::state::State;
use super::system::System;
use super::vector::MOST;

/// The constants of a force B sin θ on one coordinate, θ' = γω, per unit of B; everything is non-dimensional.
///
/// Flight is linear, so the force adds to a step what the exponential of the generator with this force in place of
/// the forcing says: Γs B sin θ + Γc B cos θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<T, const N: usize> {
    /// γω, the drive's frequency.
    pub omega: T,
    /// What a unit force accelerates: a column of M⁻¹.
    pub push: [T; N],
    /// What one step adds per unit of B sin θ at its beginning.
    pub gamma_sin: State<T, N>,
    /// What one step adds per unit of B cos θ at its beginning.
    pub gamma_cos: State<T, N>,
    /// sin γωh, by which a step turns the phasor.
    pub turn_sin: T,
    /// cos γωh.
    pub turn_cos: T,
    /// What a unit of |B| adds to the bounds on |(d·x)''''| within one step, by normal.
    pub bound: [T; MOST],
}

impl<const N: usize> Drive<f64, N> {
    /// For a drive of frequency γω, `ratio` = γ ≥ 0, of the first coordinate: see [`Drive::on`].
    pub fn new(system: &System, flight: &Flight<f64, N>, ratio: f64) -> Self {
        Drive::on(0, system, flight, ratio)
    }

    /// For a drive of frequency γω, `ratio` = γ ≥ 0, of one coordinate, on a cell whose steps are short enough for it: see
    /// [`System::following`].
    ///
    /// # Panics
    /// If there is no such coordinate.
    pub fn on(coordinate: usize, system: &System, flight: &Flight<f64, N>, ratio: f64) -> Self {
        assert!(coordinate < N, "coordinate {coordinate} of {N}");
        let plant = system.plant();
        let undriven = Equations::<N>::new(plant);
        let push = SVector::<f64, N>::from_column_slice(system.unit_force(coordinate).as_slice());
        let omega = ratio * plant.omega;
        let driven =
            Equations { sin: push, cos: SVector::zeros(), load: SVector::zeros(), omega, ..undriven };
        let [gamma_sin, gamma_cos] = driven_steps(&driven, flight.h);
        let (turn_sin, turn_cos) = (omega * flight.h).sin_cos();
        let bound = driven_bounds(&driven, flight.h);
        Drive { omega, push: push.into(), gamma_sin, gamma_cos, turn_sin, turn_cos, bound }
    }

    /// The same constants, rounded to another precision.
    pub fn round<T: Real>(&self) -> Drive<T, N> {
        Drive {
            omega: T::of(self.omega),
            push: self.push.map(T::of),
            gamma_sin: self.gamma_sin.map(T::of),
            gamma_cos: self.gamma_cos.map(T::of),
            turn_sin: T::of(self.turn_sin),
            turn_cos: T::of(self.turn_cos),
            bound: self.bound.map(T::of),
        }
    }
}

/// What one step adds per unit of the sine and of the cosine of a drive's phase at its beginning.
fn driven_steps<const N: usize>(driven: &Equations<N>, h: f64) -> [State<f64, N>; 2] {
    let zero = Augmented::zeros();
    [Augmented { sin: 1.0, ..zero }, Augmented { cos: 1.0, ..zero }]
        .map(|z| mechanical(&flow::over(driven, h, z)))
}

/// What a drive of unit amplitude adds to the bounds on the fourth derivative of d·x, by normal.
fn driven_bounds<const N: usize>(driven: &Equations<N>, h: f64) -> [f64; MOST] {
    std::array::from_fn(|k| {
        if k >= driven.count {
            return 0.0;
        }
        let bound = bound(driven, k, h);
        bound.sin.hypot(bound.cos)
    })
}
