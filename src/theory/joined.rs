//! How the section just after one impact follows from that after the one before, whatever gap and phase: its linear parts.

use nalgebra::DMatrix;

use super::face::Face;

/// Flight over some time from one stop to another, and the impact there; of sections, the last component stands for d·x.
#[derive(Clone, Debug)]
pub(crate) struct Joined {
    /// The section from z at departure; 2n × (2n + 3).
    pub section: DMatrix<f64>,
    /// How it changes with the section at departure, without forcing; 2n × 2n.
    pub lifted: DMatrix<f64>,
}

impl Joined {
    /// With `over` what flight makes of z.
    pub fn new(over: &DMatrix<f64>, [from, to]: [&Face; 2]) -> Self {
        let section = &to.restituted * over;
        let lifted = &section * &from.lift;
        Joined { section, lifted }
    }
}
