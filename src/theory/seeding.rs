//! Periodic motions out of simulated orbits: the one a trajectory settled on, or one whose label it comes close to.

use super::flow::Flow;
use super::follower::follower;
use super::label::Label;
use super::motion::{NoMotion, PeriodicMotion};
use super::pattern::{Pattern, StopSet};
use super::section_vector::{SectionVector, extent, mechanical, phase, unit_about};
use crate::dynamics::{Event, Stop};
use crate::model::System;

/// The largest distance on the section over which an orbit returns closely: the sum of all differences, in units of what is of order
/// one.
const CLOSE: f64 = 1.0;
/// Returns nearer to each other than this are one; see [`extent`].
const APART: f64 = 1e-2;
/// Moves of an orbit, beyond twice what its steps and the impacts asked for take, after which it is searched no further.
const SPARE_MOVES: u64 = 1 << 19;
/// The most impacts of one orbit that are searched.
const MOST_SEARCHED: usize = 1 << 20;
/// How a motion is searched for.
#[derive(Clone, Debug, PartialEq)]
pub struct Search {
    /// (x, v) at forcing phase 0 of the orbit that is searched first.
    pub start: Vec<f64>,
    /// Forcing periods of each orbit that are left out.
    pub transient: u32,
    /// Forcing periods of each orbit that are searched.
    pub observe: u32,
}

/// The motion that a trajectory has settled on, from its (x, v) at forcing phase 0, which returns after `n` periods.
///
/// # Errors
/// [`NoMotion`] if Newton's method leads nowhere from there; a motion with sticking has no finite impact sequence.
///
/// # Panics
/// If the state has not 2n values.
pub fn settled_motion(system: &System, state: impl AsRef<[f64]>, n: u32) -> Result<PeriodicMotion, NoMotion> {
    let search = Search { start: state.as_ref().to_vec(), transient: 0, observe: n };
    let orbit = impacts(system, Label::MOST_IMPACTS, &search.start, &search);
    let solvable = 1..=Label::MOST_IMPACTS as usize;
    if !solvable.contains(&orbit.impacts.len()) || orbit.sticks || !orbit.complete {
        return Err(NoMotion::NotConverged);
    }
    let (pattern, guess) = sequence(system, &orbit.impacts, n);
    PeriodicMotion::refine(system, &pattern, &guess)
}

/// An impact of an orbit: when, where, and the section just after it, its phase in [0, 2π).
struct Met {
    time: f64,
    stop: Stop,
    section: SectionVector,
}

/// The impacts of an orbit in the window that is searched.
struct Orbit {
    impacts: Vec<Met>,
    /// Whether a mass rests on a stop in between.
    sticks: bool,
    /// Whether the window was followed to its end.
    complete: bool,
}

/// Searches one orbit, for the mirror image as well; the motion, and how many guesses were tried.
pub(super) fn among_returns(
    system: &System,
    label: &Label,
    start: &[f64],
    search: &Search,
    tries: usize,
) -> (Option<PeriodicMotion>, usize) {
    let impacts = impacts(system, label.count(), start, search).impacts;
    let (found, tried) = solved_among(system, label, &impacts, tries);
    let stops = StopSet::of(system);
    let counts = stops.in_plant_order(&label.impacts);
    let image = |stop: usize| stops.image(Stop(stop as u8)).index();
    let mirrored: Vec<u32> = (0..counts.len()).map(|stop| counts[image(stop)]).collect();
    if found.is_some() || mirrored == counts {
        return (found, tried);
    }
    let twin = Label::new(label.n, &stops.in_label_order(&mirrored));
    let (found, more) = solved_among(system, &twin, &impacts, tries);
    (found.and_then(|motion| motion.mirror_image(system)), tried + more)
}

