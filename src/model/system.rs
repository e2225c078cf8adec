//! The equations of motion (2), in the form that every computation uses.

use nalgebra::Matrix4;
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
    /// the damping so strong, or the second mass so light, that one forcing period holds more than
    /// [`System::MOST_STEPS`] steps of the fastest motion.
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
        let fastest = fastest(&generator::free(&system).fixed_view::<4, 4>(0, 0).into_owned());
        // Not `max`, which would pass over a number that is none.
        system.rate = if fastest < omega { omega } else { fastest };
        system.divide()?;
        Ok(system)
    }

    /// Cuts the forcing period into steps short enough for the fastest motion.
    fn divide(&mut self) -> Result<(), SystemError> {
        let half_steps = (0.5 * self.rate * self.period() / Self::STEP).ceil();
        if half_steps.is_nan() || half_steps > f64::from(Self::MOST_STEPS / 2) {
            return Err(SystemError::TooStiff(self.parameters));
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
        if !frequency.is_finite() || frequency > self.rate {
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

    /// A state with the first mass no farther than its stops: rounding may have left it beyond.
    pub fn between_stops(&self, [x1, x2, v1, v2]: [f64; 4]) -> [f64; 4] {
        let delta = self.parameters.delta;
        [x1.clamp(-delta, delta), x2, v1, v2]
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
        "omega = {} with zeta = {}, mu_m = {}, mu_k = {} and mu_c = {} needs more than {most} steps per \
         forcing period: {remedy}",
        Number(.0.omega), Number(.0.zeta), Number(.0.mu_m), Number(.0.mu_k), Number(.0.mu_c),
        most = System::MOST_STEPS, remedy = remedy(.0)
    )]
    TooStiff(Parameters),
}

/// The parameter that is furthest from its default, in powers of e, and where to move it.
fn remedy(parameters: &Parameters) -> String {
    let odds = |ratio: f64| (ratio / (1.0 - ratio)).ln();
    let least = f64::MIN_POSITIVE;
    let far = [
        (-parameters.omega.max(least).ln(), "raise omega"),
        (parameters.zeta.max(least).ln() + 2.0, "lower zeta"),
        (-odds(parameters.mu_m.max(least)), "raise mu_m"),
        (odds(parameters.mu_k), "lower mu_k"),
        (odds(parameters.mu_c), "lower mu_c"),
    ];
    let (_, furthest) = far.into_iter().fold((0.0, "raise omega"), |a, b| if b.0 > a.0 { b } else { a });
    furthest.to_owned()
}

/// ‖A⁸‖^(1/8), scaled by a power of two against overflow; not a number where A holds what is none.
fn fastest(a: &Matrix4<f64>) -> f64 {
    if !a.iter().all(|entry| entry.is_finite()) {
        return f64::NAN;
    }
    let scale = 2.0_f64.powi(a.amax().log2().floor() as i32);
    let a = a / scale;
    let a2 = a * a;
    let a4 = a2 * a2;
    scale * (a4 * a4).norm().powf(0.125)
}
