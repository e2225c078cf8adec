//! Two maps of the same plane, compared: whether a back end finds what the reference finds.
//!
//! Two cells *agree* when regime and N-p-q are equal. Agreement is counted apart *inside regions* (cells whose eight
//! neighbours have the cell's regime and label in the reference) and *on boundaries* (the rest), where a rounding
//! error may tip a cell over. In chaos neighbouring trajectories part, so the count of all cells leaves out those
//! that are chaotic in the reference.
//!
//! # End states
//! Where both maps hold the same periodic motion, the strobe states are compared: the largest difference of a component, in
//! units of what is of order one ([`System::unit`](crate::model::System::unit)). Two right answers can differ there, since an
//! unsymmetric motion has a mirrored twin and a motion of N > 1 periods can be met at N phases. Such cells, [`strays`], are
//! not taken out of the figures: with [`continue_strays`] the reference goes on from the *candidate's* end state for a whole
//! number of periods of the motion, and how far it moves is the cell's difference. A stray that was not continued, or that
//! did not stay on a motion with the label, counts with its whole difference.
//!
//! # Cells on the edge
//! On a boundary, and where chaos leaves the choice among motions to chance, a rounding error may decide a cell, and
//! the coarser a plane the more of its cells lie there. [`tipped`] asks the reference itself: where it decides a cell
//! otherwise once start and parameters are changed by about a rounding error of single precision, the cell is left out
//! of what the thresholds are held to. A candidate that is wrong differs in cells that the reference is sure of.
//!
//! # Bit for bit
//! Maps computed with exact arithmetic are to be the same altogether: [`differing`] lists the cells in which they are not.
//!
//! # Under control
//! [`compare`] holds two maps under control to the same: the motions reached, and their points on σ. Nothing is continued:
//! mirrored twins count with their whole difference.
//!
//! # Boundaries
//! Theory and simulation are compared too: [`boundaries`] measures how many cells lie between bifurcation curves and the
//! boundaries of the regions that a map shows.

mod agreement;
mod alike;
mod bits;
mod boundaries;
mod comparable;
mod compare;
mod continuation;
mod layers;
mod spread;
mod thresholds;
mod tipped;

pub use agreement::{Agreement, FailedCells, Fault, RegimeAgreement, Tipped, WorstCell};
pub use bits::{are_same, differing};
pub use boundaries::{Boundaries, BoundaryAgreement, boundaries};
pub use comparable::Comparable;
pub use compare::{compare, compare_continued};
pub use continuation::{Continued, continue_strays, strays};
pub use layers::LayerAgreement;
pub use spread::{Share, Spread};
pub use thresholds::{Check, Thresholds};
pub use tipped::tipped;

#[cfg(test)]
mod tests;
