//! A periodic motion with a label, searched for here and at neighbouring parameters.

use std::f64::consts::TAU;

use rayon::prelude::*;
use thiserror::Error;

use super::flow::Flow;
use super::follower::follower;
use super::label::Label;
use super::motion::PeriodicMotion;
use super::section_vector::phase;
use super::seeding::{Search, among_returns, settled_motion};
use super::symmetric::{stable_branch, symmetric_start};
use crate::model::{Parameter, Setting, System};
use crate::system::Plant;

/// Close returns of one orbit from which Newton's method is tried.
const TRIES: usize = 60;
/// Orbits from scattered starts that are searched as well.
const SCATTERED: u32 = 12;
/// Relative changes of ω and δ at which a neighbouring motion is looked for, to be followed back, in so many directions.
const REACHES: [f64; 7] = [0.003, 0.01, 0.025, 0.05, 0.1, 0.17, 0.25];
const DIRECTIONS: u32 = 12;
/// Orbits from scattered starts that are searched at each neighbour.
const SCATTERED_BESIDE: u32 = 3;

/// No motion of a label was found.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "no {label} motion was found here: none of {tried} close returns of {orbits} orbits leads to one, and none \
     at neighbouring frequencies and clearances that could be followed back; try another --start, or parameters nearer to where \
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

/// A motion with a label, stable or not: the one that the start lies on; from close returns of simulated orbits, of its
/// mirror image too; followed from neighbouring ω and δ; or (1-1-1, symmetric) in closed form.
///
/// # Errors
/// [`NotFound`] if none of the searched orbits comes close to one.
pub fn labelled_motion(system: &System, label: Label, search: &Search) -> Result<PeriodicMotion, NotFound> {
    if label.impacts.len() != system.plant().stops.len() {
        return Err(NotFound { label, tried: 0, orbits: 0 });
    }
    let own = settled_motion(system, &search.start, label.n).ok();
    if let Some(motion) = own.filter(|motion| motion.label() == label.to_string()) {
        return Ok(motion);
    }
    let mut tried = 0;
    let mut orbits = 0;
    for start in starts(system, search, SCATTERED) {
        orbits += 1;
        let (found, guesses) = among_returns(system, &label, &start, search, TRIES);
        tried += guesses;
        if let Some(motion) = found {
            return Ok(motion);
        }
    }
    for reach in REACHES {
        // All directions at once; the first of them that leads here is taken.
        let searched: Vec<Beside> = (0..DIRECTIONS)
            .into_par_iter()
            .filter_map(|direction| {
                Some(beside(&neighbour(system, reach, direction)?, system, &label, search))
            })
            .collect();
        orbits += searched.iter().map(|beside| beside.orbits).sum::<usize>();
        tried += searched.iter().map(|beside| beside.tried).sum::<usize>();
        if let Some(motion) = searched.into_iter().find_map(|beside| beside.motion) {
            return Ok(motion);
        }
    }
    // The symmetric 1-1-1 motion needs no guess.
    match stable_branch(system) {
        Some(solution) if solution.motion.label() == label.to_string() => Ok(solution.motion),
        _ => Err(NotFound { label, tried, orbits }),
    }
}

/// What the search at a neighbour has come to.
struct Beside {
    motion: Option<PeriodicMotion>,
    tried: usize,
    orbits: usize,
}

/// The system a relative change of ω and δ away, in one of the directions; of a plant without parameters ω alone changes.
fn neighbour(system: &System, reach: f64, direction: u32) -> Option<System> {
    let (sin, cos) = libm::sincos(TAU * f64::from(direction) / f64::from(DIRECTIONS));
    let Some(setting) = system.setting() else {
        let plant = Plant { omega: system.plant().omega * (1.0 + reach * cos), ..system.plant().clone() };
        return system.with_plant(plant).ok();
    };
    let changed = |setting: Setting, parameter: Option<Parameter>, share: f64| match parameter {
        Some(parameter) => setting.with(parameter, setting.get(parameter) * (1.0 + reach * share)),
        None => setting,
    };
    let [first, second] = setting.family().searched();
    System::new(changed(changed(setting, first, cos), second, sin)).ok()
}

