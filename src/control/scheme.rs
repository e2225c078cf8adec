//! What is asked of a control method: checked settings, before any system is known.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::delay::Delay;
use super::memory::LONGEST;
use super::method::Controller;
use super::pulse::Pulse;
use super::section::Section;
use super::sine::{Convention, Sine};
use crate::model::{Parameter, ParameterError, Real, System, SystemError};
use crate::theory::symmetric_target;

/// A control method with its settings.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", tag = "method")]
pub enum Scheme {
    /// An adapted sine force, Eqs. (21) to (23).
    Sine(SineSetting),
    /// Period pulses, Eqs. (26) to (29).
    Pulse(PulseSetting),
    /// Delayed feedback, Eq. (30).
    Delay(DelaySetting),
}

/// Settings of the adapted sine force; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SineSetting {
    /// What u = B sin(γωt + φ) is.
    pub convention: Convention,
    /// B before the first adaptation.
    pub amplitude: f64,
    /// α, 0 ≤ α ≤ 1; with 0 the amplitude stays as it is.
    pub alpha: f64,
    /// Δ ≥ 0.
    pub dead_band: f64,
    /// γ > 0.
    pub gamma: f64,
    /// φ.
    pub phase: f64,
    /// Which component of X is held to that of the target: 0 to 3 for v1+, x2, v2, τ.
    pub component: usize,
    /// The target.
    pub target: Target,
}

/// Settings of the period pulse; non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PulseSetting {
    /// P ≥ 1, iterates from one pulse to the next.
    pub period: u32,
    /// X0.
    pub target: Target,
    /// E ≥ 0, the largest error of a measured component.
    pub noise: f64,
    /// What the errors are drawn from.
    pub seed: u32,
}

/// Settings of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DelaySetting {
    /// The diagonal of G, each between 0 and 1.
    pub gains: [f64; 4],
    /// p, iterates, 1 to [`LONGEST`].
    pub delay: u32,
    /// The sign of the feedback.
    pub sign: Sign,
}

/// The sign of delayed feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Sign {
    /// X(n+1) = F(X(n)) + G (X(n) − X(n−p)).
    Stabilising,
    /// X(n+1) = F(X(n)) + G (X(n−p) − X(n)), as Eq. (30) is printed.
    Printed,
}

/// A target on σ: the physical 1-1-1 symmetric motion at a reference frequency, or what is given instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// ω of the 1-1-1 motion; the other parameters are those of the controlled system.
    pub reference: f64,
    /// v1+, x2, v2 and τ where they are given.
    pub given: [Option<f64>; 4],
}

impl Target {
    /// The target's components (v1+, x2, v2, τ) for a system.
    ///
    /// # Errors
    /// [`ControlError::NoTarget`] where a component is to be that of a motion that does not exist.
    pub fn resolve(&self, system: &System, needed: &[usize]) -> Result<[f64; 4], ControlError> {
        let mut components = self.given.map(|value| value.unwrap_or(0.0));
        if needed.iter().any(|&i| self.given[i].is_none()) {
            let parameters = system.parameters().with(Parameter::Omega, self.reference);
            let delta = parameters.delta;
            let missing = ControlError::NoTarget { omega: self.reference, delta };
            let found = symmetric_target(&System::new(parameters)?).ok_or(missing)?;
            for (i, value) in found.into_iter().enumerate() {
                components[i] = self.given[i].unwrap_or(value);
            }
        }
        Ok(components)
    }

    fn check(&self) -> Result<(), ControlError> {
        let [v1, .., tau] = self.given;
        if let Some(value) = self.given.into_iter().flatten().find(|value| !value.is_finite()) {
            return Err(ControlError::TargetNotFinite(value));
        }
        if let Some(v1) = v1.filter(|&v1| v1 > 0.0) {
            return Err(ControlError::TargetVelocity(v1));
        }
        if let Some(tau) = tau.filter(|tau| !(0.0..std::f64::consts::TAU).contains(tau)) {
            return Err(ControlError::TargetPhase(tau));
        }
        Parameter::Omega.check(self.reference).map_err(ControlError::Reference)
    }
}

