//! The solutions of the matching conditions (5): their sections, whether the system follows them, and which of the two can be
//! stable.

use std::cell::OnceCell;

use nalgebra::{Complex, ComplexField, DMatrix};
use thiserror::Error;

use super::admissible::{Inadmissible, NamedStop, fly_along, leaves_inwards, wrong_velocity};
use super::face::Face;
use super::flow::Flow;
use super::follower::KeptFollower;
use super::matching::Arc;
use super::matching_line::MatchingLine;
use super::motion::PeriodicMotion;
use super::multipliers::{contracts, eigenvalues, turn_along};
use super::newton::ends;
use super::pattern::{Pattern, StopSet};
use super::section_vector::{Node, SectionVector, extent, in_units, phase, wrapped};
use crate::dynamics::Stop;
use crate::model::{System, leave_no_room};

/// The largest residual of the matching equations that a solution in closed form may leave, for states of order one.
const ACCEPTED: f64 = 1e-8;

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
        largest(self.motion.half_multipliers(system))
    }
}

/// The modulus of the first of some multipliers.
fn largest(multipliers: Option<Vec<Complex<f64>>>) -> f64 {
    multipliers.map_or(f64::INFINITY, |values| values[0].modulus())
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

/// Both solutions of (5) of a system, in the order of τ.
pub(super) struct Matched<'a> {
    system: &'a System,
    flow: Flow,
    pattern: Pattern,
    sections: [SectionVector; 2],
    /// The impacts between which each is followed, found when they are first asked for.
    ends: [OnceCell<[Node; 2]>; 2],
    residuals: [f64; 2],
    regular: usize,
}

impl<'a> Matched<'a> {
    /// Solves (5).
    pub fn of(system: &'a System) -> Result<Self, NoSymmetricMotion> {
        let stop = exchanged_stop(system).ok_or(NoSymmetricMotion::NoMirror)?;
        let among = StopSet::of(system);
        let flow = Flow::new(system);
        let face = flow.face(stop);
        if leaves_no_room(face, flow.face(among.image(stop))) {
            return Err(NoSymmetricMotion::Clamped(system.closed()));
        }
        let line = system.whatever_gaps(|| MatchingLine::of(&flow, stop, among.image(stop)));
        let line = line.as_ref().as_ref().ok_or(NoSymmetricMotion::Singular)?;
        let point = line.at_gap(face.gap);
        let nearest = line.distance(&point);
        if nearest > 1.0 {
            let load = system.like().load.amax() > 0.0;
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
        let mut regular = line.regular();
        if phase(&sections[0]) > phase(&sections[1]) {
            sections.swap(0, 1);
            regular = 1 - regular;
        }
        let residuals = [0, 1].map(|k| line.residual(&sections[k], face.gap));
        let unit = flow.unit();
        let solved = |k: usize| residuals[k] <= ACCEPTED * unit * (1.0 + extent(&sections[k], unit));
        if !(solved(0) && solved(1)) {
            return Err(NoSymmetricMotion::Singular);
        }
        let pattern = Pattern { stops: vec![stop], half_turns: 1, mirrored: true, among };
        Ok(Matched { system, flow, pattern, sections, ends: Default::default(), residuals, regular })
    }

    /// The one of the two that can be stable.
    ///
    /// With J the Jacobian of half a turn, the other has det(1 − J) < 0, hence a real multiplier above 1, if both reach their
    /// stops with a speed into them. For the derivative of the matching conditions is that of arriving times (1 − J) times the
    /// mirror, and its determinant goes with the place on the line (5), which has the other sign at the other solution.
    pub fn regular(&self) -> usize {
        self.regular
    }

    /// Whether one of them would leave its stop outwards, so that the system does not follow it.
    pub fn leaves_outwards(&self, k: usize) -> bool {
        self.flow.face(self.pattern.stops[0]).is_left_outwards(&self.sections[k])
    }

    /// Whether all multipliers of one of them surely lie within the unit circle.
    pub fn contracts(&self, k: usize) -> bool {
        self.half_turn(k).is_some_and(contracts)
    }

    /// The Jacobian of half a turn around one of them, in units of what is of order one.
    pub fn half_turn(&self, k: usize) -> Option<DMatrix<f64>> {
        let [from, to] = self.ends(k);
        let turn = turn_along(&self.flow, &self.pattern, &[Arc::between(&self.flow, from, to)])?;
        Some(in_units(turn, self.flow.unit()))
    }

    /// The impact at the first stop and the one that is due half a period later.
    fn ends(&self, k: usize) -> &[Node; 2] {
        self.ends[k].get_or_init(|| ends(&self.flow, &self.pattern, &self.sections[k..=k], 0))
    }

    /// The largest modulus among its half map's multipliers; see [`SymmetricMotion::spectral_radius`].
    pub fn spectral_radius(&self, k: usize) -> f64 {
        largest(self.half_turn(k).and_then(|map| eigenvalues(&map)))
    }

    /// One of them, with (x, v) at forcing phase 0 if the system follows it.
    pub fn followed(&self, k: usize, kept: &mut KeptFollower) -> SymmetricMotion {
        let at_phase_zero = self.follow(k, kept);
        SymmetricMotion { motion: self.motion(k), at_phase_zero }
    }

    /// One of them, whether or not the system follows it.
    pub fn motion(&self, k: usize) -> PeriodicMotion {
        let (pattern, sections) = (self.pattern.clone(), vec![self.sections[k].clone()]);
        PeriodicMotion { pattern, sections, residual: self.residuals[k] }
    }

    /// (x, v) at forcing phase 0 if the system follows one of them.
    ///
    /// # Errors
    /// Why it does not.
    pub fn follow(&self, k: usize, kept: &mut KeptFollower) -> Result<Vec<f64>, Inadmissible> {
        let Matched { system, flow, pattern, sections, .. } = self;
        let section = &sections[k];
        let stop = pattern.stops[0];
        let face = flow.face(stop);
        // Without restitution the mass rests as the impact ends.
        if face.speed(section) == 0.0 && face.restitution > 0.0 {
            return Err(wrong_velocity(system, stop, face, section));
        }
        leaves_inwards(system, flow, stop, section)?;
        let at_phase_zero = fly_along(system, flow, kept.of(system), self.ends(k), pattern.mirrored)?;
        at_phase_zero.ok_or(Inadmissible::Misses(NamedStop::of(system, pattern.closing_stop())))
    }
}

/// Whether two stops face each other without room between them.
fn leaves_no_room(own: &Face, opposite: &Face) -> bool {
    let [own_length, opposite_length] = [own, opposite].map(|face| face.direction.norm());
    let gaps = [own.gap / own_length, opposite.gap / opposite_length];
    let facing = || &own.direction / own_length + &opposite.direction / opposite_length;
    leave_no_room(gaps) && facing().amax() <= 1e-12
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
