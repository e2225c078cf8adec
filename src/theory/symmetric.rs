//! The period-one double-impact symmetric motion of section 3, in closed form, of any system with a mirror.

use thiserror::Error;

use super::admissible::{Inadmissible, NamedStop, fly_by, leaves_inwards};
use super::face::Face;
use super::flow::Flow;
use super::follower::{Follower, follower};
use super::matching_line::{MatchingLine, distance};
use super::motion::PeriodicMotion;
use super::pattern::{Pattern, StopSet};
use super::section_vector::{SectionVector, phase, wrapped};
use crate::dynamics::Stop;
use crate::model::System;

/// How far a start on the symmetric motion is moved off it, so that an unstable one is left; non-dimensional.
pub const NUDGE: f64 = 1e-3;

/// One solution of the matching conditions (5); everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricMotion {
    /// The motion that the conditions describe, whether or not the system follows it.
    pub motion: PeriodicMotion,
    /// (x, v) at forcing phase 0 if the motion is physical, otherwise why no trajectory follows it.
    pub at_phase_zero: Result<Vec<f64>, Inadmissible>,
}

impl SymmetricMotion {
    /// The largest modulus among the half map's multipliers; the motion is stable where it is below 1.
    ///
    /// Infinite where the impacts graze, since there is nothing to linearise about.
    pub fn spectral_radius(&self, system: &System) -> f64 {
        self.motion.half_multipliers(system).map_or(f64::INFINITY, |values| values[0].norm())
    }
}

/// Why the matching conditions (5) have no solution.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoSymmetricMotion {
    /// The system has no mirror, or its mirror maps every stop onto itself.
    #[error("does not exist: the system has no mirror that exchanges two stops")]
    NoMirror,
    /// There is no room to move.
    #[error("does not exist: {0}")]
    Clamped(String),
    /// Whatever the phase, the motion would not reach from stop to stop.
    #[error(
        "does not exist: the forcing drives the matched motion to |{along}| = {amplitude} at most, short of the stops at \
         ±{delta}"
    )]
    OutOfReach {
        /// What meets the stops: a coordinate, or d·x.
        along: String,
        /// The largest displacement at impact over all phases, along the stop's direction.
        amplitude: f64,
        /// The stop's gap.
        delta: f64,
    },
    /// Whatever the phase, the motion would not reach from stop to stop, and the constant load has a share in that.
    #[error("does not exist: the matched motion would need a forcing {factor} times as strong")]
    TooWeak {
        /// How strong the forcing would have to be at least.
        factor: f64,
    },
    /// The matching conditions are singular.
    #[error("does not exist: the matching conditions are singular here")]
    Singular,
}

/// Both solutions of (5), in the order of τ: the motion between two stops that the mirror exchanges, the first such.
///
/// With Φ the flight over half a period from y = (x, v), Γs, Γc and Γ₁ what forcing at phase τ and the constant load add
/// to it, D the impact at the other stop and P the mirror, the state y just after the impact at the first stop satisfies
/// (DΦ − P) y + D (Γs sin τ + Γc cos τ + Γ₁) = 0 with d·x = gap: 2n equations for the other 2n − 1 components of y,
/// sin τ and cos τ. Their solutions are a straight line, which sin² τ + cos² τ = 1 meets twice. DΦ − P itself is singular
/// at a resonance without damping, and wherever r = 1 and ζ = 0 in the paper's oscillator; the line is not.
///
/// # Errors
/// [`NoSymmetricMotion`] where no real τ solves it, or there is no such mirror.
pub fn symmetric_motions(system: &System) -> Result<[SymmetricMotion; 2], NoSymmetricMotion> {
    let stop = exchanged_stop(system).ok_or(NoSymmetricMotion::NoMirror)?;
    let among = StopSet::of(system);
    let stops = &system.plant().stops;
    let opposite = &stops[among.image(stop).index()];
    let own = &stops[stop.index()];
    let room = own.gap / own.direction.norm() + opposite.gap / opposite.direction.norm();
    let facing = &own.direction / own.direction.norm() + &opposite.direction / opposite.direction.norm();
    if room == 0.0 && facing.amax() <= 1e-12 {
        return Err(NoSymmetricMotion::Clamped(system.closed()));
    }
    let flow = Flow::new(system);
    let face = flow.face(stop);
    let line = system.whatever_gaps(|| MatchingLine::of(&flow, stop, among.image(stop)));
    let line = line.as_ref().as_ref().ok_or(NoSymmetricMotion::Singular)?;
    let point = line.at_gap(face.gap);
    let nearest = distance(&point);
    if nearest > 1.0 {
        let load = system.plant().load.amax() > 0.0;
        let (amplitude, delta) = (face.gap / nearest, face.gap);
        return Err(match load || delta == 0.0 {
            false => NoSymmetricMotion::OutOfReach { along: met_by(face), amplitude, delta },
            true => NoSymmetricMotion::TooWeak { factor: nearest },
        });
    }
    let mut sections = line.meeting(&point).map(|mut section| {
        let last = section.len() - 1;
        section[last] = wrapped(section[last]);
        if face.restitution == 0.0 {
            // Without restitution the speed after the impact is exactly zero; rounding may have left another value.
            section[0] = face.resting_speed(&section);
        }
        section
    });
    sections.sort_by(|a, b| phase(a).total_cmp(&phase(b)));
    let pattern = Pattern { stops: vec![stop], half_turns: 1, mirrored: true, among };
    let mut kept = None;
    let solutions = sections.map(|section| {
        let residual = line.residual(&section, face.gap);
        let motion = PeriodicMotion { pattern: pattern.clone(), sections: vec![section], residual };
        let at_phase_zero = followed(system, &flow, &mut kept, &motion);
        SymmetricMotion { motion, at_phase_zero }
    });
    let scale = |section: &SectionVector| 1.0 + section.amax();
    let solved = |solution: &SymmetricMotion| {
        solution.motion.residual <= ACCEPTED * scale(&solution.motion.sections[0])
    };
    if solutions.iter().all(solved) { Ok(solutions) } else { Err(NoSymmetricMotion::Singular) }
}