/// The motion of a label to which one of the close returns of an orbit leads, and how many were tried.
fn solved_among(
    system: &System,
    label: &Label,
    impacts: &[Met],
    tries: usize,
) -> (Option<PeriodicMotion>, usize) {
    let unit = system.unit();
    let mut tried: Vec<SectionVector> = Vec::new();
    for first in close_returns(system, impacts, label) {
        let count = label.count() as usize;
        let (pattern, guess) = sequence(system, &impacts[first..first + count], label.n);
        let size = unit_about(unit, [&guess[0]]);
        if tried.iter().any(|other| extent(&(other - &guess[0]), size) < APART) {
            continue;
        }
        tried.push(guess[0].clone());
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
fn impacts(system: &System, in_a_turn: u32, start: &[f64], search: &Search) -> Orbit {
    let flow = Flow::new(system);
    let mut follower = follower(system);
    follower.begin(start);
    let sticks = !follower.contact().is_free();
    let mut orbit = Orbit { impacts: Vec::new(), sticks, complete: false };
    let usual = 2 * u64::from(system.steps() + in_a_turn);
    let mut left = SPARE_MOVES;
    for period in 0..search.transient.saturating_add(search.observe) {
        left += usual;
        loop {
            if left == 0 || orbit.impacts.len() >= MOST_SEARCHED {
                return orbit;
            }
            left -= 1;
            let taken = follower.advance();
            let impact = match taken.event {
                Event::Strobe => break,
                Event::Impact(impact) => impact,
                Event::Caught { impact, .. } => {
                    orbit.sticks = true;
                    if impact.velocity_before == 0.0 {
                        continue;
                    }
                    impact
                }
                _ => continue,
            };
            if period < search.transient {
                continue;
            }
            let phase = follower.phase(flow.omega);
            orbit.impacts.push(Met {
                time: f64::from(period) * system.period() + follower.elapsed(),
                stop: impact.stop,
                section: flow.face(impact.stop).section(follower.x(), follower.v(), phase),
            });
        }
    }
    orbit.complete = true;
    orbit
}

/// Where an orbit comes back to its section after N periods and the right impacts, closest first.
fn close_returns(system: &System, impacts: &[Met], label: &Label) -> Vec<usize> {
    let wanted = StopSet::of(system).in_plant_order(&label.impacts);
    let Some(stop) = wanted.iter().position(|&count| count > 0) else { return Vec::new() };
    let count = label.count() as usize;
    let (turn, unit) = (f64::from(label.n) * system.period(), system.unit());
    let mut returns: Vec<(f64, usize)> = impacts
        .windows(count + 1)
        .enumerate()
        .filter_map(|(first, window)| {
            let [from, .., to] = window else { return None };
            if from.stop.index() != stop || to.stop.index() != stop {
                return None;
            }
            let at = |stop: usize| window[..count].iter().filter(|met| met.stop.index() == stop).count();
            if wanted.iter().enumerate().any(|(stop, &count)| at(stop) != count as usize) {
                return None;
            }
            let late = system.plant().omega * (to.time - from.time - turn);
            let change = &to.section - &from.section;
            let size = unit_about(unit, [&from.section, &to.section]);
            let away = mechanical(&change).abs().sum() / size + late.abs();
            (away < CLOSE).then_some((away, first))
        })
        .collect();
    returns.sort_by(|a, b| a.0.total_cmp(&b.0));
    returns.into_iter().map(|(_, first)| first).collect()
}

/// Impacts of an orbit as a guess of a motion that closes after `n` forcing periods.
fn sequence(system: &System, impacts: &[Met], n: u32) -> (Pattern, Vec<SectionVector>) {
    let stops = impacts.iter().map(|met| met.stop).collect();
    let pattern = Pattern::new(system, stops, 2 * n, false);
    let omega = system.plant().omega;
    let first = &impacts[0];
    let section = |met: &Met| {
        let mut section = met.section.clone();
        let last = section.len() - 1;
        section[last] = phase(&first.section) + omega * (met.time - first.time);
        section
    };
    (pattern, impacts.iter().map(section).collect())
}
