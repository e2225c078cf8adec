//! The equations of motion (2), in the form that every computation uses.

use thiserror::Error;

use super::parameters::{ParameterError, Parameters};

/// A system whose parameters are in their physical range, ready to be followed.
///
/// The free flight, |x1| < δ, is Eq. (2) solved for the accelerations. With the force in the coupling
/// F = (x2 − x1) + 2ζ (v2 − v1) and the forcing phasor (s, c) = (sin φ, cos φ), φ = ωt:
///
/// ```text
/// x1'' = F + force1 · s
/// x2'' = −inverse_mass · F − ground_stiffness · x2 − ground_damping · v2 + force2 · s
/// ```
///
/// Any μm, μk, μc and ζ are covered: proportional or not, under- or overdamped, no modes are formed.
/// Everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct System {
    parameters: Parameters,
    /// 2ζ, the damping of the coupling.
    pub coupling_damping: f64,
    /// 1/m2 = (1 − μm)/μm, m2 the second mass in units of the first.
    pub inverse_mass: f64,
    /// (1/m2) μk/(1 − μk), stiffness of the second mass to ground over its mass.
    pub ground_stiffness: f64,
    /// (1/m2) 2ζ μc/(1 − μc), damping of the second mass to ground over its mass.
    pub ground_damping: f64,
    /// Amplitude of the forcing on the first mass, 1 − f20.
    pub force1: f64,
    /// Amplitude of the forcing on the second mass over its mass, f20/m2.
    pub force2: f64,
}

impl System {
    /// A system with checked parameters.
    ///
    /// # Errors
    /// The first parameter that is out of its physical range.
    pub fn new(parameters: Parameters) -> Result<Self, SystemError> {
        parameters.check()?;
        let Parameters { zeta, mu_m, mu_k, mu_c, f20, .. } = parameters;
        let inverse_mass = (1.0 - mu_m) / mu_m;
        let system = System {
            parameters,
            coupling_damping: 2.0 * zeta,
            inverse_mass,
            ground_stiffness: inverse_mass * (mu_k / (1.0 - mu_k)),
            ground_damping: inverse_mass * (2.0 * zeta * (mu_c / (1.0 - mu_c))),
            force1: 1.0 - f20,
            force2: inverse_mass * f20,
        };
        Ok(system)
    }

    /// The same system without forcing; ω stays as the clock that counts periods.
    #[must_use]
    pub fn unforced(mut self) -> Self {
        self.force1 = 0.0;
        self.force2 = 0.0;
        self
    }

    /// The parameters the system was made from.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// The forcing period T = 2π/ω, non-dimensional.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.parameters.omega
    }
}

/// Why a system was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SystemError {
    /// A parameter is outside its physical range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}
