//! Cells whose verdict on the reference itself changes within a rounding error.

use std::collections::BTreeSet;

use super::agreement::{Agreement, Tipped};
use super::alike::{is_inside, same_label};
use crate::analysis::{Regime, Verdict};
use crate::backend::{Backend, Job, Silent, Watch, decide};
use crate::model::System;
use crate::plane::RegionMap;
use crate::sweep::SweepError;

/// Changed copies of a cell.
const COPIES: u32 = 16;

/// By how much a copy is changed, relative to values above one: the rounding of single precision, and what has come
/// together of it after some operations.
const ROUNDING: f64 = 16.0 * f32::EPSILON as f64;

/// The fewest cells that are examined if so many differ.
const FEWEST: usize = 1000;

/// One cell of so many is examined at most, so that it costs no more than the reference's map did.
const ONE_OF: usize = 16;

/// The indices of cells in which the maps differ and which the reference decides otherwise as soon as the start and the
/// parameters are changed by a rounding error.
///
/// A candidate that differs in more cells than can be examined is wrong in most of them, and they count.
///
/// # Errors
/// What the back end could not do.
///
/// # Panics
/// If the maps are not of the same plane.
pub fn tipped(
    reference: &RegionMap,
    candidate: &RegionMap,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<BTreeSet<usize>, SweepError> {
    assert_eq!(reference.plane, candidate.plane, "only maps of the same plane can be compared");
    let pairs = reference.verdicts.iter().zip(&candidate.verdicts).enumerate();
    // What does not begin is decided by no rounding of a motion.
    let differs = |ours: &Verdict, theirs| ours.regime != Regime::Inadmissible && !same_label(ours, theirs);
    let differing = pairs.filter(|(_, (ours, theirs))| differs(ours, theirs)).map(|(index, _)| index);
    let most = FEWEST.max(reference.verdicts.len() / ONE_OF);
    let examined: Vec<usize> = differing.take(most).collect();
    let (of_cells, jobs): (Vec<usize>, Vec<Job>) =
        examined.into_iter().flat_map(|index| copies(reference, index).map(move |job| (index, job))).unzip();
    let verdicts = decide(backend, &jobs, &reference.plane.task, &Silent(watch))?;
    let moved = |(index, verdict): &(usize, Verdict)| !same_label(verdict, &reference.verdicts[*index]);
    Ok(of_cells.into_iter().zip(verdicts).filter(moved).map(|(index, _)| index).collect())
}

/// The cell with its start and parameters changed by a rounding error, each time with other signs.
fn copies(map: &RegionMap, index: usize) -> impl Iterator<Item = Job> + '_ {
    let columns = map.plane.x.count as usize;
    let (column, row) = ((index % columns) as u32, (index / columns) as u32);
    let parameters = map.plane.parameters_at(column, row);
    let count = parameters.entries().count() as u32;
    (0..COPIES).filter_map(move |copy| {
        // Signs as a hash of the copy and of what is changed.
        let change = |which: u32| {
            let mixed = (copy * 40 + which + 1).wrapping_mul(0x9e37_79b9);
            if (mixed >> 15) & 1 == 0 { ROUNDING } else { -ROUNDING }
        };
        let changed = |value: f64, which: u32| value + change(which) * value.abs();
        let varied =
            (parameters.entries().zip(0..)).fold(parameters, |varied, ((parameter, value), which)| {
                let value = changed(value, which);
                if parameter.check(value).is_ok() { varied.with(parameter, value) } else { varied }
            });
        let system = System::new(varied).ok()?;
        let narrowest = system.plant().stops.iter().map(|stop| stop.gap.abs()).fold(1.0, f64::min);
        let mut start = map.plane.start_at(column, row).state(&system);
        for (which, value) in (count..).zip(start.iter_mut()) {
            *value += change(which) * value.abs().max(narrowest);
        }
        let start = system.between_stops(start);
        Some(Job { system, start })
    })
}

impl Agreement {
    /// The same agreement with the cells counted that are on the edge, see [`tipped`].
    #[must_use]
    pub fn leaving_out(self, reference: &RegionMap, tipped: &BTreeSet<usize>) -> Self {
        let count =
            |wanted: &dyn Fn(usize) -> bool| tipped.iter().filter(|&&index| wanted(index)).count() as u64;
        let tipped = Tipped {
            cells: tipped.len() as u64,
            inside: count(&|index| is_inside(reference, index)),
            non_chaotic: count(&|index| reference.verdicts[index].regime != Regime::Chaotic),
        };
        Agreement { tipped, ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::backend::{Cpu, Unwatched};
    use crate::model::Parameters;
    use crate::plane::{Plane, Start};
    use crate::sweep::sweep;

    #[test]
    fn copies_are_a_rounding_away_and_what_is_zero_stays_zero() {
        let schedule = Schedule { transient: 1, observe: 1, max_period: 1, fixed_periods: true };
        let plane = Plane::of_paper("omega=2:3:2", "f20=0:0.5:2", Start::Rest, schedule).unwrap();
        let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
        let copies: Vec<Job> = copies(&map, 0).collect();
        assert_eq!(copies.len(), COPIES as usize);
        for Job { system, .. } in &copies {
            let Parameters { omega, delta, f20, .. } = system.parameters();
            // A zero is exact in every precision; a rounding of the smallest number would be a scale of its own.
            assert_eq!(f20, 0.0);
            for (value, exact) in [(omega, 2.0), (delta, Parameters::default().delta)] {
                let off = (value / exact - 1.0).abs();
                assert!(0.0 < off && off < 2.0 * ROUNDING, "{value}");
            }
        }
    }
}
