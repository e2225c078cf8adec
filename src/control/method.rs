//! What every control method does: look at a return to σ, and answer with a correction or a force.

use super::components::Components;
use super::delay::Delay;
use super::memory::Memory;
use super::pulse::Pulse;
use super::section::Section;
use super::sine::Sine;
use crate::dynamics::Stop;
use crate::model::Real;

/// What a method sees at a return to σ.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a, T, const N: usize> {
    /// F(X(n)), the point as it arrives.
    pub section: Section<T, N>,
    /// Forcing periods since the last return, as a real number.
    pub turns: T,
    /// Whole forcing periods since the start of the trajectory.
    pub periods: u32,
    /// Iterates since control was switched on; 0 at the first.
    pub controlled: u32,
    /// X(n), X(n−1), …
    pub memory: &'a Memory<T, N>,
}

/// What a method does at a return to σ; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action<T, const N: usize> {
    /// What is added to the point.
    pub correction: Components<T, N>,
    /// B of a force on one coordinate until the next return.
    pub force: T,
    /// The sine and cosine of its phase now.
    pub phase: [T; 2],
    /// The control signal: B, or the length of the correction.
    pub signal: T,
}

impl<T: Real, const N: usize> Action<T, N> {
    /// Nothing.
    pub fn none() -> Self {
        Action::correcting(Components::zero())
    }

    /// A correction and no force.
    pub fn correcting(correction: Components<T, N>) -> Self {
        let signal = correction.length();
        Action { correction, force: T::zero(), phase: [T::zero(), T::one()], signal }
    }
}

/// A method for suppressing chaos.
pub trait Method<T: Real, const N: usize> {
    /// What it does at a return to σ.
    fn act(&mut self, seen: &Seen<T, N>) -> Action<T, N>;
}

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
