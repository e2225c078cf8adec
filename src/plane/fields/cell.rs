//! What is known of one cell.

use crate::analysis::{Extent, Verdict};
use crate::plane::region_map::Multipliers;
use crate::plane::task::Reached;

/// The results of one cell.
#[derive(Clone, Copy, Debug)]
pub struct CellResult<'a> {
    /// What became of its trajectory.
    pub verdict: &'a Verdict,
    /// Where its motion is met: see [`Reached::place`].
    pub place: &'a [f64],
    /// The multipliers of its exact orbit; none where none was certified.
    pub multipliers: Option<&'a Multipliers>,
    /// How far its motion goes; none where that was not measured.
    pub extent: Option<&'a Extent>,
}

impl<'a> CellResult<'a> {
    /// Cell `i` of some results, with what there is beyond verdicts.
    pub fn of(
        i: usize,
        cells: &'a [impl Reached],
        multipliers: Option<&'a [Option<Multipliers>]>,
        extents: Option<&'a [Extent]>,
    ) -> Self {
        CellResult {
            verdict: cells[i].verdict(),
            place: cells[i].place(),
            multipliers: multipliers.and_then(|all| all[i].as_ref()),
            extent: extents.map(|all| &all[i]),
        }
    }
}
