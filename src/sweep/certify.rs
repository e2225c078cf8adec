//! Every periodic cell of a map, solved exactly.
//!
//! Newton's method begins at the cell's end state, and where that leads nowhere at the motions of the neighbours with the
//! same label. Label, symmetry, exponent and multipliers are those of the orbit found, which must be stable and must be
//! what the cell's trajectory approaches. What is not confirmed so is looked at for longer, and if that does not help it is
//! unresolved.

use std::collections::HashMap;

use rayon::prelude::*;

use super::Result;
use super::begun::Begun;
use super::map::window_jobs;
use super::preparing::jobs_of;
use crate::analysis::{Counts, Regime, Schedule, Verdict};
use crate::backend::{self, Backend, Job, Silent, Watch, decide, long_look};
use crate::plane::{Multipliers, Plane, RegionMap, Window};
use crate::theory::{StrobeMotion, approached, approached_from, with_motion};

/// How many cells of a map were certified.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
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
pub fn certify(map: &mut RegionMap, backend: &dyn Backend, watch: &dyn Watch) -> Result<Certification> {
    let whole = Window::whole(&map.plane);
    let (certified, counts) = certify_window(&map.plane, whole, &mut map.verdicts, backend, watch)?;
    map.multipliers = Some(certified);
    Ok(counts)
}

/// Certifies the verdicts on some cells of a plane in place, row by row; the multipliers of the orbits that were found.
///
/// A cell gets what it has on the whole plane: neighbours beyond the window are followed where one is needed.
///
/// # Errors
/// A system that cannot be used, or what the back end could not do.
pub fn certify_window(
    plane: &Plane,
    window: Window,
    verdicts: &mut [Verdict],
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<(Vec<Option<Multipliers>>, Certification)> {
    let (jobs, schedule) = (&window_jobs(plane, &[window])?[..], &plane.task);
    let before: Vec<Verdict> = verdicts.to_vec();
    let mut found: Vec<Option<Certified>> = (jobs.par_iter().zip(&before))
        .map(|(job, verdict)| {
            watch.finished(1);
            job.as_ref().ok().filter(|_| !watch.cancelled()).and_then(|job| by_itself(job, verdict))
        })
        .collect();
    watch.check()?;
    let by_neighbours: Vec<(usize, Certified)> = {
        let open = open(jobs, &before, &found);
        let around =
            Around { plane, window, found: &found, beyond: beyond(plane, window, &open, backend, watch)? };
        let certified =
            |cell: usize| Some((cell, by_neighbour(begun(jobs, cell), &before[cell], &around, cell)?));
        open.into_par_iter().filter_map(certified).collect()
    };
    for (cell, certified) in by_neighbours {
        found[cell] = Some(certified);
    }
    let left = open(jobs, &before, &found);
    let again = reexamined(&left, jobs, &before, schedule, backend, watch)?;
    for (&cell, verdict) in left.iter().zip(&again) {
        found[cell] = by_itself(begun(jobs, cell), verdict);
        let periodic = verdict.regime.is_periodic();
        verdicts[cell] = if periodic { unresolved(verdict) } else { *verdict };
    }
    for (verdict, certified) in verdicts.iter_mut().zip(&found) {
        *verdict = certified.as_ref().map_or(*verdict, |certified| certified.verdict);
    }
    let counts = counted(&before, verdicts, &found, left.len());
    Ok((found.into_iter().map(|cell| Some(cell?.multipliers)).collect(), counts))
}

/// The job of a cell that is open.
fn begun(jobs: &[Begun], cell: usize) -> &Job {
    jobs[cell].as_ref().expect("only what begins is open")
}

/// Periodic cells that are not certified.
fn open(jobs: &[Begun], verdicts: &[Verdict], found: &[Option<Certified>]) -> Vec<usize> {
    let is_open = |&i: &usize| jobs[i].is_ok() && verdicts[i].regime.is_periodic() && found[i].is_none();
    (0..verdicts.len()).filter(is_open).collect()
}

/// The orbit that the cell's own end state leads to.
fn by_itself(job: &Job, verdict: &Verdict) -> Option<Certified> {
    let n = u32::from(verdict.n);
    let motion = (verdict.regime.is_periodic()).then(|| approached(&job.system, verdict.state, n))??;
    certified(verdict, &motion)
}

/// The orbit that a neighbour's leads to, and that the cell's own state approaches.
fn by_neighbour(job: &Job, verdict: &Verdict, around: &Around<'_>, cell: usize) -> Option<Certified> {
    let places = neighbours(around.plane, around.window, cell);
    places.filter_map(|place| around.at(place)).find_map(|neighbour| {
        let n = u32::from(neighbour.verdict.n);
        let motion = approached_from(&job.system, &neighbour.verdict.state[..], &verdict.state[..], n)?;
        certified(verdict, &motion)
    })
}

/// The columns and rows of a cell of a window and of its neighbours on the plane, row by row.
fn neighbours(plane: &Plane, window: Window, cell: usize) -> impl Iterator<Item = (u32, u32)> + use<> {
    let columns = window.columns as usize;
    let (column, row) = (window.column + (cell % columns) as u32, window.row + (cell / columns) as u32);
    let around = |i: u32, count: u32| i.saturating_sub(1)..=(i + 1).min(count - 1);
    let (across, up) = (around(column, plane.x.count), around(row, plane.y.count));
    up.flat_map(move |r| across.clone().map(move |c| (c, r)))
}

/// What the cells of a window, and those around it, lead to by themselves.
struct Around<'a> {
    plane: &'a Plane,
    window: Window,
    found: &'a [Option<Certified>],
    beyond: HashMap<(u32, u32), Certified>,
}

