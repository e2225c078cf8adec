//! A sine force on one coordinate, its amplitude adapted: Eqs. (21) to (23).

use std::f64::consts::TAU;

use super::convention::Convention;
use crate::control::action::{Action, Seen};
use crate::control::components::Components;
use crate::control::law::{Law, bits};
use crate::control::section_point::{SectionPoint, short_way, sine_and_cosine};
use crate::dynamics::Stop;
use crate::model::Real;

/// The adapted sine force at work.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sine<T> {
    /// The stop on whose section it acts.
    pub stop: Stop,
    /// What u is.
    pub convention: Convention,
    /// The coordinate that a force acts on.
    pub coordinate: usize,
    /// B.
    pub amplitude: T,
    /// α, with its present sign.
    pub weight: T,
    /// Δ.
    pub dead_band: T,
    /// γ.
    pub ratio: T,
    /// φ in turns.
    pub phase: T,
    /// Which component of X is held to the target.
    pub component: usize,
    /// The target.
    pub target: T,
    /// |e| of the last iterate, negative before the first.
    pub error: T,
}

impl<T: Real> Law<T> for Sine<T> {
    type Exact = Sine<f64>;

    fn rounded(sine: &Sine<f64>) -> Self {
        Sine {
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
        }
    }

    /// Adapts B to the error, and kicks or sets the force.
    ///
    /// |e| < Δ leaves B alone; otherwise α changes its sign where |e(n+1)/e(n)| > 1, and B(n+1) = B(n) + α |e(n+1)|.
    #[inline(always)]
    fn act<const N: usize>(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
        let error = self.error_of(&seen.section);
        if error >= self.dead_band {
            if self.error >= T::zero() && error > self.error {
                self.weight = -self.weight;
            }
            self.amplitude = self.amplitude + self.weight * error;
        }
        self.error = error;
        let tau = seen.section.tau() * T::of(1.0 / TAU);
        match self.convention {
            Convention::Kick => {
                let [sin, _] = sine_and_cosine(self.angle(self.ratio * seen.turns));
                let mut correction = Components::zero();
                correction[0] = self.amplitude * sin;
                let none = T::zero();
                Action { correction, force: none, phase: [none, T::one()], signal: self.amplitude }
            }
            Convention::Force => {
                let periods = T::of(f64::from(seen.periods));
                self.force(self.ratio * periods - (self.ratio * periods).floor() + self.ratio * tau)
            }
            Convention::ForceLocal => self.force(T::zero()),
        }
    }

    /// A kick depends on the time since the last return; B and α are taken as they are.
    #[inline(always)]
    fn passed<const N: usize>(
        &self,
        seen: &Seen<T, N>,
        before: &[Components<T, N>],
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        if self.convention != Convention::Kick {
            return arrived;
        }
        let [_, cos] = sine_and_cosine(self.angle(self.ratio * seen.turns));
        let tau = Components::<T, N>::TAU;
        let later = arrived[tau] - before[0][tau];
        let mut deviated = arrived;
        deviated[0] = arrived[0] + self.amplitude * cos * (self.ratio * later);
        deviated
    }

    /// Whether B stays as it is: it is not adapted, or the last error was within the dead band.
    fn is_at_rest(&self) -> bool {
        self.weight == T::zero() || (self.error >= T::zero() && self.error < self.dead_band)
    }

    fn held(self, signal: Option<T>) -> Self {
        Sine { weight: T::zero(), amplitude: signal.unwrap_or(self.amplitude), ..self }
    }

    fn force(&self) -> Option<(usize, T)> {
        (self.convention != Convention::Kick).then_some((self.coordinate, self.ratio))
    }

    fn begins_anew(&self) -> bool {
        self.convention == Convention::ForceLocal
    }

    fn target(&self) -> Option<Vec<T>> {
        Some(vec![self.target])
    }

    /// A force in phase with the forcing is a change of it; any other would be a coordinate more.
    fn check_on_device(&self) -> Result<(), &'static str> {
        let in_phase = self.ratio == T::one() && self.phase == T::zero();
        match self.convention {
            Convention::Kick => Ok(()),
            Convention::Force if in_phase => Ok(()),
            Convention::Force | Convention::ForceLocal => Err(
                "on the GPU a sine force is in phase with the forcing, gamma = 1 and phase = 0: use --backend cpu for any \
                 other",
            ),
        }
    }

    fn written(&self) -> Vec<u32> {
        let Sine { amplitude, weight, dead_band, ratio, phase, target, .. } = *self;
        let numbers = bits([amplitude, weight, dead_band, ratio, phase, target]);
        [vec![self.convention as u32, self.component as u32], numbers].concat()
    }
}

impl<T: Real> Sine<T> {
    /// |e|.
    fn error_of<const N: usize>(&self, section: &SectionPoint<T, N>) -> T {
        let error = section.components[self.component] - self.target;
        if self.component == Components::<T, N>::TAU { short_way(error).abs() } else { error.abs() }
    }

    /// An angle given in turns, with φ, between 0 and 2π.
    fn angle(&self, turns: T) -> T {
        let turns = turns + self.phase;
        T::of(TAU) * (turns - turns.floor())
    }

    fn force<const N: usize>(&self, turns: T) -> Action<T, N> {
        Action {
            correction: Components::zero(),
            force: self.amplitude,
            phase: sine_and_cosine(self.angle(turns)),
            signal: self.amplitude,
        }
    }
}
