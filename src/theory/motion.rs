//! A periodic motion, solved to rounding.

use std::f64::consts::{PI, TAU};

use nalgebra::Complex;
use thiserror::Error;

use super::admissible::{Inadmissible, fly};
use super::flow::{Flow, PHASE, Section};
use super::multipliers::{STABLE, eigenvalues, ordered, turn};
use super::newton;
use super::pattern::{Pattern, opposite};
use crate::dynamics::Stop;
use crate::model::generator::{V1, V2, X1, X2};
use crate::model::{Flight, System};

/// A periodic motion with finitely many impacts, stable or not: a solution of the matching equations of its pattern.
///
/// Everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicMotion {
    /// The order of its impacts.
    pub pattern: Pattern,
    /// The state just after each impact of the pattern, in order.
    pub sections: Vec<Section>,
    /// The largest residual of the matching equations.
    pub residual: f64,
}

/// Why there is no such motion near a guess.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NoMotion {
    /// Newton's method found no solution.
    #[error("Newton's method finds no solution of the matching equations from here")]
    NotConverged,
    /// There is a solution, but the system does not move like that.
    #[error(transparent)]
    Inadmissible(#[from] Inadmissible),
}

impl PeriodicMotion {
    /// Solves the matching equations of a pattern from a guess of its sections; an admissible motion.
    ///
    /// # Errors
    /// [`NoMotion`]: no solution near by, or one that no trajectory follows.
    pub fn refine(system: &System, pattern: &Pattern, guess: &[Section]) -> Result<Self, NoMotion> {
        let flow = Flow::new(system);
        let (sections, residual) = newton::solve(&flow, pattern, guess).ok_or(NoMotion::NotConverged)?;
        let motion = PeriodicMotion { pattern: pattern.clone(), sections, residual }.normalised();
        fly(&Flight::new(system), &motion)?;
        Ok(motion.reduced(&flow))
    }

    /// The mirror image of the motion half a forcing period later, −x(t + π/ω): as much a motion as this one.
    #[must_use]
    pub fn mirror_image(&self) -> Self {
        let turned =
            |section: &Section| Section::new(-section[0], -section[1], -section[2], section[PHASE] + PI);
        let stops = self.pattern.stops.iter().map(|&stop| opposite(stop)).collect();
        let pattern = Pattern { stops, ..self.pattern.clone() };
        let sections = self.sections.iter().map(turned).collect();
        PeriodicMotion { pattern, sections, residual: self.residual }.normalised()
    }

    /// Begins at the first impact at A, if there is one, with a phase in [0, 2π).
    fn normalised(mut self) -> Self {
        if let Some(first) = self.pattern.stops.iter().position(|&stop| stop == Stop::A) {
            self.rotate(first);
        } else if self.pattern.mirrored {
            // All impacts of this half are at Ā: the other half has them at A.
            self.pattern.stops.fill(Stop::A);
            for section in &mut self.sections {
                *section = section.component_mul(&self.pattern.closing_factors());
                section[PHASE] += f64::from(self.pattern.half_turns) * PI;
            }
        }
        let turns = (self.sections[0][PHASE] / TAU).floor();
        for section in &mut self.sections {
            section[PHASE] -= turns * TAU;
        }
        self
    }

    /// Begins at the `first`-th impact of the pattern.
    pub(crate) fn rotate(&mut self, first: usize) {
        for _ in 0..first {
            let again = self.pattern.closing(&self.sections[0]);
            self.sections.remove(0);
            self.pattern.stops.remove(0);
            self.sections.push(again.section);
            self.pattern.stops.push(again.stop);
        }
    }

    /// The same motion as a pattern that does not repeat itself: a motion found over several of its periods, or over
    /// a whole period although it is symmetric, is described by the shortest part.
    fn reduced(self, flow: &Flow) -> Self {
        let count = self.sections.len();
        for parts in (2..=count).rev().filter(|parts| count.is_multiple_of(*parts)) {
            let Some(pattern) = self.part(parts) else { continue };
            let near = newton::solve(flow, &pattern, &self.sections[..count / parts]);
            let Some((sections, residual)) = near else { continue };
            let same = |(a, b): (&Section, &Section)| (a - b).amax() < 1e-6 * (1.0 + a.amax());
            if sections.iter().zip(&self.sections).all(same) {
                return PeriodicMotion { pattern, sections, residual };
            }
        }
        self
    }

