//! The period-one double-impact symmetric motion of section 3, in closed form, of any system with a mirror.

use thiserror::Error;

use super::admissible::Inadmissible;
use super::flow::Flow;
use super::matched::Matched;
use super::motion::PeriodicMotion;
use super::section_vector::wrapped;
use crate::dynamics::Stop;
use crate::model::System;

/// How far a start on the symmetric motion is moved off it, so that an unstable one is left; non-dimensional.
pub const NUDGE: f64 = 1e-3;

/// One solution of the matching conditions (5); everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricMotion {
    /// The motion that the conditions describe, whether or not the system follows it.
    pub motion: PeriodicMotion,
    /// (x, v) at forcing phase 0 if the motion is physical, otherwise why no trajectory follows it.
    pub at_phase_zero: Result<Vec<f64>, Inadmissible>,
}

impl SymmetricMotion {
    /// The largest modulus among the half map's multipliers; the motion is stable where it is below 1.
    ///
    /// Infinite where the impacts graze, since there is nothing to linearise about.
    pub fn spectral_radius(&self, system: &System) -> f64 {
        self.motion.half_multipliers(system).map_or(f64::INFINITY, |values| values[0].norm())
    }
}

/// Why the matching conditions (5) have no solution.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoSymmetricMotion {
    /// The system has no mirror, or its mirror maps every stop onto itself.
    #[error("does not exist: the system has no mirror that exchanges two stops")]
    NoMirror,
    /// There is no room to move.
    #[error("does not exist: {0}")]
    Clamped(String),
    /// Whatever the phase, the motion would not reach from stop to stop.
    #[error(
        "does not exist: the forcing drives the matched motion to |{along}| = {amplitude} at most, short of the stops at \
         ±{delta}"
    )]
    OutOfReach {
        /// What meets the stops: a coordinate, or d·x.
        along: String,
        /// The largest displacement at impact over all phases, along the stop's direction.
        amplitude: f64,
        /// The stop's gap.
        delta: f64,
    },
    /// Whatever the phase, the motion would not reach from stop to stop, and the constant load has a share in that.
    #[error("does not exist: the matched motion would need a forcing {factor} times as strong")]
    TooWeak {
        /// How strong the forcing would have to be at least.
        factor: f64,
    },
    /// The matching conditions are singular.
    #[error("does not exist: the matching conditions are singular here")]
    Singular,
}

/// Both solutions of (5), in the order of τ: the motion between two stops that the mirror exchanges, the first such.
///
/// With Φ the flight over half a period from y = (x, v), Γs, Γc and Γ₁ what forcing at phase τ and the constant load add
/// to it, D the impact at the other stop and P the mirror, the state y just after the impact at the first stop satisfies
/// (DΦ − P) y + D (Γs sin τ + Γc cos τ + Γ₁) = 0 with d·x = gap: 2n equations for the other 2n − 1 components of y,
/// sin τ and cos τ. Their solutions are a straight line, which sin² τ + cos² τ = 1 meets twice. DΦ − P itself is singular
/// at a resonance without damping, and wherever r = 1 and ζ = 0 in the paper's oscillator; the line is not.
///
/// # Errors
/// [`NoSymmetricMotion`] where no real τ solves it, or there is no such mirror.
pub fn symmetric_motions(system: &System) -> Result<[SymmetricMotion; 2], NoSymmetricMotion> {
    let mut matched = Matched::of(system)?;
    Ok([0, 1].map(|k| matched.followed(k)))
}

/// (x, v) at forcing phase 0 on the stable-branch 1-1-1 symmetric motion, nudged, where it exists and is physical.
///
/// Of two physical solutions the one with the smaller multipliers is taken. The first displacement that no stop bears on
/// is nudged, the first velocity where there is none.
pub fn symmetric_start(system: &System) -> Option<Vec<f64>> {
    let mut state = stable_branch(system)?.at_phase_zero.ok()?;
    let plant = system.plant();
    let borne = |i: &usize| plant.stops.iter().any(|stop| stop.direction[*i] != 0.0);
    let nudged = (0..plant.n).find(|i| !borne(i)).unwrap_or(plant.n);
    state[nudged] += NUDGE;
    Some(state)
}

/// The fixed point of the same motion on the section at its first stop, (v1+, x2, v2, τ) of the paper's oscillator, where
/// it exists and is physical.
pub fn symmetric_target(system: &System) -> Option<Vec<f64>> {
    stable_branch(system).map(|motion| motion.motion.section())
}

/// The same point on the section at a stop; none where the motion does not meet it, or is not physical.
pub fn symmetric_target_at(system: &System, stop: Stop) -> Option<Vec<f64>> {
    let motion = stable_branch(system)?.motion;
    if motion.pattern.stops[0] == stop {
        return Some(motion.section());
    }
    let image = motion.pattern.closing(&Flow::new(system), &motion.sections[0]);
    let mut section = image.section.as_slice().to_vec();
    let tau = section.last_mut()?;
    *tau = wrapped(*tau);
    (image.stop == stop).then_some(section)
}

/// Of two physical solutions the one with the smaller multipliers, of one that one.
///
/// Where the one that can be stable is, the other is a saddle and need not be looked at; see [`Matched::regular`].
pub(super) fn stable_branch(system: &System) -> Option<SymmetricMotion> {
    let mut matched = Matched::of(system).ok()?;
    let regular = matched.regular();
    let first = matched.followed(regular);
    if first.at_phase_zero.is_ok() && matched.contracts(regular) {
        return Some(first);
    }
    let second = matched.followed(1 - regular);
    let [a, b] = if regular == 0 { [first, second] } else { [second, first] };
    match (a.at_phase_zero.is_ok(), b.at_phase_zero.is_ok()) {
        (true, true) => Some(if matched.radius(0) <= matched.radius(1) { a } else { b }),
        (true, false) => Some(a),
        (false, true) => Some(b),
        (false, false) => None,
    }
}
