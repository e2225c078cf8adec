//! Every periodic cell of a map, solved exactly.
//!
//! Newton's method begins at the cell's end state, and where that leads nowhere at the motions of the neighbours with the
//! same label. Label, symmetry, exponent and multipliers are those of the orbit found, which must be stable and must be
//! what the cell's trajectory approaches. What is not confirmed so is looked at for longer, and if that does not help it is
//! unresolved.

use rayon::prelude::*;

use super::SweepError;
use super::map::cell_job;
use crate::analysis::{Counts, Regime, Schedule, Verdict};
use crate::backend::{Backend, BackendError, Job, Watch, decide, second_look};
use crate::plane::{Multipliers, RegionMap};
use crate::theory::{StrobeMotion, approached, approached_from, with_motion};

/// How many cells of a map were certified.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certification {
    /// Periodic cells before.
    pub periodic: u64,
    /// Cells whose label an exact and stable orbit confirms.
    pub confirmed: u64,
    /// Cells that got the label of the orbit in place of another.
    pub relabelled: u64,
    /// Cells that had to be looked at for longer, which are counted above or below as well where they are periodic.
    pub reexamined: u64,
    /// Cells that no orbit confirms: they are unresolved now.
    pub unresolved: u64,
}

/// A certified cell.
#[derive(Clone, Debug, PartialEq)]
struct Certified {
    verdict: Verdict,
    multipliers: Multipliers,
}

/// Certifies a map in place.
///
/// # Errors
/// A system that cannot be used, or what the back end could not do.
pub fn certify(
    map: &mut RegionMap,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Certification, SweepError> {
    let columns = map.plane.x.count as usize;
    let jobs: Vec<Job> =
        (0..map.plane.cells()).map(|cell| cell_job(&map.plane, cell)).collect::<Result<_, _>>()?;
    let (certified, counts) =
        certify_cells(&jobs, columns, &mut map.verdicts, &map.plane.schedule, backend, watch)?;
    map.multipliers = Some(certified);
    Ok(counts)
}

/// Certifies the verdicts on some jobs, in rows of so many, in place; the multipliers of the orbits that were found.
///
/// # Errors
/// What the back end could not do.
pub fn certify_cells(
    jobs: &[Job],
    columns: usize,
    verdicts: &mut [Verdict],
    schedule: &Schedule,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<(Vec<Option<Multipliers>>, Certification), BackendError> {
    let before: Vec<Verdict> = verdicts.to_vec();
    let mut found: Vec<Option<Certified>> = (jobs.par_iter().zip(&before))
        .map(|(job, verdict)| {
            watch.finished(1);
            (!watch.cancelled()).then(|| by_itself(job, verdict)).flatten()
        })
        .collect();
    if watch.cancelled() {
        return Err(BackendError::Cancelled);
    }
    let by_neighbours: Vec<(usize, Certified)> = open(&before, &found)
        .into_par_iter()
        .filter_map(|cell| Some((cell, by_neighbour(jobs, columns, &before, &found, cell)?)))
        .collect();
    for (cell, certified) in by_neighbours {
        found[cell] = Some(certified);
    }
    let left = open(&before, &found);
    let again = reexamined(&left, jobs, &before, schedule, backend, watch)?;
    for (&cell, verdict) in left.iter().zip(&again) {
        found[cell] = by_itself(&jobs[cell], verdict);
        let periodic = verdict.regime.is_periodic();
        verdicts[cell] = if periodic { unresolved(verdict) } else { *verdict };
    }
    for (verdict, certified) in verdicts.iter_mut().zip(&found) {
        *verdict = certified.as_ref().map_or(*verdict, |certified| certified.verdict);
    }
    let counts = counted(&before, verdicts, &found, left.len());
    Ok((found.into_iter().map(|cell| Some(cell?.multipliers)).collect(), counts))
}

/// Periodic cells that are not certified.
fn open(verdicts: &[Verdict], found: &[Option<Certified>]) -> Vec<usize> {
    (0..verdicts.len()).filter(|&i| verdicts[i].regime.is_periodic() && found[i].is_none()).collect()
}

/// The orbit that the cell's own end state leads to.
fn by_itself(job: &Job, verdict: &Verdict) -> Option<Certified> {
    let n = u32::from(verdict.n);
    let motion = (verdict.regime.is_periodic()).then(|| approached(&job.system, verdict.state, n))??;
    certified(verdict, &motion)
}

/// The orbit that a neighbour's leads to, and that the cell's own state approaches.
fn by_neighbour(
    jobs: &[Job],
    columns: usize,
    verdicts: &[Verdict],
    found: &[Option<Certified>],
    cell: usize,
) -> Option<Certified> {
    let verdict = &verdicts[cell];
    let (column, row) = (cell % columns, cell / columns);
    let around = |i: usize| i.saturating_sub(1)..=i + 1;
    let cells = around(row).flat_map(|r| around(column).map(move |c| (c, r)));
    let neighbours = cells.filter(|&(c, r)| c < columns && r * columns + c < found.len());
    neighbours.filter_map(|(c, r)| found[r * columns + c].as_ref()).find_map(|neighbour| {
        let n = u32::from(neighbour.verdict.n);
        let system = &jobs[cell].system;
        let motion = approached_from(system, &neighbour.verdict.state[..], &verdict.state[..], n)?;
        certified(verdict, &motion)
    })
}

fn certified(verdict: &Verdict, motion: &StrobeMotion) -> Option<Certified> {
    let multipliers = motion.multipliers()?.iter().map(|value| [value.re, value.im]).collect();
    motion.has_impacts().then(|| Certified { verdict: with_motion(verdict, motion), multipliers })
}

/// Verdicts on the trajectories of some cells after a longer look, from where they ended.
fn reexamined(
    cells: &[usize],
    jobs: &[Job],
    before: &[Verdict],
    schedule: &Schedule,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Verdict>, BackendError> {
    let longer = Schedule { fixed_periods: false, ..second_look(schedule) };
    let again: Vec<Job> = cells
        .iter()
        .map(|&cell| Job { system: jobs[cell].system.clone(), start: before[cell].state })
        .collect();
    let mut verdicts = decide(backend, &again, &longer, watch)?;
    for (verdict, &cell) in verdicts.iter_mut().zip(cells) {
        *verdict = verdict.going_on_from(&before[cell]);
    }
    Ok(verdicts)
}

/// The same trajectory without a motion that it is known to be on.
fn unresolved(verdict: &Verdict) -> Verdict {
    Verdict { regime: Regime::Unresolved, n: 0, counts: Counts::default(), symmetric: false, ..*verdict }
}

fn counted(
    before: &[Verdict],
    after: &[Verdict],
    found: &[Option<Certified>],
    reexamined: usize,
) -> Certification {
    let label = |v: &Verdict| (v.regime, v.n, v.counts, v.symmetric);
    let mut counts = Certification { reexamined: reexamined as u64, ..Certification::default() };
    for ((before, after), found) in before.iter().zip(after).zip(found) {
        if before.regime.is_periodic() {
            counts.periodic += 1;
            match found {
                Some(_) if label(before) == label(after) => counts.confirmed += 1,
                Some(_) => counts.relabelled += 1,
                None if after.regime == Regime::Unresolved => counts.unresolved += 1,
                None => {}
            }
        }
    }
    counts
}
