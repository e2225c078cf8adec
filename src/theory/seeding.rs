//! Periodic motions out of simulated orbits: the one a trajectory settled on, or any whose label it comes close to.

use thiserror::Error;

use super::flow::{PHASE, Section};
use super::label::Label;
use super::motion::{NoMotion, PeriodicMotion};
use super::pattern::Pattern;
use super::symmetric::stable_branch;
use crate::dynamics::{Event, ImpactEvent, Stop, Trajectory, record};
use crate::model::{Flight, Parameter, State, System};

/// Close returns of one orbit from which Newton's method is tried.
const TRIES: usize = 60;
/// The largest distance on the section over which an orbit returns closely, non-dimensional.
const CLOSE: f64 = 1.0;
/// Returns nearer to each other than this are one.
const APART: f64 = 1e-2;
/// Orbits from scattered starts that are searched as well.
const SCATTERED: u32 = 12;
/// Moves in one forcing period beyond which an orbit is not searched: all steps, and more impacts than a label has.
const MOST_MOVES: u32 = 1 << 18;
/// The most impacts of one orbit that are searched.
const MOST_SEARCHED: usize = 1 << 20;
/// Relative changes of ω at which a neighbouring motion is looked for, to be followed back.
const NEIGHBOURS: [f64; 10] = [0.005, -0.005, 0.015, -0.015, 0.04, -0.04, 0.08, -0.08, 0.15, -0.15];

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

/// No motion of a label was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error(
    "no {label} motion was found here: none of {tried} close returns of {orbits} orbits leads to one, and none \
     at neighbouring frequencies that could be followed back; try another --start, or parameters nearer to where \
     the motion is stable"
)]
pub struct NotFound {
    /// The label.
    pub label: Label,
    /// Guesses that Newton's method was started from.
    pub tried: usize,
    /// Orbits that were searched.
    pub orbits: usize,
}

/// The motion that a trajectory has settled on, from its state at forcing phase 0, which returns after `n` periods.
///
/// # Errors
/// [`NoMotion`] if Newton's method leads nowhere from there; a motion with sticking has no finite impact sequence.
pub fn settled_motion(system: &System, state: [f64; 4], n: u32) -> Result<PeriodicMotion, NoMotion> {
    let recording = record(system, state, 0, n, 0);
    if recording.impacts.is_empty() || !recording.sticks.is_empty() {
        return Err(NoMotion::NotConverged);
    }
    let (pattern, guess) = sequence(system, &recording.impacts, n);
    PeriodicMotion::refine(system, &pattern, &guess)
}

/// A motion with a label, stable or not: from close returns of simulated orbits, followed from a neighbouring ω, or (1-1-1,
/// symmetric) in closed form.
///
/// # Errors
/// [`NotFound`] if none of the searched orbits comes close to one.
pub fn labelled_motion(system: &System, label: Label, search: &Search) -> Result<PeriodicMotion, NotFound> {
    let mut tried = 0;
    let mut orbits = 0;
    let starts = std::iter::once(search.start).chain((0..SCATTERED).map(|i| scattered(system, i)));
    for start in starts {
        orbits += 1;
        let (found, guesses) = among_returns(system, label, start, search, TRIES);
        tried += guesses;
        if let Some(motion) = found {
            return Ok(motion);
        }
    }
    for change in NEIGHBOURS {
        let omega = system.parameters().omega * (1.0 + change);
        let Ok(beside) = System::new(system.parameters().with(Parameter::Omega, omega)) else { continue };
        orbits += 1;
        let (found, guesses) = among_returns(&beside, label, search.start, search, TRIES / 4);
        tried += guesses;
        if let Some(motion) = found.and_then(|motion| followed(&motion, &beside, system)) {
            return Ok(motion);
        }
    }
    // The symmetric 1-1-1 motion needs no guess.
    if label == (Label { n: 1, p: 1, q: 1 })
        && let Some(solution) = stable_branch(system)
    {
        return Ok(solution.motion);
    }
    Err(NotFound { label, tried, orbits })
}

/// A start between the stops, one of a sequence that fills the space evenly.
fn scattered(system: &System, index: u32) -> [f64; 4] {
    // The additive recurrence of the four-dimensional golden ratio.
    const RATIO: f64 = 1.167_303_978_261_418_7;
    let fraction = |k: i32| (0.5 + f64::from(index + 1) / RATIO.powi(k)).fract() * 2.0 - 1.0;
    let delta = system.parameters().delta;
    [delta * fraction(1), fraction(2), 2.0 * fraction(3), fraction(4)]
}

/// Searches one orbit; the motion, and how many guesses were tried.
fn among_returns(
    system: &System,
    label: Label,
    start: [f64; 4],
    search: &Search,
    tries: usize,
) -> (Option<PeriodicMotion>, usize) {
    let impacts = impacts(system, start, search);
    let mut tried: Vec<Section> = Vec::new();
    for first in close_returns(system, &impacts, label) {
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
fn impacts(system: &System, start: [f64; 4], search: &Search) -> Vec<ImpactEvent> {
    let flight = Flight::<f64, 2>::new(system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(&start));
    let mut found = Vec::new();
    for period in 0..search.transient.saturating_add(search.observe) {
        let mut moves = 0;
        loop {
            let taken = trajectory.advance(&flight, &mut ());
            moves += 1;
            if moves > MOST_MOVES || found.len() >= MOST_SEARCHED {
                return found;
            }
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
                x2: trajectory.point.state.x[1],
                v2: trajectory.point.state.v[1],
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

/// Follows a motion from one frequency to another in steps that adapt; none if it is lost on the way.
fn followed(motion: &PeriodicMotion, from: &System, to: &System) -> Option<PeriodicMotion> {
    let (first, last) = (from.parameters().omega, to.parameters().omega);
    let mut reached = 0.0;
    let mut step: f64 = 0.25;
    let mut current = motion.clone();
    while reached < 1.0 {
        let share = (reached + step).min(1.0);
        let omega = if share == 1.0 { last } else { first + share * (last - first) };
        let system = System::new(to.parameters().with(Parameter::Omega, omega)).ok()?;
        let near = PeriodicMotion::refine(&system, &current.pattern, &current.sections).ok().filter(|next| {
            next.pattern == current.pattern
                && (next.sections[0][PHASE] - current.sections[0][PHASE]).abs() < 0.3
        });
        match near {
            Some(next) => {
                (current, reached) = (next, share);
                step = (step * 1.5).min(0.25);
            }
            None if step > 1e-3 => step *= 0.5,
            None => return None,
        }
    }
    Some(current)
}
