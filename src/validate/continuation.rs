//! Motions that both maps hold, but on another branch or phase.

use std::collections::BTreeMap;

use super::alike::{Units, same_motion, state_difference};
use crate::analysis::{Schedule, Verdict};
use crate::backend::{Backend, Job, Watch};
use crate::model::System;
use crate::plane::RegionMap;
use crate::sweep::SweepError;

/// Above this difference of the strobe states, in units of what is of order one, two motions of the same label are taken to be
/// another branch or phase; an error of single precision is far smaller, and what is taken so wrongly still counts.
const ANOTHER_BRANCH: f64 = 1e-3;

/// How many forcing periods the reference goes on at least.
const PERIODS: u32 = 256;

/// How many periods of the motion it goes on at least.
const RETURNS: u32 = 8;

/// Differences of the strobe states found by continuing on the reference, by cell, in units of what is of order one.
pub type Continued = BTreeMap<usize, f64>;

/// The cells with the same periodic motion by label whose strobe states are far apart although both may be right.
///
/// A symmetric motion of one forcing period has neither a twin nor another phase: far apart, one of them is wrong.
pub fn strays(reference: &RegionMap, candidate: &RegionMap) -> Vec<usize> {
    let units = Units::of(reference);
    let pairs = reference.verdicts.iter().zip(&candidate.verdicts);
    pairs
        .enumerate()
        .filter(|(index, (a, b))| is_stray(a, b, || units.at(*index)))
        .map(|(index, _)| index)
        .collect()
}

fn is_stray(reference: &Verdict, candidate: &Verdict, unit: impl Fn() -> f64) -> bool {
    let finite = candidate.state.iter().all(|value| value.is_finite());
    let unique = reference.n == 1 && reference.symmetric && candidate.symmetric;
    same_motion(reference, candidate)
        && finite
        && !unique
        && state_difference(&reference.state, &candidate.state, unit()) > ANOTHER_BRANCH
}

/// Goes on from the candidate's end state of every stray, on the reference's back end, for whole periods of its motion.
///
/// The result has no entry for strays that did not stay on a motion of that label: they are not right.
///
/// # Errors
/// What the back end could not do.
pub fn continue_strays(
    reference: &RegionMap,
    candidate: &RegionMap,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Continued, SweepError> {
    let mut by_period: BTreeMap<u16, Vec<usize>> = BTreeMap::new();
    for index in strays(reference, candidate) {
        by_period.entry(candidate.verdicts[index].n).or_default().push(index);
    }
    let (mut continued, units) = (Continued::new(), Units::of(candidate));
    for (n, cells) in by_period {
        let schedule = whole_periods(u32::from(n), reference.plane.task.max_period);
        for tile in cells.chunks(backend.tile().max(1)) {
            let jobs = tile.iter().map(|&index| job(candidate, index)).collect::<Result<Vec<_>, _>>()?;
            for (&index, end) in tile.iter().zip(backend.run(&jobs, &schedule, watch)?) {
                let theirs = &candidate.verdicts[index];
                if same_motion(&end, theirs) {
                    let away = state_difference(&end.state, &theirs.state, units.at(index));
                    continued.insert(index, away);
                }
            }
        }
    }
    Ok(continued)
}

/// A schedule that ends on the phase of the motion on which it began.
fn whole_periods(n: u32, max_period: u32) -> Schedule {
    Schedule { transient: 0, observe: PERIODS.div_ceil(n).max(RETURNS) * n, max_period, fixed_periods: true }
}

fn job(map: &RegionMap, index: usize) -> Result<Job, SweepError> {
    let (column, row) = (index as u32 % map.plane.x.count, index as u32 / map.plane.x.count);
    let system = System::new(map.plane.parameters_at(column, row))?;
    let start = system.between_stops(map.verdicts[index].state);
    Ok(Job { system, start })
}
