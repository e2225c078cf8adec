//! What is asked of a control method: checked settings, before any system is known.

mod error;
mod quantity;
mod settings;
mod target;

use serde::{Deserialize, Serialize};

use super::delay::Delay;
use super::method::Controller;
use super::pulse::Pulse;
use super::sine::{Convention, Sine};
use super::surface::section_names;
use crate::dynamics::Stop;
use crate::model::System;

pub use error::ControlError;
pub use quantity::ControlQuantity;
pub use settings::{DelaySetting, PulseSetting, Sign, SineSetting};
pub use target::Target;

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

impl Scheme {
    /// The stop on whose section it acts.
    pub fn stop(&self) -> Stop {
        match self {
            Scheme::Sine(sine) => sine.stop,
            Scheme::Pulse(pulse) => pulse.stop,
            Scheme::Delay(delay) => delay.stop,
        }
    }

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
            (Scheme::Delay(delay), Q::Gain) => delay.gains = delay.gains.map(|_| value),
            (Scheme::Delay(delay), Q::Delay) => delay.delay = value as u32,
            (Scheme::Sine(sine), Q::Amplitude) => sine.amplitude = value,
            (Scheme::Sine(sine), Q::Alpha) => sine.alpha = value,
            (Scheme::Sine(sine), Q::DeadBand) => sine.dead_band = value,
            (Scheme::Sine(sine), Q::Gamma) => sine.gamma = value,
            (Scheme::Sine(sine), Q::Phase) => sine.phase = value,
            (Scheme::Pulse(pulse), Q::Period) => pulse.period = value as u32,
            (Scheme::Pulse(pulse), Q::Noise) => pulse.noise = value,
            (Scheme::Sine(SineSetting { target, component, .. }), quantity)
                if target.component(quantity) == Some(*component) =>
            {
                target.given[*component] = Some(value);
            }
            (Scheme::Pulse(PulseSetting { target, .. }), quantity) => {
                let place = target.component(quantity)?;
                target.given[place] = Some(value);
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
    /// A setting that is out of range or does not fit the system, or a target that does not exist.
    pub fn resolve(&self, system: &System) -> Result<Controller<f64>, ControlError> {
        self.check()?;
        let plant = system.plant();
        let (stop, components) = (self.stop(), 2 * plant.n);
        exists("stop", stop.index(), plant.stops.len())?;
        Ok(match self {
            Scheme::Sine(sine) => {
                exists("component of the section", sine.component, components)?;
                exists("coordinate", sine.coordinate, plant.n)?;
                Controller::Sine(Sine {
                    stop,
                    convention: sine.convention,
                    coordinate: sine.coordinate,
                    amplitude: sine.amplitude,
                    weight: sine.alpha,
                    dead_band: sine.dead_band,
                    ratio: sine.gamma,
                    phase: (sine.phase / std::f64::consts::TAU).rem_euclid(1.0),
                    component: sine.component,
                    target: sine.target.resolve(system, stop, &[sine.component])?[sine.component],
                    error: -1.0,
                })
            }
            Scheme::Pulse(pulse) => Controller::Pulse(Pulse {
                stop,
                period: pulse.period,
                target: pulse.target.resolve(system, stop, &Vec::from_iter(0..components))?,
                noise: pulse.noise,
                seed: pulse.seed,
            }),
            Scheme::Delay(delay) => {
                if delay.gains.len() != components {
                    let (given, names) = (delay.gains.len(), section_names(plant, stop).join(", "));
                    return Err(ControlError::Count { what: "gains", given, wanted: components, names });
                }
                Controller::Delay(Delay {
                    stop,
                    gains: match delay.sign {
                        Sign::Stabilising => delay.gains,
                        Sign::Printed => delay.gains.map(|gain| -gain),
                    },
                    delay: delay.delay,
                })
            }
        })
    }
}

/// Refuses the number of something that the system does not have.
fn exists(what: &'static str, number: usize, count: usize) -> Result<(), ControlError> {
    if number < count { Ok(()) } else { Err(ControlError::NoSuch { what, number, count }) }
}
