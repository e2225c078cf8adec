//! One arc of a motion: the flight from one impact to the next, and the equations that join the two.

use nalgebra::{Matrix4, Vector4};

use super::flow::{Flow, PHASE, Section, Z_COS, Z_SIN, Z_V1, Z_V2, Z_X1, Z_X2};
use crate::dynamics::Stop;

/// An impact on a motion: where, and the state just after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Node {
    /// The stop.
    pub stop: Stop,
    /// The state just after the impact.
    pub section: Section,
}

/// The equations that join two impacts, linearised.
///
/// Flight from u for a time (φ′ − φ)/ω must arrive at the next stop, and restitution (3) must turn its arrival
/// into u′: four equations R(u, u′) = 0 in the order of [`Section`], the last one being x1 = ±δ.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    /// R.
    pub residual: Vector4<f64>,
    /// ∂R/∂u.
    pub from: Matrix4<f64>,
    /// −∂R/∂φ′ without the −1 on the diagonal: how (−r v1, x2, v2, x1) change with the phase of arrival.
    pub arriving: Vector4<f64>,
}

impl Arc {
    /// The arc between two impacts.
    pub fn between(flow: &Flow, from: &Node, to: &Node) -> Self {
        let start = flow.lifted(from.stop, &from.section);
        let time = (to.section[PHASE] - from.section[PHASE]) / flow.omega;
        let over = flow.over(time);
        let arrival = over * start;
        let rate = flow.generator * arrival / flow.omega;
        let seen = |z: &nalgebra::Vector6<f64>| Vector4::new(-flow.r * z[Z_V1], z[Z_X2], z[Z_V2], z[Z_X1]);
        let mut turned = nalgebra::Vector6::zeros();
        turned[Z_SIN] = start[Z_COS];
        turned[Z_COS] = -start[Z_SIN];
        let column = |j: usize| seen(&over.column(j).into_owned());
        let target =
            Vector4::new(to.section[0], to.section[1], to.section[2], to.stop.side::<f64>() * flow.delta);
        Arc {
            residual: seen(&arrival) - target,
            from: Matrix4::from_columns(&[
                column(Z_V1),
                column(Z_X2),
                column(Z_V2),
                seen(&(over * turned - rate)),
            ]),
            arriving: seen(&rate),
        }
    }

    /// ∂R/∂u′.
    pub fn to(&self) -> Matrix4<f64> {
        let mut to = -Matrix4::from_diagonal(&Vector4::new(1.0, 1.0, 1.0, 0.0));
        to.set_column(PHASE, &self.arriving);
        to
    }

    /// v1−/ω, the rate at which the stop is reached.
    pub fn approach(&self) -> f64 {
        self.arriving[PHASE]
    }

    /// The Jacobian ∂u′/∂u of the impact map from this impact to the next, Eqs. (A.1)–(A.6): the arrival shifts by
    /// −(∂x1/∂u)/(∂x1/∂φ′), and everything else with it.
    ///
    /// None where the next impact is a grazing one, v1− = 0: the map is not differentiable there.
    pub fn jacobian(&self) -> Option<Matrix4<f64>> {
        let approach = self.approach();
        let shift = -self.from.row(PHASE) / approach;
        if !shift.iter().all(|value| value.is_finite()) {
            return None;
        }
        let mut jacobian = self.from + self.arriving * shift;
        jacobian.set_row(PHASE, &shift);
        Some(jacobian)
    }
}
