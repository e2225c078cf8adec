//! What flying under a second harmonic force on the first mass needs, computed once per cell in f64.

use super::flight::{Flight, bounds};
use super::generator::{self, COS, SIN};
use super::real::Real;
use super::system::System;

/// The constants of a force B sin θ on the first mass, θ' = γω, per unit of B; everything is non-dimensional.
///
/// Flight is linear, so the force adds to a step what the exponential of the generator with this force in place of
/// the forcing says: Γs B sin θ + Γc B cos θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive<T> {
    /// γω, the drive's frequency.
    pub omega: T,
    /// What one step adds per unit of B sin θ at its beginning.
    pub gamma_sin: [T; 4],
    /// What one step adds per unit of B cos θ at its beginning.
    pub gamma_cos: [T; 4],
    /// sin γωh, by which a step turns the phasor.
    pub turn_sin: T,
    /// cos γωh.
    pub turn_cos: T,
    /// What a unit of |B| adds to the bound on |x1''''| within one step; see [`Flight::bound`].
    pub bound: T,
}

impl Drive<f64> {
    /// For a drive of frequency γω, `ratio` = γ ≥ 0, on a cell whose steps are short enough for it: see
    /// [`System::following`].
    pub fn new(system: &System, flight: &Flight<f64>, ratio: f64) -> Self {
        let driven = system.driven(ratio);
        let omega = driven.parameters().omega;
        let column = |j: usize| {
            let z = generator::exponential_column(&driven, flight.h, j);
            [z[generator::X1], z[generator::X2], z[generator::V1], z[generator::V2]]
        };
        let (turn_sin, turn_cos) = (omega * flight.h).sin_cos();
        let (_, bound) = bounds(&driven, flight.h);
        Drive { omega, gamma_sin: column(SIN), gamma_cos: column(COS), turn_sin, turn_cos, bound }
    }

    /// The same constants, rounded to another precision.
    pub fn round<T: Real>(&self) -> Drive<T> {
        Drive {
            omega: T::of(self.omega),
            gamma_sin: self.gamma_sin.map(T::of),
            gamma_cos: self.gamma_cos.map(T::of),
            turn_sin: T::of(self.turn_sin),
            turn_cos: T::of(self.turn_cos),
            bound: T::of(self.bound),
        }
    }
}
