//! Periodic motions out of simulated orbits: the one a trajectory settled on, or one whose label it comes close to.

use super::flow::Section;
use super::label::Label;
use super::motion::{NoMotion, PeriodicMotion};
use super::pattern::Pattern;
use crate::dynamics::{Event, ImpactEvent, Stop, Trajectory, record};
use crate::model::{Flight, System};

/// The largest distance on the section over which an orbit returns closely, non-dimensional.
const CLOSE: f64 = 1.0;
/// Returns nearer to each other than this are one.
const APART: f64 = 1e-2;
/// Moves of an orbit, beyond twice what its steps and the impacts asked for take, after which it is searched no further.
const SPARE_MOVES: u64 = 1 << 19;
/// The most impacts of one orbit that are searched.
const MOST_SEARCHED: usize = 1 << 20;

/// How a motion is searched for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// (x1, x2, v1, v2) at forcing phase 0 of the orbit that is searched first.
    pub start: [f64; 4],
    /// Forcing periods of each orbit that are left out.
    pub transient: u32,
    /// Forcing periods of each orbit that are searched.
    pub observe: u32,
}

/// The motion that a trajectory has settled on, from its state at forcing phase 0, which returns after `n` periods.
///
/// # Errors
/// [`NoMotion`] if Newton's method leads nowhere from there; a motion with sticking has no finite impact sequence.
pub fn settled_motion(system: &System, state: [f64; 4], n: u32) -> Result<PeriodicMotion, NoMotion> {
    let recording = record(system, state, 0, n, 0);
    let solvable = 1..=Label::MOST_IMPACTS as usize;
    if !solvable.contains(&recording.impacts.len()) || !recording.sticks.is_empty() {
        return Err(NoMotion::NotConverged);
    }
    let (pattern, guess) = sequence(system, &recording.impacts, n);
    PeriodicMotion::refine(system, &pattern, &guess)
}

/// Searches one orbit, for the mirror image as well; the motion, and how many guesses were tried.
pub(super) fn among_returns(
    system: &System,
    label: Label,
    start: [f64; 4],
    search: &Search,
    tries: usize,
) -> (Option<PeriodicMotion>, usize) {
    let impacts = impacts(system, label, start, search);
    let (found, tried) = solved_among(system, label, &impacts, tries);
    if found.is_some() || label.p == label.q {
        return (found, tried);
    }
    let twin = Label { p: label.q, q: label.p, ..label };
    let (found, more) = solved_among(system, twin, &impacts, tries);
    (found.map(|motion| motion.mirror_image()), tried + more)
}

/// The motion of a label to which one of the close returns of an orbit leads, and how many were tried.
fn solved_among(
    system: &System,
    label: Label,
    impacts: &[ImpactEvent],
    tries: usize,
) -> (Option<PeriodicMotion>, usize) {
    let mut tried: Vec<Section> = Vec::new();
    for first in close_returns(system, impacts, label) {
        let count = (label.p + label.q) as usize;
        let (pattern, guess) = sequence(system, &impacts[first..first + count], label.n);
        if tried.iter().any(|other| (other - guess[0]).amax() < APART) {
            continue;
        }
        tried.push(guess[0]);
        if let Ok(motion) = PeriodicMotion::refine(system, &pattern, &guess)
            && motion.label() == label.to_string()
        {
            return (Some(motion), tried.len());
        }
        if tried.len() == tries {
            break;
        }
    }
    (None, tried.len())
}

/// The impacts of an orbit in the window that is searched, as far as it can be followed.
fn impacts(system: &System, label: Label, start: [f64; 4], search: &Search) -> Vec<ImpactEvent> {
    let flight = Flight::new(system);
    let usual = 2 * u64::from(flight.steps + label.p + label.q);
    let mut left = SPARE_MOVES;
    let mut trajectory = Trajectory::new(&flight, start);
    let mut found = Vec::new();
    for period in 0..search.transient.saturating_add(search.observe) {
        left += usual;
        loop {
            if left == 0 || found.len() >= MOST_SEARCHED {
                return found;
            }
            left -= 1;
            let taken = trajectory.advance(&flight, &mut ());
            let impact = match taken.event {
                Event::Strobe => break,
                Event::Impact(impact) => impact,
                Event::Caught { impact, .. } if impact.velocity_before != 0.0 => impact,
                _ => continue,
            };
            if period < search.transient {
                continue;
            }
            let elapsed = f64::from(trajectory.step) * flight.h + trajectory.offset;
            found.push(ImpactEvent {
                time: f64::from(period) * system.period() + elapsed,
                stop: impact.stop,
                velocity_before: impact.velocity_before,
                velocity_after: impact.velocity_after,
                x2: trajectory.point.x2,
                v2: trajectory.point.v2,
                phase: flight.omega * elapsed,
            });
        }
    }
    found
}

/// Where an orbit comes back to its section after N periods and the right impacts, closest first.
fn close_returns(system: &System, impacts: &[ImpactEvent], label: Label) -> Vec<usize> {
    let stop = if label.q > 0 { Stop::A } else { Stop::B };
    let count = (label.p + label.q) as usize;
    let turn = f64::from(label.n) * system.period();
    let mut returns: Vec<(f64, usize)> = impacts
        .windows(count + 1)
        .enumerate()
        .filter_map(|(first, window)| {
            let [from, .., to] = window else { return None };
            let at_a = window[..count].iter().filter(|impact| impact.stop == Stop::A).count();
            if count == 0 || from.stop != stop || to.stop != stop || at_a != label.q as usize {
                return None;
            }
            let late = system.parameters().omega * (to.time - from.time - turn);
            let away = (to.velocity_after - from.velocity_after).abs()
                + (to.x2 - from.x2).abs()
                + (to.v2 - from.v2).abs()
                + late.abs();
            (away < CLOSE).then_some((away, first))
        })
        .collect();
    returns.sort_by(|a, b| a.0.total_cmp(&b.0));
    returns.into_iter().map(|(_, first)| first).collect()
}

/// Impacts of an orbit as a guess of a motion that closes after `n` forcing periods.
fn sequence(system: &System, impacts: &[ImpactEvent], n: u32) -> (Pattern, Vec<Section>) {
    let pattern = Pattern {
        stops: impacts.iter().map(|impact| impact.stop).collect(),
        half_turns: 2 * n,
        mirrored: false,
    };
    let omega = system.parameters().omega;
    let first = &impacts[0];
    let sections = impacts
        .iter()
        .map(|i| Section::new(i.velocity_after, i.x2, i.v2, first.phase + omega * (i.time - first.time)))
        .collect();
    (pattern, sections)
}
