//! The period-one double-impact symmetric motion of section 3, in closed form, of any system with a mirror.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};
use thiserror::Error;

use super::admissible::{Inadmissible, NamedStop, fly_by};
use super::face::Face;
use super::flow::Flow;
use super::follower::{Follower, follower};
use super::motion::PeriodicMotion;
use super::newton;
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
    let line = Line::of_matching(&flow, stop, among.image(stop)).ok_or(NoSymmetricMotion::Singular)?;
    let nearest = line.nearest();
    if nearest > 1.0 {
        let load = system.plant().load.amax() > 0.0;
        let (amplitude, delta) = (face.gap / nearest, face.gap);
        return Err(match load || delta == 0.0 {
            false => NoSymmetricMotion::OutOfReach { along: met_by(face), amplitude, delta },
            true => NoSymmetricMotion::TooWeak { factor: nearest },
        });
    }
    let half_chord = (1.0 - nearest * nearest).sqrt();
    let mut sections = [-half_chord, half_chord].map(|along| {
        let values = line.at(along);
        let last = 2 * flow.n - 1;
        let mut section = values.rows(0, 2 * flow.n).into_owned();
        section[last] = wrapped(values[last].atan2(values[last + 1]));
        if face.restitution == 0.0 {
            // Without restitution the speed after the impact is exactly zero; rounding may have left another value.
            section[0] = face.resting_speed(&section);
        }
        section
    });
    sections.sort_by(|a, b| phase(a).total_cmp(&phase(b)));
    let mut follower = follower(system);
    let solutions = sections.map(|section| solution(system, &flow, follower.as_mut(), stop, section));
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

/// The solutions of the matching equations before sin² τ + cos² τ = 1: the section without its phase, then sin τ and
/// cos τ, 2n + 1 numbers.
struct Line {
    /// Its point nearest to (sin τ, cos τ) = 0 in those two.
    point: DVector<f64>,
    /// Its direction, of unit length in (sin τ, cos τ).
    direction: DVector<f64>,
}

impl Line {
    fn of_matching(flow: &Flow, from: Stop, to: Stop) -> Option<Self> {
        let (n, face, image) = (flow.n, flow.face(from), flow.face(to));
        let size = 2 * n;
        let half = flow.over(PI / flow.omega);
        // After the impact, as components of the section there; the last one is d·x.
        let arrived = &image.restituted * &half;
        // The same of the mirror image.
        let due = |z: &DVector<f64>| {
            let y = flow.mirrored(&z.rows(0, size).into_owned());
            let mut section = image.section(y.rows(0, n).as_slice(), y.rows(n, n).as_slice(), 0.0);
            section[size - 1] = image.along(&y)[0];
            section
        };
        let defect = |z: &DVector<f64>| &arrived * z - due(z);
        let mut columns: Vec<DVector<f64>> =
            (0..size - 1).map(|k| defect(&face.lift.column(k).into_owned())).collect();
        columns.extend([size, size + 1].map(|k| arrived.column(k).into_owned()));
        let matrix = DMatrix::from_columns(&columns);
        let point = matrix.clone().svd(true, true).solve(&-defect(&face.origin), 0.0).ok()?;
        // The null vector of 2n rows in 2n + 1 dimensions: their cross product.
        let minor = |j: usize| matrix.clone().remove_column(j).determinant();
        let null = DVector::from_fn(size + 1, |j, _| if j % 2 == 0 { minor(j) } else { -minor(j) });
        let direction = &null / null[size - 1].hypot(null[size]);
        if !direction.iter().chain(point.iter()).all(|value| value.is_finite()) {
            return None;
        }
        let along = direction[size - 1] * point[size - 1] + direction[size] * point[size];
        let point = point - &direction * along;
        Some(Line { point, direction })
    }

    /// How near it comes to (sin τ, cos τ) = 0.
    fn nearest(&self) -> f64 {
        let size = self.point.len();
        self.point[size - 2].hypot(self.point[size - 1])
    }

    fn at(&self, along: f64) -> DVector<f64> {
        &self.point + &self.direction * along
    }
}

/// One solution, and whether the system follows it.
fn solution(
    system: &System,
    flow: &Flow,
    follower: &mut dyn Follower,
    stop: Stop,
    section: SectionVector,
) -> SymmetricMotion {
    let pattern = Pattern::new(system, vec![stop], 1, true);
    let image = pattern.closing_stop();
    let face = flow.face(stop);
    let (coordinate, velocity) = (face.coordinate, section[0]);
    let rests = face.speed(&section) == 0.0 && face.restitution > 0.0;
    let sections = vec![section];
    let residual = newton::residual(&newton::arcs(flow, &pattern, &sections)).amax();
    let motion = PeriodicMotion { pattern, sections, residual };
    let at_phase_zero = if rests {
        Err(Inadmissible::WrongVelocity { stop: NamedStop::of(system, stop), coordinate, velocity })
    } else {
        fly_by(system, flow, follower, &motion.pattern, &motion.sections)
            .and_then(|flown| flown.at_phase_zero.ok_or(Inadmissible::Misses(NamedStop::of(system, image))))
    };
    SymmetricMotion { motion, at_phase_zero }
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