/// Searches the orbits of a neighbour, and follows what is found back.
fn beside(beside: &System, system: &System, label: &Label, search: &Search) -> Beside {
    let mut result = Beside { motion: None, tried: 0, orbits: 0 };
    for start in starts(beside, search, SCATTERED_BESIDE) {
        result.orbits += 1;
        let (found, guesses) = among_returns(beside, label, &start, search, TRIES / 4);
        result.tried += guesses;
        result.motion = found.and_then(|motion| followed(&motion, beside, system));
        if result.motion.is_some() {
            break;
        }
    }
    result
}

/// The starts of the orbits that are searched: the one given, the symmetric motion's where it exists, and scattered ones.
fn starts(system: &System, search: &Search, scattered_ones: u32) -> Vec<Vec<f64>> {
    let known = std::iter::once(search.start.clone()).chain(symmetric_start(system));
    known.chain((0..scattered_ones).map(|i| scattered(system, i))).collect()
}

/// A start between the stops, one of a sequence that fills the space evenly.
fn scattered(system: &System, index: u32) -> Vec<f64> {
    let plant = system.plant();
    let (n, size) = (plant.n, 2 * plant.n);
    // The additive recurrence of the golden ratio of 2n dimensions, the root of xᵐ⁺¹ = x + 1.
    let power = 1.0 / (size as f64 + 1.0);
    let ratio = (0..64).fold(2.0f64, |ratio, _| libm::pow(1.0 + ratio, power));
    let fraction = |k: usize| (0.5 + f64::from(index + 1) / ratio.powi(k as i32 + 1)).fract() * 2.0 - 1.0;
    let flow = Flow::new(system);
    let unit = flow.unit();
    let mut start: Vec<f64> = (0..size).map(|k| fraction(k) * unit).collect();
    // In reverse, so that of several stops on a line the first determines where it begins.
    for (stop, face) in flow.faces().collect::<Vec<_>>().into_iter().rev() {
        let c = face.coordinate;
        start[n + c] = 2.0 * fraction(n + c) * unit;
        // Across the clearance where there is one, within a length of order one where there is not.
        let opposite = plant.stops.iter().enumerate().find_map(|(other, opposite)| {
            let scale = -opposite.direction.dot(&face.direction) / face.direction.norm_squared();
            let parallel = (&opposite.direction + &face.direction * scale).amax() <= 1e-12;
            (other != stop.index() && scale > 0.0 && parallel).then(|| opposite.gap / scale)
        });
        let far = opposite.unwrap_or(2.0 * face.direction.norm() * unit - face.gap);
        let share = 0.5 * (1.0 + fraction(c));
        let place = share.mul_add(face.gap + far, -far);
        let others: f64 = (0..n).filter(|&j| j != c).map(|j| face.direction[j] * start[j]).sum();
        start[c] = (place - others) / face.direction[c];
    }
    follower(system).bring_within(&mut start[..n]);
    start
}

/// Follows a motion from one system to another in steps that adapt, all parameters changing in proportion; none if it is
/// lost on the way.
fn followed(motion: &PeriodicMotion, from: &System, to: &System) -> Option<PeriodicMotion> {
    let mut reached = 0.0;
    let mut step: f64 = 0.25;
    let mut current = motion.clone();
    while reached < 1.0 {
        let share = (reached + step).min(1.0);
        let near = between(from, to, share).and_then(|system| {
            let next = PeriodicMotion::refine(&system, &current.pattern, &current.sections).ok()?;
            let same = next.pattern == current.pattern
                && (phase(&next.sections[0]) - phase(&current.sections[0])).abs() < 0.3;
            same.then_some(next)
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

/// The system a share of the way from one to another; the other itself at its end.
fn between(from: &System, to: &System, share: f64) -> Option<System> {
    if share == 1.0 {
        return Some(to.clone());
    }
    let (Some(first), Some(last)) = (from.setting(), to.setting()) else {
        let [a, b] = [from, to].map(|system| system.plant().omega);
        return to.with_plant(Plant { omega: a + share * (b - a), ..to.plant().clone() }).ok();
    };
    let blended = last.entries().fold(last, |setting, (parameter, b)| {
        let a = first.get(parameter);
        if a == b { setting } else { setting.with(parameter, a + share * (b - a)) }
    });
    System::new(blended).ok()
}