impl Around<'_> {
    fn at(&self, place: (u32, u32)) -> Option<&Certified> {
        match self.window.contains(place) {
            true => self.found[self.window.index(place)].as_ref(),
            false => self.beyond.get(&place),
        }
    }
}

/// What the neighbours beyond a window of some of its cells lead to by themselves.
fn beyond(
    plane: &Plane,
    window: Window,
    cells: &[usize],
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<HashMap<(u32, u32), Certified>> {
    let mut places: Vec<(u32, u32)> = (cells.iter())
        .flat_map(|&cell| neighbours(plane, window, cell))
        .filter(|&place| !window.contains(place))
        .collect();
    places.sort_unstable();
    places.dedup();
    let whole = Window::whole(plane);
    let cells: Vec<u64> = places.iter().map(|&place| whole.index(place) as u64).collect();
    let (jobs, places): (Vec<Job>, Vec<(u32, u32)>) = jobs_of(plane, &cells)?
        .into_iter()
        .zip(places)
        .filter_map(|(job, place)| Some((job.ok()?, place)))
        .unzip();
    let verdicts = decide(backend, &jobs, &plane.task, &Silent(watch))?;
    let found = (jobs.par_iter().zip(&verdicts).zip(places))
        .filter_map(|((job, verdict), place)| Some((place, by_itself(job, verdict)?)));
    Ok(found.collect())
}

fn certified(verdict: &Verdict, motion: &StrobeMotion) -> Option<Certified> {
    let multipliers = motion.multipliers()?.iter().map(|value| [value.re, value.im]).collect();
    motion.has_impacts().then(|| Certified { verdict: with_motion(verdict, motion), multipliers })
}

/// Verdicts on the trajectories of some cells after a longer look, from where they ended.
fn reexamined(
    cells: &[usize],
    jobs: &[Begun],
    before: &[Verdict],
    schedule: &Schedule,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> backend::Result<Vec<Verdict>> {
    let longer = Schedule { fixed_periods: false, ..long_look(schedule) };
    let again: Vec<Job> = cells
        .iter()
        .map(|&cell| Job { system: begun(jobs, cell).system.clone(), start: before[cell].state })
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
