//! What a comparison found.

use serde::Serialize;

use super::layers::LayerAgreement;
use super::spread::{Share, Spread};
use crate::analysis::{Regime, Verdict};
use crate::system::named;

/// How well a candidate's map agrees with the reference's. Shares are of cells that begin in one of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Agreement {
    /// Cells of the plane.
    pub cells: u64,
    /// How many cells the reference puts in the regime of the row's code and the candidate in that of the column's.
    pub confusion: [[u64; Regime::ALL.len()]; Regime::ALL.len()],
    /// Regime and label, in cells whose eight neighbours agree with the cell in the reference.
    pub inside: Share,
    /// Regime and label, in the other cells.
    pub boundary: Share,
    /// Regime and label, in every cell that is not chaotic in the reference.
    pub non_chaotic: Share,
    /// Symmetric or not, in cells that are periodic with the same label in both.
    pub symmetry: Share,
    /// Every regime that the reference finds of what begins, in the order of the codes.
    pub regimes: Vec<RegimeAgreement>,
    /// Differences of the strobe states in cells that are periodic with the same label in both; non-dimensional.
    pub end_state: Option<Spread>,
    /// How many of these were compared by continuing the candidate's motion on the reference.
    pub continued: u64,
    /// Cells that differ and are on the edge: the reference decides them otherwise within a rounding error. They count
    /// in the shares above, and not in the checks.
    pub tipped: Tipped,
    /// Every layer of numbers; none under control.
    pub layers: Vec<LayerAgreement>,
    /// Cells that failed.
    pub failed: FailedCells,
    /// The worst cells, a few of each kind; not part of the serialised figures.
    #[serde(skip)]
    pub worst: Vec<WorstCell>,
}

/// Agreement in the cells that the reference puts in one regime.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RegimeAgreement {
    /// The regime's name.
    pub regime: &'static str,
    /// Regime and label inside regions.
    pub inside: Share,
    /// Regime and label on boundaries.
    pub boundary: Share,
    /// Differences of the strobe states, where both are periodic with the same label; non-dimensional.
    pub end_state: Option<Spread>,
    /// Differences of the largest Lyapunov exponent per forcing period, where regime and label agree.
    pub lyapunov: Option<Spread>,
}

/// How many of the cells that differ are on the edge.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tipped {
    /// All of them.
    pub cells: u64,
    /// Inside regions.
    pub inside: u64,
    /// Those that are not chaotic in the reference.
    pub non_chaotic: u64,
}

/// How many cells failed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct FailedCells {
    /// In the reference.
    pub reference: u64,
    /// In the candidate.
    pub candidate: u64,
}

named! {
    /// What is wrong with a cell, the gravest first.
    #[derive(strum::VariantArray)]
    pub enum Fault {
        /// A back end failed on it.
        Failed = "failed",
        /// Another regime or label, inside a region.
        LabelInside = "another label inside a region",
        /// The same periodic motion, but far apart.
        EndState = "another end state",
        /// Another regime or label, on a boundary.
        LabelOnBoundary = "another label on a boundary",
    }
}

/// One of the worst cells.
#[derive(Clone, Debug, PartialEq)]
pub struct WorstCell {
    /// Its column.
    pub column: u32,
    /// Its row.
    pub row: u32,
    /// What is wrong.
    pub fault: Fault,
    /// The reference's verdict.
    pub reference: Verdict,
    /// The candidate's verdict.
    pub candidate: Verdict,
    /// Where the two meet the motion: its strobe states, or under control its points on σ; non-dimensional.
    pub places: [Vec<f64>; 2],
    /// The difference of the strobe states where it counts; non-dimensional.
    pub difference: Option<f64>,
}
