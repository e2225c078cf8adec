//! A state just after an impact, and its forcing phase.

use std::f64::consts::TAU;

use nalgebra::DVector;

use crate::dynamics::Stop;

/// A state just after an impact, on the section at its stop: (v_c+, the other x, the other v, φ), 2n numbers, where c is
/// the contact's own coordinate and φ the forcing phase, not reduced. Non-dimensional; on the section at A of the paper's
/// oscillator it is the paper's X = (x1'+, x2, x2', τ). See [`section_names`](super::section_names).
pub type SectionVector = DVector<f64>;

/// The forcing phase of a section.
pub(crate) fn phase(section: &SectionVector) -> f64 {
    section[section.len() - 1]
}

/// An impact on a motion: where, and the state just after it.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The stop.
    pub stop: Stop,
    /// The state just after the impact.
    pub section: SectionVector,
}

/// A phase in [0, 2π).
pub(crate) fn wrapped(phase: f64) -> f64 {
    let phase = phase.rem_euclid(TAU);
    if phase < TAU { phase } else { 0.0 }
}
