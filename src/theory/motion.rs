//! A periodic motion, solved to rounding.

use std::f64::consts::{PI, TAU};

use nalgebra::{Complex, ComplexField, DMatrix};
use thiserror::Error;

use super::admissible::{Inadmissible, fly};
use super::flow::Flow;
use super::multipliers::{self, STABLE, ordered, turn};
use super::newton;
use super::pattern::Pattern;
use super::section_vector::{Node, SectionVector, extent, in_units, phase};
use crate::model::System;

/// How far the sections of equal motions may be apart, relative to their size; see [`extent`].
const SAME: f64 = 1e-6;

/// A periodic motion with finitely many impacts, stable or not: a solution of the matching equations of its pattern.
///
/// Everything is non-dimensional.
#[derive(Clone, Debug, PartialEq)]
pub struct PeriodicMotion {
    /// The order of its impacts.
    pub pattern: Pattern,
    /// The state just after each impact of the pattern, in order.
    pub sections: Vec<SectionVector>,
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
    ///
    /// # Panics
    /// If the guess has not a section of 2n components for each impact of the pattern, or the pattern a stop that the system has not.
    pub fn refine(system: &System, pattern: &Pattern, guess: &[SectionVector]) -> Result<Self, NoMotion> {
        let flow = Flow::new(system);
        let (sections, residual) = newton::solve(&flow, pattern, guess).ok_or(NoMotion::NotConverged)?;
        let motion = PeriodicMotion { pattern: pattern.clone(), sections, residual }.normalised(&flow);
        fly(system, &motion.pattern, &motion.sections)?;
        Ok(motion.reduced(&flow))
    }

    /// The mirror image of the motion half a forcing period later, P x(t + π/ω): as much a motion as this one.
    ///
    /// None where the system has no mirror.
    pub fn mirror_image(&self, system: &System) -> Option<Self> {
        let flow = Flow::new(system);
        if !self.pattern.among.has_mirror() {
            return None;
        }
        let mut image = self.clone();
        for (stop, section) in image.pattern.stops.iter_mut().zip(&mut image.sections) {
            let node = flow.mirror_image(&Node { stop: *stop, section: section.clone() });
            (*stop, *section) = (node.stop, node.section);
            *later(section) += PI;
        }
        Some(image.normalised(&flow))
    }

    /// Begins at the first impact at the first of the stops that it strikes, with a phase in [0, 2π).
    fn normalised(mut self, flow: &Flow) -> Self {
        let Pattern { stops, mirrored, among, .. } = &self.pattern;
        let images = stops.iter().filter(|_| *mirrored).map(|&stop| among.image(stop));
        let all: Vec<_> = stops.iter().copied().chain(images).collect();
        let first = (0..all.len()).min_by_key(|&i| all[i]).unwrap_or(0);
        self.rotate(flow, first);
        let turns = (phase(&self.sections[0]) / TAU).floor();
        for section in &mut self.sections {
            *later(section) -= turns * TAU;
        }
        self
    }

    /// Begins at the `first`-th impact of the pattern.
    pub(crate) fn rotate(&mut self, flow: &Flow, first: usize) {
        for _ in 0..first {
            let again = self.pattern.closing(flow, &self.sections[0]);
            self.sections.remove(0);
            self.pattern.stops.remove(0);
            self.sections.push(again.section);
            self.pattern.stops.push(again.stop);
        }
    }

    /// The same motion as a pattern that does not repeat itself: a motion found over several of its periods, or over
    /// a whole period although it is symmetric, is described by the shortest part.
    fn reduced(self, flow: &Flow) -> Self {
        let (count, unit) = (self.sections.len(), flow.unit());
        for parts in (2..=count).rev().filter(|parts| count.is_multiple_of(*parts)) {
            let Some(pattern) = self.part(parts) else { continue };
            let near = newton::solve(flow, &pattern, &self.sections[..count / parts]);
            let Some((sections, residual)) = near else { continue };
            let same = |(a, b): (&SectionVector, &SectionVector)| {
                extent(&(a - b), unit) < SAME * (1.0 + extent(a, unit))
            };
            if sections.iter().zip(&self.sections).all(same) {
                return PeriodicMotion { pattern, sections, residual };
            }
        }
        self
    }

