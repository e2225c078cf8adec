//! A sine force on one coordinate, its amplitude adapted: Eqs. (21) to (23).

use std::f64::consts::TAU;

use super::action::{Action, Method, Seen};
use super::components::Components;
use super::section_point::{SectionPoint, short_way, sine_and_cosine};
use crate::dynamics::Stop;
use crate::model::Real;

/// What u = B sin(γωt + φ) is; print leaves it open.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize, strum::IntoStaticStr)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
#[repr(u32)]
pub enum Convention {
    /// At each return to the section its first component, v1+, is changed by B sin(γωt + φ), t the time since the last
    /// return.
    Kick = 0,
    /// A force B sin(γθ + φ) on one coordinate between impacts, θ the phase of the forcing.
    #[cfg_attr(
        feature = "cli",
        value(help = "A force B sin(γθ + φ) on --coordinate between impacts, θ the phase of the forcing")
    )]
    Force = 1,
    /// A force B sin(γωt + φ) on one coordinate between impacts, t counted from each impact at the section's stop.
    #[cfg_attr(
        feature = "cli",
        value(
            help = "A force B sin(γωt + φ) on --coordinate between impacts, t counted from each impact at --stop"
        )
    )]
    ForceLocal = 2,
}

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

impl<T: Real, const N: usize> Method<T, N> for Sine<T> {
    /// Adapts B to the error, and kicks or sets the force.
    ///
    /// |e| < Δ leaves B alone; otherwise α changes its sign where |e(n+1)/e(n)| > 1, and B(n+1) = B(n) + α |e(n+1)|.
    #[inline(always)]
    fn act(&mut self, seen: &Seen<T, N>) -> Action<T, N> {
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

    /// Whether B stays as it is: it is not adapted, or the last error was within the dead band.
    pub fn is_at_rest(&self) -> bool {
        self.weight == T::zero() || (self.error >= T::zero() && self.error < self.dead_band)
    }

    /// How far a force is behind in phase on a trajectory that has met the stop later, by `later` of the forcing's phase.
    pub fn lag(&self, later: T) -> T {
        match self.convention {
            Convention::Kick | Convention::Force => T::zero(),
            Convention::ForceLocal => self.ratio * later,
        }
    }

    /// How a deviation (δX(n), then δX(n+1) as it arrives) passes the kick, B and α taken as they are.
    pub fn deviated<const N: usize>(
        &self,
        seen: &Seen<T, N>,
        before: &Components<T, N>,
        arrived: Components<T, N>,
    ) -> Components<T, N> {
        if self.convention != Convention::Kick {
            return arrived;
        }
        let [_, cos] = sine_and_cosine(self.angle(self.ratio * seen.turns));
        let tau = Components::<T, N>::TAU;
        let later = arrived[tau] - before[tau];
        let mut deviated = arrived;
        deviated[0] = arrived[0] + self.amplitude * cos * (self.ratio * later);
        deviated
    }
}
