//! The impact map of section 4, with its Jacobian.

use nalgebra::DMatrix;
use thiserror::Error;

use super::flow::Flow;
use super::follower::follower;
use super::matching::Arc;
use super::section_vector::{Node, SectionVector, phase, wrapped};
use crate::dynamics::{Event, Stop};
use crate::model::System;

/// Forcing periods after which a trajectory is taken not to return.
const LONGEST: u32 = 1000;
/// Impacts on the way after which it is given up.
const MOST_IMPACTS: usize = 1 << 14;
/// How far beyond another stop a section may lie, relative to numbers of order one.
const BEYOND: f64 = 1e-12;

/// One iterate of the impact map: from just after an impact at a stop to just after the next one there.
#[derive(Clone, Debug, PartialEq)]
pub struct Return {
    /// Where it returns, (v1+, x2, v2, τ) of the paper's oscillator, with τ not reduced, so that the time taken is
    /// (τ′ − τ)/ω. Non-dimensional.
    pub section: Vec<f64>,
    /// The impacts on the way, the last one included.
    pub impacts: Vec<Node>,
    /// ∂X′/∂X, Eqs. (A.1)–(A.6), the product over the impacts on the way; none where one of them grazes.
    pub jacobian: Option<DMatrix<f64>>,
}

/// Why a trajectory does not return to the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NoReturn {
    /// The section is left outwards, lies beyond another stop, or is not made of so many finite numbers.
    #[error(
        "not on the section: the stop must be left inwards (v1+ ≤ 0 at the paper's A), the other stops kept, and every \
         component finite"
    )]
    NotOnSection,
    /// A mass comes to rest on a stop first, so that the map has no Jacobian of full meaning.
    #[error("a mass sticks to stop {0} on the way")]
    Sticks(Stop),
    /// No impact there within a thousand forcing periods.
    #[error("no impact at stop {0} follows within {LONGEST} forcing periods")]
    Never(Stop),
    /// Rebounds elsewhere that accumulate without end, or a state that is no longer finite, before an impact there.
    #[error(
        "the trajectory from stop {0} makes no headway: impacts elsewhere accumulate without end, or it diverges"
    )]
    NoHeadway(Stop),
}

/// The impact map at the first stop, the paper's σ→σ; see [`impact_map_at`].
///
/// # Errors
/// As [`impact_map_at`].
///
/// # Panics
/// If the section has not 2n components.
pub fn impact_map(system: &System, section: impl AsRef<[f64]>) -> Result<Return, NoReturn> {
    impact_map_at(system, Stop(0), section)
}

/// Follows a trajectory from the section at a stop, just after an impact there, until it returns there.
///
/// The section has 2n components, named by [`section_names`](super::section_names): (v1+, x2, v2, τ) of the paper's
/// oscillator.
///
/// # Errors
/// [`NoReturn`] where there is no next impact at the stop, or where sticking comes between.
///
/// # Panics
/// If the system has no such stop, or the section has not 2n components.
pub fn impact_map_at(system: &System, stop: Stop, section: impl AsRef<[f64]>) -> Result<Return, NoReturn> {
    let flow = Flow::new(system);
    let n = flow.n;
    let start = SectionVector::from_column_slice(section.as_ref());
    if start.len() != 2 * n || !start.iter().all(|value| value.is_finite()) {
        return Err(NoReturn::NotOnSection);
    }
    let z = flow.lifted(stop, &start);
    let unit = flow.unit();
    let size = z.rows(0, 2 * n).amax().max(unit);
    let beyond = |(other, face): (Stop, &super::face::Face)| {
        let scale = BEYOND * (unit + face.gap.abs() + size * face.direction.amax());
        other != stop && face.along(&z)[0] > face.gap + scale
    };
    if flow.face(stop).is_left_outwards(&start) || flow.faces().any(beyond) {
        return Err(NoReturn::NotOnSection);
    }
    let mut follower = follower(system);
    follower.begin_at(z.rows(0, n).as_slice(), z.rows(n, n).as_slice(), wrapped(phase(&start)));
    let begins = phase(&start);
    let mut from = Node { stop, section: start };
    let mut impacts = Vec::new();
    let mut jacobian = Some(DMatrix::identity(2 * n, 2 * n));
    let mut elapsed = 0.0;
    while elapsed < f64::from(LONGEST) * system.period() {
        // All of them are kept: many fewer than a trajectory may make.
        if impacts.len() > MOST_IMPACTS || !follower.is_finite() {
            return Err(NoReturn::NoHeadway(stop));
        }
        let taken = follower.advance();
        elapsed += taken.time;
        let impact = match taken.event {
            Event::Impact(impact) => impact,
            Event::Caught { impact, .. } => return Err(NoReturn::Sticks(impact.stop)),
            _ => continue,
        };
        let section =
            flow.face(impact.stop).section(follower.x(), follower.v(), begins + flow.omega * elapsed);
        let node = Node { stop: impact.stop, section };
        jacobian = jacobian.and_then(|so_far| Some(Arc::between(&flow, &from, &node).jacobian()? * so_far));
        impacts.push(node.clone());
        from = node;
        if impact.stop == stop {
            return Ok(Return { section: from.section.as_slice().to_vec(), impacts, jacobian });
        }
    }
    Err(NoReturn::Never(stop))
}