    /// The pattern of one of so many equal parts, if the order of the stops and the half turns allow it.
    pub(crate) fn part(&self, parts: usize) -> Option<Pattern> {
        let Pattern { stops, half_turns, mirrored, among } = &self.pattern;
        let size = stops.len() / parts;
        if !half_turns.is_multiple_of(parts as u32) || !stops.len().is_multiple_of(parts) {
            return None;
        }
        let half_turns = half_turns / parts as u32;
        let part = &stops[..size];
        let follows = |mirror: bool| {
            stops.chunks(size).enumerate().all(|(k, chunk)| {
                let turned = mirror && k % 2 == 1;
                chunk.iter().zip(part).all(|(&a, &b)| a == if turned { among.image(b) } else { b })
            })
        };
        // An even number of mirrored parts closes on itself, an odd one on the mirror image.
        let odd = half_turns % 2 == 1;
        let closes = if odd { (parts % 2 == 1) == *mirrored } else { !*mirrored };
        let pattern = Pattern { stops: part.to_vec(), half_turns, mirrored: odd, among: among.clone() };
        (closes && (among.has_mirror() || !odd) && follows(odd)).then_some(pattern)
    }

    /// N and the impacts at each stop, N-p-q of the paper's oscillator.
    pub fn label(&self) -> String {
        self.pattern.label()
    }

    /// Whether it is its own mirror image half a period later.
    pub fn is_symmetric(&self) -> bool {
        self.pattern.mirrored
    }

    /// The fixed point on the section of its first impact, at the first of the stops that it strikes; see
    /// [`section_names`](super::section_names). 2n components, the last one in [0, 2π).
    pub fn section(&self) -> Vec<f64> {
        self.sections[0].as_slice().to_vec()
    }

    /// (x, v) at forcing phase 0, from the impact before it.
    pub fn at_phase_zero(&self, system: &System) -> Vec<f64> {
        let flow = Flow::new(system);
        let begins = phase(&self.sections[0]);
        let mut half_turns = (begins / PI).ceil();
        if half_turns.rem_euclid(2.0) != 0.0 && !self.pattern.mirrored {
            half_turns += 1.0;
        }
        let strobe = half_turns * PI;
        let last = self.sections.iter().rposition(|section| phase(section) <= strobe).unwrap_or(0);
        let section = &self.sections[last];
        let start = flow.lifted(self.pattern.stops[last], section);
        let z = &*flow.over((strobe - phase(section)) / flow.omega) * start;
        // At an odd number of half turns the state is on the mirror image of a symmetric motion.
        let turned = half_turns.rem_euclid(2.0) != 0.0;
        let values = [0, flow.n].map(|at| {
            let part = z.rows(at, flow.n).into_owned();
            if turned { flow.reflected(part.as_slice()) } else { part }
        });
        values.iter().flatten().map(|value| value + 0.0).collect()
    }

    /// The Jacobian of one turn around the motion on the section of its first impact, 2n × 2n: of one period, or of half
    /// of it followed by the mirror where the motion is symmetric.
    ///
    /// None for a motion that grazes, where there is no derivative.
    pub fn jacobian(&self, system: &System) -> Option<DMatrix<f64>> {
        turn(&Flow::new(system), &self.pattern, &self.sections)
    }

    /// Eigenvalues of the half map of a symmetric motion, largest modulus first: flight over N/2 forcing periods with its
    /// impacts, then the mirror.
    ///
    /// None for a motion that is not symmetric, or that grazes.
    pub fn half_multipliers(&self, system: &System) -> Option<Vec<Complex<f64>>> {
        if self.pattern.mirrored { self.of_turn(system) } else { None }
    }

    /// The multipliers of the Jacobian of one turn.
    fn of_turn(&self, system: &System) -> Option<Vec<Complex<f64>>> {
        let (turn, periods) = (self.jacobian(system)?, self.pattern.turn() / TAU);
        let turn = in_units(turn, system.unit());
        multipliers::multipliers(&turn, periods, system.mooring().map(AsRef::as_ref))
    }

    /// The 2n Floquet multipliers, largest modulus first: the eigenvalues of the Jacobian of one period. Fewer where
    /// it may drift: those of what is held are left out; see [`System::moored`].
    ///
    /// None for a motion that grazes, where there is no derivative.
    pub fn multipliers(&self, system: &System) -> Option<Vec<Complex<f64>>> {
        let turn = self.of_turn(system)?;
        let squares = |values: Vec<Complex<f64>>| values.iter().map(|value| value * value).collect();
        Some(if self.pattern.mirrored { ordered(squares(turn)) } else { turn })
    }

    /// Whether all Floquet multipliers lie within the unit circle; none where there are none.
    pub fn is_stable(&self, system: &System) -> Option<bool> {
        Some(self.multipliers(system)?.iter().all(|value| value.modulus() < STABLE))
    }
}

/// The forcing phase of a section, to be changed.
fn later(section: &mut SectionVector) -> &mut f64 {
    let last = section.len() - 1;
    &mut section[last]
}
