//! The impact map σ→σ of section 4, with its Jacobian.

use nalgebra::Matrix4;
use thiserror::Error;

use super::admissible::wrapped;
use super::flow::{Flow, PHASE, Section, V1_PLUS, V2, X2};
use super::matching::{Arc, Node};
use crate::dynamics::{Event, Stop, Trajectory};
use crate::model::{Flight, State, System};

/// Forcing periods after which a trajectory is taken not to return.
const LONGEST: u32 = 1000;

/// One iterate of the impact map: from just after an impact at A to just after the next one.
#[derive(Clone, Debug, PartialEq)]
pub struct Return {
    /// Where it returns: (v1+, x2, v2, τ) with τ not reduced, so that the time taken is (τ′ − τ)/ω. Non-dimensional.
    pub section: [f64; 4],
    /// The impacts on the way, the last one at A included.
    pub impacts: Vec<Node>,
    /// ∂X′/∂X, Eqs. (A.1)–(A.6), the product over the impacts on the way; none where one of them grazes.
    pub jacobian: Option<Matrix4<f64>>,
}

/// Why a trajectory does not return to the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
pub enum NoReturn {
    /// The section is left outwards, or a component is not finite.
    #[error("not on the section: v1+ must be at most 0, and every component finite")]
    NotOnSection,
    /// The first mass comes to rest on a stop first, so that the map has no Jacobian of full meaning.
    #[error("the first mass sticks to stop {0} on the way")]
    Sticks(Stop),
    /// No impact at A within a thousand forcing periods.
    #[error("no impact at A follows within {LONGEST} forcing periods")]
    Never,
}

/// Follows a trajectory from the section σ, x1 = δ just after an impact at A with (v1+, x2, v2, τ), until it returns
/// there.
///
/// # Errors
/// [`NoReturn`] where there is no next impact at A, or where sticking comes between.
pub fn impact_map(system: &System, section: [f64; 4]) -> Result<Return, NoReturn> {
    let start = Section::from(section);
    if !section.iter().all(|value| value.is_finite()) || start[V1_PLUS] > 0.0 {
        return Err(NoReturn::NotOnSection);
    }
    let flow = Flow::new(system);
    let flight = Flight::<f64, 2>::new(system);
    let state = State { x: [flight.normals[0].gap[0], start[X2]], v: [start[V1_PLUS], start[V2]] };
    let mut trajectory = Trajectory::at_phase(&flight, state, wrapped(start[PHASE]));
    let mut from = Node { stop: Stop::A, section: start };
    let mut impacts = Vec::new();
    let mut jacobian = Some(Matrix4::identity());
    let mut elapsed = 0.0;
    while elapsed < f64::from(LONGEST) * system.period() {
        let taken = trajectory.advance(&flight, &mut ());
        elapsed += taken.time;
        let impact = match taken.event {
            Event::Impact(impact) => impact,
            Event::Caught { impact, .. } => return Err(NoReturn::Sticks(impact.stop)),
            _ => continue,
        };
        let State { x, v } = trajectory.point.state;
        let phase = start[PHASE] + flow.omega * elapsed;
        let node = Node { stop: impact.stop, section: Section::new(v[0], x[1], v[1], phase) };
        jacobian = jacobian.and_then(|so_far| Some(Arc::between(&flow, &from, &node).jacobian()? * so_far));
        impacts.push(node);
        from = node;
        if impact.stop == Stop::A {
            return Ok(Return { section: node.section.into(), impacts, jacobian });
        }
    }
    Err(NoReturn::Never)
}