/// What meets a stop: a coordinate, or d·x.
fn met_by(face: &Face) -> String {
    let own = face.direction[face.coordinate].abs() == 1.0 && face.direction.norm() == 1.0;
    if own { format!("x{}", face.coordinate + 1) } else { "d·x".to_owned() }
}

/// The first stop that the mirror maps onto another.
fn exchanged_stop(system: &System) -> Option<Stop> {
    let mirror = system.mirror()?;
    let first = mirror.stops.iter().enumerate().position(|(stop, &image)| stop != image)?;
    Some(Stop(first as u8))
}

/// The largest residual of the matching equations that a solution in closed form may leave, for states of order one.
const ACCEPTED: f64 = 1e-8;

/// (x, v) at forcing phase 0 if the system follows a solution; `kept` is a follower of it, once there is one.
fn followed(
    system: &System,
    flow: &Flow,
    kept: &mut Option<Box<dyn Follower>>,
    motion: &PeriodicMotion,
) -> Result<Vec<f64>, Inadmissible> {
    let (pattern, section) = (&motion.pattern, &motion.sections[0]);
    let stop = pattern.stops[0];
    let face = flow.face(stop);
    // Without restitution the mass rests as the impact ends.
    if face.speed(section) == 0.0 && face.restitution > 0.0 {
        let (coordinate, velocity) = (face.coordinate, section[0]);
        return Err(Inadmissible::WrongVelocity { stop: NamedStop::of(system, stop), coordinate, velocity });
    }
    leaves_inwards(system, flow, stop, section)?;
    let follower = kept.get_or_insert_with(|| follower(system));
    let flown = fly_by(system, flow, follower.as_mut(), pattern, &motion.sections)?;
    flown.at_phase_zero.ok_or(Inadmissible::Misses(NamedStop::of(system, pattern.closing_stop())))
}

/// (x, v) at forcing phase 0 on the stable-branch 1-1-1 symmetric motion, nudged, where it exists and is physical.
///
/// Of two physical solutions the one with the smaller multipliers is taken. The first displacement that no stop bears on
/// is nudged, the first velocity where there is none.
pub fn symmetric_start(system: &System) -> Option<Vec<f64>> {
    let mut state = stable_branch(system)?.at_phase_zero.ok()?;
    let plant = system.plant();
    let borne = |i: &usize| plant.stops.iter().any(|stop| stop.direction[*i] != 0.0);
    let nudged = (0..plant.n).find(|i| !borne(i)).unwrap_or(plant.n);
    state[nudged] += NUDGE;
    Some(state)
}

/// The fixed point of the same motion on the section at its first stop, (v1+, x2, v2, τ) of the paper's oscillator, where
/// it exists and is physical.
pub fn symmetric_target(system: &System) -> Option<Vec<f64>> {
    stable_branch(system).map(|motion| motion.motion.section())
}

/// The same point on the section at a stop; none where the motion does not meet it, or is not physical.
pub fn symmetric_target_at(system: &System, stop: Stop) -> Option<Vec<f64>> {
    let motion = stable_branch(system)?.motion;
    if motion.pattern.stops[0] == stop {
        return Some(motion.section());
    }
    let image = motion.pattern.closing(&Flow::new(system), &motion.sections[0]);
    let mut section = image.section.as_slice().to_vec();
    let tau = section.last_mut()?;
    *tau = wrapped(*tau);
    (image.stop == stop).then_some(section)
}

pub(super) fn stable_branch(system: &System) -> Option<SymmetricMotion> {
    let radius = |motion: &SymmetricMotion| motion.spectral_radius(system);
    let [a, b] = symmetric_motions(system).ok()?;
    match (a.at_phase_zero.is_ok(), b.at_phase_zero.is_ok()) {
        (true, true) => Some(if radius(&a) <= radius(&b) { a } else { b }),
        (true, false) => Some(a),
        (false, true) => Some(b),
        (false, false) => None,
    }
}
