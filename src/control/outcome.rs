//! What became of a controlled trajectory.

use serde::{Deserialize, Serialize};

use crate::analysis::Verdict;

/// The convergence time of a motion that did not converge.
pub const NEVER: u32 = u32::MAX;

/// What became of one controlled trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The motion reached. Its `state` is the point (v1+, x2, v2, τ) on σ, that of the hardest impact at A where a
    /// period has several; N counts flight time in forcing periods, rounded, since a correction may jump in phase.
    pub verdict: Verdict,
    /// Iterates in one period of the motion, 0 where it has none.
    pub period: u32,
    /// Iterates followed.
    pub iterates: u32,
    /// Iterates from switching control on until the points kept returning, or [`NEVER`].
    pub converged_at: u32,
    /// The control signal at the end: B, or the length of the correction; non-dimensional.
    pub signal: f32,
    /// Whether control drove the points on σ beyond all bounds (1000 static deflections), where the run ended.
    pub runaway: bool,
    /// Corrections left out because they led off the section, v1+ > 0.
    pub escapes: u32,
    /// Mean length of the corrections made, or mean |B| of a force, per controlled iterate; non-dimensional.
    pub effort: f32,
}