/// A setting of a control method that an axis can vary.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ControlQuantity {
    /// g, all four gains of delayed feedback.
    Gain,
    /// p of delayed feedback.
    Delay,
    /// B of the sine force, before adaptation.
    Amplitude,
    /// α of the sine force.
    Alpha,
    /// Δ of the sine force.
    DeadBand,
    /// γ of the sine force.
    Gamma,
    /// φ of the sine force.
    Phase,
    /// P of the period pulse.
    Period,
    /// E of the period pulse.
    Noise,
    /// v1+ of the target.
    TargetV1,
    /// x2 of the target.
    TargetX2,
    /// v2 of the target.
    TargetV2,
    /// τ of the target.
    TargetTau,
}

impl ControlQuantity {
    /// Every setting.
    pub const ALL: [ControlQuantity; 13] = [
        ControlQuantity::Gain,
        ControlQuantity::Delay,
        ControlQuantity::Amplitude,
        ControlQuantity::Alpha,
        ControlQuantity::DeadBand,
        ControlQuantity::Gamma,
        ControlQuantity::Phase,
        ControlQuantity::Period,
        ControlQuantity::Noise,
        ControlQuantity::TargetV1,
        ControlQuantity::TargetX2,
        ControlQuantity::TargetV2,
        ControlQuantity::TargetTau,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            ControlQuantity::Gain => "gain",
            ControlQuantity::Delay => "delay",
            ControlQuantity::Amplitude => "amplitude",
            ControlQuantity::Alpha => "alpha",
            ControlQuantity::DeadBand => "dead_band",
            ControlQuantity::Gamma => "gamma",
            ControlQuantity::Phase => "phase",
            ControlQuantity::Period => "period",
            ControlQuantity::Noise => "noise",
            ControlQuantity::TargetV1 => "target_v1",
            ControlQuantity::TargetX2 => "target_x2",
            ControlQuantity::TargetV2 => "target_v2",
            ControlQuantity::TargetTau => "target_tau",
        }
    }

    /// What the setting is, for axis titles.
    pub fn description(self) -> &'static str {
        match self {
            ControlQuantity::Gain => "feedback gain",
            ControlQuantity::Delay => "delay in iterates",
            ControlQuantity::Amplitude => "amplitude of the sine force",
            ControlQuantity::Alpha => "weight of the adaptation",
            ControlQuantity::DeadBand => "dead band",
            ControlQuantity::Gamma => "frequency ratio of the sine force",
            ControlQuantity::Phase => "phase of the sine force",
            ControlQuantity::Period => "pulse period in iterates",
            ControlQuantity::Noise => "largest error of measurement",
            ControlQuantity::TargetV1 => "target velocity after impact",
            ControlQuantity::TargetX2 => "target displacement of the second mass",
            ControlQuantity::TargetV2 => "target velocity of the second mass",
            ControlQuantity::TargetTau => "target phase",
        }
    }

    /// Whether only whole numbers make sense.
    pub fn is_whole(self) -> bool {
        matches!(self, ControlQuantity::Delay | ControlQuantity::Period)
    }

    fn target_index(self) -> Option<usize> {
        match self {
            ControlQuantity::TargetV1 => Some(0),
            ControlQuantity::TargetX2 => Some(1),
            ControlQuantity::TargetV2 => Some(2),
            ControlQuantity::TargetTau => Some(3),
            _ => None,
        }
    }
}

