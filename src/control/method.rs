//! What every control method does: look at a return to σ, and answer with a correction or a force.

use super::delay::Delay;
use super::memory::Memory;
use super::pulse::Pulse;
use super::section::Section;
use super::sine::Sine;
use crate::model::Real;

/// What a method sees at a return to σ.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a, T> {
    /// F(X(n)), the point as it arrives.
    pub section: Section<T>,
    /// Forcing periods since the last return, as a real number.
    pub turns: T,
    /// Whole forcing periods since the start of the trajectory.
    pub periods: u32,
    /// Iterates since control was switched on; 0 at the first.
    pub controlled: u32,
    /// X(n), X(n−1), …
    pub memory: &'a Memory<T>,
}

/// What a method does at a return to σ; everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Action<T> {
    /// What is added to the point.
    pub correction: [T; 4],
    /// B of a force on the first mass until the next return.
    pub force: T,
    /// The sine and cosine of its phase now.
    pub phase: [T; 2],
    /// The control signal: B, or the length of the correction.
    pub signal: T,
}

impl<T: Real> Action<T> {
    /// Nothing.
    pub fn none() -> Self {
        Action::correcting([T::zero(); 4])
    }

    /// A correction and no force.
    pub fn correcting(correction: [T; 4]) -> Self {
        let signal = length(&correction);
        Action { correction, force: T::zero(), phase: [T::zero(), T::one()], signal }
    }
}

/// The Euclidean length of a correction.
pub fn length<T: Real>(c: &[T; 4]) -> T {
    ((c[0] * c[0] + c[1] * c[1]) + (c[2] * c[2] + c[3] * c[3])).sqrt()
}

/// A method for suppressing chaos.
pub trait Method<T: Real> {
    /// What it does at a return to σ.
    fn act(&mut self, seen: &Seen<T>) -> Action<T>;
}

/// One of the three methods, at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Controller<T> {
    /// No control.
    None,
    /// The adapted sine force.
    Sine(Sine<T>),
    /// The period pulse.
    Pulse(Pulse<T>),
    /// Delayed feedback.
    Delay(Delay<T>),
}

impl<T: Real> Method<T> for Controller<T> {
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T>) -> Action<T> {
        match self {
            Controller::None => Action::none(),
            Controller::Sine(sine) => sine.act(seen),
            Controller::Pulse(pulse) => pulse.act(seen),
            Controller::Delay(delay) => delay.act(seen),
        }
    }
}

impl<T: Real> Controller<T> {
    /// Whether the method itself has come to rest: only adaptation goes on where the motion may already have settled.
    pub fn is_at_rest(&self) -> bool {
        match self {
            Controller::Sine(sine) => sine.is_at_rest(),
            Controller::None | Controller::Pulse(_) | Controller::Delay(_) => true,
        }
    }

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
