//! The equations of motion (2), in the form that every computation uses.

use thiserror::Error;

use super::generator;
use super::number::Number;
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
    rate: f64,
    steps: u32,
}

impl System {
    /// rate·h is kept below this: large enough for few steps, small enough for low orders.
    const STEP: f64 = 0.7;
    /// The most steps of one forcing period that are accepted.
    pub const MOST_STEPS: u32 = 1 << 16;

    /// A system with checked parameters.
    ///
    /// # Errors
    /// The first parameter that is out of its physical range, and [`SystemError::TooStiff`] where ω is so slow,
    /// or the damping so strong, that one forcing period holds more than [`System::MOST_STEPS`] steps of the
    /// fastest motion.
    pub fn new(parameters: Parameters) -> Result<Self, SystemError> {
        parameters.check()?;
        let Parameters { omega, zeta, mu_m, mu_k, mu_c, f20, .. } = parameters;
        let inverse_mass = (1.0 - mu_m) / mu_m;
        let mut system = System {
            parameters,
            coupling_damping: 2.0 * zeta,
            inverse_mass,
            ground_stiffness: inverse_mass * (mu_k / (1.0 - mu_k)),
            ground_damping: inverse_mass * (2.0 * zeta * (mu_c / (1.0 - mu_c))),
            force1: 1.0 - f20,
            force2: inverse_mass * f20,
            rate: omega,
            steps: 0,
        };
        let a = generator::free(&system).fixed_view::<4, 4>(0, 0).into_owned();
        let a2 = a * a;
        let a4 = a2 * a2;
        system.rate = (a4 * a4).norm().powf(0.125).max(omega);
        system.divide()?;
        Ok(system)
    }

    /// Cuts the forcing period into steps short enough for the fastest motion.
    fn divide(&mut self) -> Result<(), SystemError> {
        let half_steps = (0.5 * self.rate * self.period() / Self::STEP).ceil();
        if half_steps.is_nan() || half_steps > f64::from(Self::MOST_STEPS / 2) {
            let Parameters { omega, zeta, .. } = self.parameters;
            return Err(SystemError::TooStiff { omega, zeta });
        }
        self.steps = 2 * half_steps as u32;
        Ok(())
    }

    /// The same system, in steps short enough for a drive of frequency γω too, `ratio` = γ ≥ 0.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many of them.
    pub fn following(mut self, ratio: f64) -> Result<Self, SystemError> {
        let frequency = ratio * self.parameters.omega;
        if frequency > self.rate || frequency.is_nan() {
            self.rate = frequency;
            self.divide()?;
        }
        Ok(self)
    }

    /// The same masses, springs and dampers under nothing but a unit force of frequency γω on the first mass.
    pub(super) fn driven(mut self, ratio: f64) -> Self {
        self.parameters.omega *= ratio;
        self.force1 = 1.0;
        self.force2 = 0.0;
        self
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

    /// The fastest rate of the flow: ω, or ‖A⁸‖^(1/8) of the unforced generator A, which lies just above the
    /// modulus of its largest eigenvalue. Taylor terms of a flight of length s shrink like (rate·s)ᵏ/k!.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// M, the steps in one forcing period: even, so that phases 0 and π fall on steps.
    pub fn steps(&self) -> u32 {
        self.steps
    }
}

/// Why a system was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SystemError {
    /// A parameter is outside its physical range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The time scales are too far apart.
    #[error(
        "omega = {} with zeta = {} needs more than {steps} steps per forcing period: raise omega or \
         lower zeta (or move mu_m, mu_k, mu_c away from 0 and 1)",
        Number(*omega),
        Number(*zeta),
        steps = System::MOST_STEPS
    )]
    TooStiff {
        /// The forcing frequency.
        omega: f64,
        /// The damping ratio.
        zeta: f64,
    },
}