impl Scheme {
    /// The name of the method.
    pub fn method(&self) -> &'static str {
        match self {
            Scheme::Sine(_) => "sine",
            Scheme::Pulse(_) => "pulse",
            Scheme::Delay(_) => "delay",
        }
    }

    /// The same scheme with one setting changed (not checked); `None` if the method has no such setting.
    #[must_use]
    pub fn with(mut self, quantity: ControlQuantity, value: f64) -> Option<Self> {
        use ControlQuantity as Q;
        match (&mut self, quantity) {
            (Scheme::Delay(delay), Q::Gain) => delay.gains = [value; 4],
            (Scheme::Delay(delay), Q::Delay) => delay.delay = value as u32,
            (Scheme::Sine(sine), Q::Amplitude) => sine.amplitude = value,
            (Scheme::Sine(sine), Q::Alpha) => sine.alpha = value,
            (Scheme::Sine(sine), Q::DeadBand) => sine.dead_band = value,
            (Scheme::Sine(sine), Q::Gamma) => sine.gamma = value,
            (Scheme::Sine(sine), Q::Phase) => sine.phase = value,
            (Scheme::Pulse(pulse), Q::Period) => pulse.period = value as u32,
            (Scheme::Pulse(pulse), Q::Noise) => pulse.noise = value,
            (Scheme::Sine(SineSetting { target, component, .. }), quantity)
                if quantity.target_index() == Some(*component) =>
            {
                target.given[*component] = Some(value);
            }
            (Scheme::Pulse(PulseSetting { target, .. }), quantity) => {
                target.given[quantity.target_index()?] = Some(value);
            }
            _ => return None,
        }
        Some(self)
    }

    /// Checks every setting.
    ///
    /// # Errors
    /// The first setting that is out of range, with its value.
    pub fn check(&self) -> Result<(), ControlError> {
        match self {
            Scheme::Sine(sine) => sine.check(),
            Scheme::Pulse(pulse) => pulse.check(),
            Scheme::Delay(delay) => delay.check(),
        }
    }

    /// γ, if the scheme is a force between impacts.
    pub fn force_ratio(&self) -> Option<f64> {
        match self {
            Scheme::Sine(sine) if sine.convention != Convention::Kick => Some(sine.gamma),
            _ => None,
        }
    }

    /// The method at work on a system.
    ///
    /// # Errors
    /// A setting that is out of range, or a target that does not exist.
    pub fn resolve(&self, system: &System) -> Result<Controller<f64>, ControlError> {
        self.check()?;
        Ok(match self {
            Scheme::Sine(sine) => Controller::Sine(Sine {
                convention: sine.convention,
                amplitude: sine.amplitude,
                weight: sine.alpha,
                dead_band: sine.dead_band,
                ratio: sine.gamma,
                phase: (sine.phase / std::f64::consts::TAU).rem_euclid(1.0),
                component: sine.component,
                target: sine.target.resolve(system, &[sine.component])?[sine.component],
                error: -1.0,
            }),
            Scheme::Pulse(pulse) => Controller::Pulse(Pulse {
                period: pulse.period,
                target: Section::new(pulse.target.resolve(system, &[0, 1, 2, 3])?),
                noise: pulse.noise,
                seed: pulse.seed,
            }),
            Scheme::Delay(delay) => Controller::Delay(Delay {
                gains: match delay.sign {
                    Sign::Stabilising => delay.gains,
                    Sign::Printed => delay.gains.map(|gain| -gain),
                },
                delay: delay.delay,
            }),
        })
    }
}

impl SineSetting {
    fn check(&self) -> Result<(), ControlError> {
        let ranges = [
            (ControlQuantity::Amplitude, self.amplitude, self.amplitude.is_finite(), "a finite number"),
            (ControlQuantity::Alpha, self.alpha, (0.0..=1.0).contains(&self.alpha), "between 0 and 1"),
            (
                ControlQuantity::DeadBand,
                self.dead_band,
                self.dead_band >= 0.0 && self.dead_band.is_finite(),
                "0 or greater",
            ),
            (
                ControlQuantity::Gamma,
                self.gamma,
                self.gamma > 0.0 && self.gamma <= Self::FASTEST,
                "greater than 0, and at most 100",
            ),
            (ControlQuantity::Phase, self.phase, self.phase.is_finite(), "a finite number"),
        ];
        check_ranges(&ranges)?;
        self.target.check()
    }

