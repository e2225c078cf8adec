//! The period-one double-impact symmetric motion of section 3, in closed form.

use std::f64::consts::PI;

use nalgebra::{Matrix4, Matrix4x5, Vector4};
use thiserror::Error;

use super::admissible::{Inadmissible, fly, wrapped};
use super::flow::{Flow, PHASE, Section};
use super::motion::PeriodicMotion;
use super::newton;
use super::pattern::Pattern;
use crate::dynamics::Stop;
use crate::model::{Flight, System};

/// How far a start on the symmetric motion is moved off it, so that an unstable one is left; non-dimensional.
pub const NUDGE: f64 = 1e-3;

/// One solution of the matching conditions (5); everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct SymmetricMotion {
    /// The motion that the conditions describe, whether or not the system follows it.
    pub motion: PeriodicMotion,
    /// (x1, x2, v1, v2) at forcing phase 0 if the motion is physical, otherwise why no trajectory follows it.
    pub at_phase_zero: Result<[f64; 4], Inadmissible>,
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
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum NoSymmetricMotion {
    /// There is no room to move.
    #[error("does not exist: the stops hold the first mass (delta = 0)")]
    Clamped,
    /// Whatever the phase, the motion would not reach from stop to stop.
    #[error(
        "does not exist: the forcing drives the matched motion to |x1| = {amplitude} at most, short of the stops at \
         ±{delta}"
    )]
    OutOfReach {
        /// The largest x1 at impact over all phases.
        amplitude: f64,
        /// The half clearance.
        delta: f64,
    },
    /// The matching conditions are singular.
    #[error("does not exist: the matching conditions are singular here")]
    Singular,
}

/// Both solutions of (5), in the order of τ.
///
/// With Φ the flight over half a period from (x1, x2, v1, v2), Γs and Γc what forcing at phase τ adds to it, and
/// D = diag(1, 1, −r, 1), the state s just after the impact at A satisfies (I + DΦ) s + D (Γs sin τ + Γc cos τ) = 0 with
/// s₁ = δ: four equations for (x2, v1, v2, sin τ, cos τ). Their solutions are a straight line, which
/// sin² τ + cos² τ = 1 meets twice. I + DΦ itself is singular at a resonance without damping, and wherever r = 1 and
/// ζ = 0; the line is not.
///
/// # Errors
/// [`NoSymmetricMotion`] where no real τ solves it.
pub fn symmetric_motions(system: &System) -> Result<[SymmetricMotion; 2], NoSymmetricMotion> {
    let flow = Flow::new(system);
    let delta = flow.delta;
    if delta == 0.0 {
        return Err(NoSymmetricMotion::Clamped);
    }
    let line = Line::of_matching(&flow).ok_or(NoSymmetricMotion::Singular)?;
    let nearest = line.point[3].hypot(line.point[4]);
    if nearest > 1.0 {
        return Err(NoSymmetricMotion::OutOfReach { amplitude: delta / nearest, delta });
    }
    let flight = Flight::<f64, 2>::new(system);
    let half_chord = (1.0 - nearest * nearest).sqrt();
    let mut sections = [-half_chord, half_chord].map(|along| {
        let [x2, v1, v2, sin, cos]: [f64; 5] = line.at(along).into();
        // Without restitution the first mass leaves the stop from rest, whatever rounding says.
        let v1 = if flow.r == 0.0 { 0.0 } else { v1 };
        Section::new(v1, x2, v2, wrapped(sin.atan2(cos)))
    });
    sections.sort_by(|a, b| a[PHASE].total_cmp(&b[PHASE]));
    let solutions = sections.map(|section| solution(&flight, &flow, section));
    let scale = |section: &Section| 1.0 + section.amax();
    let solved = |solution: &SymmetricMotion| {
        solution.motion.residual <= ACCEPTED * scale(&solution.motion.sections[0])
    };
    if solutions.iter().all(solved) { Ok(solutions) } else { Err(NoSymmetricMotion::Singular) }
}

/// The largest residual of the matching equations that a solution in closed form may leave, for states of order one.
const ACCEPTED: f64 = 1e-8;

/// The solutions (x2, v1, v2, sin τ, cos τ) of the matching equations, before sin² τ + cos² τ = 1.
struct Line {
    /// Its point nearest to (sin τ, cos τ) = 0 in those two.
    point: Vector5,
    /// Its direction, of unit length in (sin τ, cos τ).
    direction: Vector5,
}

type Vector5 = nalgebra::SVector<f64, 5>;

impl Line {
    fn of_matching(flow: &Flow) -> Option<Self> {
        let half = flow.over(PI / flow.omega);
        let restitution = Matrix4::from_diagonal(&Vector4::new(1.0, 1.0, -flow.r, 1.0));
        let phi: Matrix4<f64> = half.fixed_view::<4, 4>(0, 0).into_owned();
        let matching = Matrix4::identity() + restitution * phi;
        let gamma = |j: usize| -> Vector4<f64> { restitution * half.fixed_view::<4, 1>(0, j) };
        let column = |j: usize| -> Vector4<f64> { matching.column(j).into_owned() };
        let matrix = Matrix4x5::from_columns(&[column(1), column(2), column(3), gamma(4), gamma(5)]);
        let point: Vector5 = matrix.svd(true, true).solve(&(column(0) * -flow.delta), 0.0).ok()?;
        // The null vector of four rows in five dimensions: their cross product.
        let minor = |j: usize| matrix.remove_column(j).determinant();
        let null = Vector5::from_fn(|j, _| if j % 2 == 0 { minor(j) } else { -minor(j) });
        let direction = null / null[3].hypot(null[4]);
        if !direction.iter().chain(point.iter()).all(|value| value.is_finite()) {
            return None;
        }
        let point = point - direction * (direction[3] * point[3] + direction[4] * point[4]);
        Some(Line { point, direction })
    }

    fn at(&self, along: f64) -> Vector5 {
        self.point + self.direction * along
    }
}

/// One solution, and whether the system follows it.
fn solution(flight: &Flight<f64, 2>, flow: &Flow, section: Section) -> SymmetricMotion {
    let pattern = Pattern { stops: vec![Stop::A], half_turns: 1, mirrored: true };
    let sections = vec![section];
    let residual = newton::residual(&newton::arcs(flow, &pattern, &sections)).amax();
    let motion = PeriodicMotion { pattern, sections, residual };
    let velocity = section[0];
    let at_phase_zero = if velocity == 0.0 && flow.r > 0.0 {
        Err(Inadmissible::WrongVelocity { stop: Stop::A, velocity })
    } else {
        fly(flight, &motion).and_then(|flown| flown.at_phase_zero.ok_or(Inadmissible::Misses(Stop::B)))
    };
    SymmetricMotion { motion, at_phase_zero }
}

/// (x1, x2, v1, v2) at forcing phase 0 on the stable-branch 1-1-1 symmetric motion, nudged, where it exists and is
/// physical.
///
/// Of two physical solutions the one with the smaller multipliers is taken.
pub fn symmetric_start(system: &System) -> Option<[f64; 4]> {
    let [x1, x2, v1, v2] = stable_branch(system)?.at_phase_zero.ok()?;
    Some([x1, x2 + NUDGE, v1, v2])
}

/// The fixed point (v1+, x2, v2, τ) of the same motion on σ, where it exists and is physical.
pub fn symmetric_target(system: &System) -> Option<[f64; 4]> {
    stable_branch(system).map(|motion| motion.motion.section())
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
