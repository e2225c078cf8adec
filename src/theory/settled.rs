//! The periodic motion that a trajectory has settled on, with or without sticking.

use nalgebra::Complex;

use super::label::Label;
use super::motion::{NoMotion, PeriodicMotion};
use super::seeding::settled_motion;
use super::strobe::StrobeMotion;
use crate::analysis::{Regime, Verdict};
use crate::model::System;

/// A periodic motion, solved in the way that its impacts allow.
#[derive(Clone, Debug, PartialEq)]
pub enum SettledMotion {
    /// Finitely many impacts: the matching equations.
    Impacts(PeriodicMotion),
    /// Sticking, or too many impacts: a fixed point of the strobe map.
    Strobe(Box<StrobeMotion>),
}

impl SettledMotion {
    /// The exact motion near the end of a trajectory whose verdict is periodic.
    ///
    /// A motion that has just doubled its period returns so closely after half of it that the verdict can have half
    /// its N: where the motion of that N is unstable, a stable one of twice the length is preferred.
    ///
    /// # Errors
    /// [`NoMotion`] if the verdict is not periodic, or Newton's method leads nowhere from it.
    pub fn of(system: &System, verdict: &Verdict) -> Result<Self, NoMotion> {
        let n = u32::from(verdict.n);
        if !verdict.regime.is_periodic() || n == 0 {
            return Err(NoMotion::NotConverged);
        }
        let finite = verdict.regime == Regime::Periodic
            && verdict.counts.iter().map(|&count| u32::from(count)).sum::<u32>() <= Label::MOST_IMPACTS;
        Self::near(system, &verdict.state[..], n, finite)
    }

    /// The exact motion near (x, v) at forcing phase 0, where a trajectory returns after `n` forcing periods; `finite`
    /// where it has finitely many impacts, and does not stick.
    ///
    /// Of one that is unstable, a stable one of twice the length is preferred.
    ///
    /// # Errors
    /// [`NoMotion`] if Newton's method leads nowhere from there.
    pub fn near(system: &System, state: &[f64], n: u32, finite: bool) -> Result<Self, NoMotion> {
        let solved = |n: u32| {
            let impacts = if finite {
                settled_motion(system, state, n).map(SettledMotion::Impacts)
            } else {
                Err(NoMotion::NotConverged)
            };
            impacts.or_else(|error| {
                let strobe = StrobeMotion::refine(system, state, n)
                    .map(|motion| SettledMotion::Strobe(Box::new(motion)));
                strobe.map_err(|_| error)
            })
        };
        let motion = solved(n);
        let is_stable = |motion: &Self| motion.is_stable(system) == Some(true);
        if motion.as_ref().is_ok_and(is_stable) {
            return motion;
        }
        solved(2 * n).ok().filter(is_stable).map_or(motion, Ok)
    }

    /// N-p-q, with ∞ for infinitely many impacts.
    pub fn label(&self) -> String {
        match self {
            SettledMotion::Impacts(motion) => motion.label(),
            SettledMotion::Strobe(motion) => motion.label(),
        }
    }

    /// (x, v) at forcing phase 0; non-dimensional.
    pub fn at_phase_zero(&self, system: &System) -> Vec<f64> {
        match self {
            SettledMotion::Impacts(motion) => motion.at_phase_zero(system),
            SettledMotion::Strobe(motion) => motion.state.clone(),
        }
    }

    /// The Floquet multipliers, largest modulus first; none for a motion that grazes.
    pub fn multipliers(&self, system: &System) -> Option<Vec<Complex<f64>>> {
        match self {
            SettledMotion::Impacts(motion) => motion.multipliers(system),
            SettledMotion::Strobe(motion) => motion.multipliers(),
        }
    }

    /// Whether all Floquet multipliers lie within the unit circle; none where there are none.
    pub fn is_stable(&self, system: &System) -> Option<bool> {
        match self {
            SettledMotion::Impacts(motion) => motion.is_stable(system),
            SettledMotion::Strobe(motion) => motion.is_stable(),
        }
    }
}