    /// The largest γ.
    pub const FASTEST: f64 = 100.0;
}

impl PulseSetting {
    fn check(&self) -> Result<(), ControlError> {
        let (period, noise) = (f64::from(self.period), self.noise);
        check_ranges(&[
            (ControlQuantity::Period, period, self.period > 0, "1 or greater"),
            (ControlQuantity::Noise, noise, noise >= 0.0 && noise.is_finite(), "0 or greater"),
        ])?;
        self.target.check()
    }
}

impl DelaySetting {
    fn check(&self) -> Result<(), ControlError> {
        let gain = |g: f64| (ControlQuantity::Gain, g, (0.0..=1.0).contains(&g), GAIN_RANGE);
        let whole = (1..=LONGEST as u32).contains(&self.delay);
        check_ranges(&self.gains.map(gain))?;
        check_ranges(&[(ControlQuantity::Delay, f64::from(self.delay), whole, "a whole number from 1 to 8")])
    }
}

/// Each multiplier λ of F gives μ² − (λ + g) μ + g = 0, whose roots have the product g.
const GAIN_RANGE: &str =
    "between 0 and 1: a larger gain makes every motion unstable (for the other sign see --sign)";

type Range = (ControlQuantity, f64, bool, &'static str);

fn check_ranges(ranges: &[Range]) -> Result<(), ControlError> {
    match ranges.iter().find(|(_, _, admitted, _)| !admitted) {
        Some(&(quantity, value, _, range)) => {
            Err(ControlError::OutOfRange { name: quantity.name(), value, range })
        }
        None => Ok(()),
    }
}

impl<T: Real> Controller<T> {
    /// A controller rounded to another precision.
    pub fn rounded(controller: &Controller<f64>) -> Self {
        match controller {
            Controller::None => Controller::None,
            Controller::Sine(sine) => Controller::Sine(Sine {
                convention: sine.convention,
                amplitude: T::of(sine.amplitude),
                weight: T::of(sine.weight),
                dead_band: T::of(sine.dead_band),
                ratio: T::of(sine.ratio),
                phase: T::of(sine.phase),
                component: sine.component,
                target: T::of(sine.target),
                error: T::of(sine.error),
            }),
            Controller::Pulse(pulse) => Controller::Pulse(Pulse {
                period: pulse.period,
                target: Section::new(pulse.target.components.map(T::of)),
                noise: T::of(pulse.noise),
                seed: pulse.seed,
            }),
            Controller::Delay(delay) => {
                Controller::Delay(Delay { gains: delay.gains.map(T::of), delay: delay.delay })
            }
        }
    }
}

/// Why a control method was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ControlError {
    /// A setting is out of its range.
    #[error("{name} = {value} is out of range: {name} must be {range}")]
    OutOfRange {
        /// The setting.
        name: &'static str,
        /// The value that was refused.
        value: f64,
        /// The range in words.
        range: &'static str,
    },
    /// The target motion does not exist.
    #[error(
        "there is no physical 1-1-1 motion at the reference omega = {omega} (delta = {delta}) to take as the target: \
         choose another --reference, or give --target"
    )]
    NoTarget {
        /// The reference frequency.
        omega: f64,
        /// The half clearance.
        delta: f64,
    },
    /// A component of the target is NaN or infinite.
    #[error("the target has a component of {0}: give finite numbers")]
    TargetNotFinite(f64),
    /// The target's velocity leads into the stop.
    #[error("the target velocity v1+ = {0} leads into stop A: after an impact there it is 0 or negative")]
    TargetVelocity(f64),
    /// The target's phase is not one.
    #[error("the target phase tau = {0} is out of range: tau must be between 0 and 2π (6.2832)")]
    TargetPhase(f64),
    /// The reference frequency cannot be used.
    #[error("the reference frequency cannot be used")]
    Reference(#[source] ParameterError),
    /// The system cannot be followed.
    #[error(transparent)]
    System(#[from] SystemError),
}