    /// The pattern of one of so many equal parts, if the order of the stops and the half turns allow it.
    pub(crate) fn part(&self, parts: usize) -> Option<Pattern> {
        let Pattern { stops, half_turns, mirrored } = &self.pattern;
        let size = stops.len() / parts;
        if !half_turns.is_multiple_of(parts as u32) {
            return None;
        }
        let half_turns = half_turns / parts as u32;
        let part = &stops[..size];
        let follows = |mirror: bool| {
            stops.chunks(size).enumerate().all(|(k, chunk)| {
                let turned = mirror && k % 2 == 1;
                chunk.iter().zip(part).all(|(a, b)| (a == b) != turned)
            })
        };
        // An even number of mirrored parts closes on itself, an odd one on the mirror image.
        let odd = half_turns % 2 == 1;
        let closes = if odd { (parts % 2 == 1) == *mirrored } else { !*mirrored };
        (closes && follows(odd)).then(|| Pattern { stops: part.to_vec(), half_turns, mirrored: odd })
    }

    /// N-p-q.
    pub fn label(&self) -> String {
        self.pattern.label()
    }

    /// Whether it is its own mirror image half a period later.
    pub fn is_symmetric(&self) -> bool {
        self.pattern.mirrored
    }

    /// The fixed point on the section of its first impact, at A unless it never strikes A: (v1+, x2, v2, τ),
    /// 0 ≤ τ < 2π.
    pub fn section(&self) -> [f64; 4] {
        self.sections[0].into()
    }

    /// (x1, x2, v1, v2) at forcing phase 0, from the impact before it.
    pub fn at_phase_zero(&self, system: &System) -> [f64; 4] {
        let flow = Flow::new(system);
        let begins = self.sections[0][PHASE];
        let mut half_turns = (begins / PI).ceil();
        if half_turns.rem_euclid(2.0) != 0.0 && !self.pattern.mirrored {
            half_turns += 1.0;
        }
        // Half a turn off, a symmetric motion's mirror image is met.
        let side = if half_turns.rem_euclid(2.0) == 0.0 { 1.0 } else { -1.0 };
        let phase = half_turns * PI;
        let last = self.sections.iter().rposition(|section| section[PHASE] <= phase).unwrap_or(0);
        let section = &self.sections[last];
        let start = flow.lifted(self.pattern.stops[last], section);
        let z = flow.over((phase - section[PHASE]) / flow.omega) * start;
        [X1, X2, V1, V2].map(|k| side * z[k] + 0.0)
    }

    /// Eigenvalues of the half map of a symmetric motion, largest modulus first: flight over N/2 forcing periods with its
    /// impacts, then the mirror.
    ///
    /// None for a motion that is not symmetric, or that grazes.
    pub fn half_multipliers(&self, system: &System) -> Option<[Complex<f64>; 4]> {
        let flow = Flow::new(system);
        self.pattern
            .mirrored
            .then(|| turn(&flow, &self.pattern, &self.sections))?
            .and_then(|map| eigenvalues(&map))
    }

    /// The Floquet multipliers, largest modulus first: the eigenvalues of the Jacobian of one period.
    ///
    /// None for a motion that grazes, where there is no derivative.
    pub fn multipliers(&self, system: &System) -> Option<[Complex<f64>; 4]> {
        let half =
            turn(&Flow::new(system), &self.pattern, &self.sections).and_then(|map| eigenvalues(&map))?;
        Some(if self.pattern.mirrored { ordered(half.map(|value| value * value)) } else { half })
    }

    /// Whether all Floquet multipliers lie within the unit circle; none where there are none.
    pub fn is_stable(&self, system: &System) -> Option<bool> {
        Some(self.multipliers(system)?.iter().all(|value| value.norm() < STABLE))
    }
}
