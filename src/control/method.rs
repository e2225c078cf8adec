//! The control methods, one of which is at work.

use super::action::{Action, Method, Seen};
use super::delay::Delay;
use super::pulse::Pulse;
use super::sine::Sine;
use crate::dynamics::Stop;
use crate::model::Real;

/// One of the three methods, at work on the section of a stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Controller<T> {
    /// No control; σ is that of the given stop.
    None(Stop),
    /// The adapted sine force.
    Sine(Sine<T>),
    /// The period pulse.
    Pulse(Pulse<T>),
    /// Delayed feedback.
    Delay(Delay<T>),
}

impl<T: Real, const N: usize> Method<T, N> for Controller<T> {
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        match self {
            Controller::None(_) => Action::none(),
            Controller::Sine(sine) => sine.act(seen),
            Controller::Pulse(pulse) => pulse.act(seen),
            Controller::Delay(delay) => delay.act(seen),
        }
    }
}

impl<T: Real> Controller<T> {
    /// The stop on whose section it acts.
    pub fn stop(&self) -> Stop {
        match self {
            Controller::None(stop) => *stop,
            Controller::Sine(sine) => sine.stop,
            Controller::Pulse(pulse) => pulse.stop,
            Controller::Delay(delay) => delay.stop,
        }
    }

    /// Whether the method itself has come to rest: only adaptation goes on where the motion may already have settled.
    pub fn is_at_rest(&self) -> bool {
        match self {
            Controller::Sine(sine) => sine.is_at_rest(),
            Controller::None(_) | Controller::Pulse(_) | Controller::Delay(_) => true,
        }
    }

    /// A controller rounded to another precision.
    pub fn rounded(controller: &Controller<f64>) -> Self {
        match controller {
            Controller::None(stop) => Controller::None(*stop),
            Controller::Sine(sine) => Controller::Sine(Sine {
                stop: sine.stop,
                convention: sine.convention,
                coordinate: sine.coordinate,
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
                stop: pulse.stop,
                period: pulse.period,
                target: pulse.target.map(T::of),
                noise: T::of(pulse.noise),
                seed: pulse.seed,
            }),
            Controller::Delay(delay) => Controller::Delay(Delay {
                stop: delay.stop,
                gains: delay.gains.map(T::of),
                delay: delay.delay,
            }),
        }
    }
}
