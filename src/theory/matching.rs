//! One arc of a motion: the flight from one impact to the next, and the equations that join the two.

use nalgebra::{DMatrix, DVector, RowDVector};

use super::flow::Flow;
use super::joined::Joined;
use super::section_vector::{Node, phase};

/// R of [`Arc`] alone: how far from one impact the flight from another ends.
pub(crate) fn residual(flow: &Flow, from: &Node, to: &Node) -> DVector<f64> {
    let (start, time) = departure(flow, from, to);
    missed(flow, to, &flow.face(to.stop).restituted * (&*flow.over(time) * start))
}

/// z just after an impact, and the time to another.
pub(super) fn departure(flow: &Flow, from: &Node, to: &Node) -> (DVector<f64>, f64) {
    let time = (phase(&to.section) - phase(&from.section)) / flow.omega;
    (flow.lifted(from.stop, &from.section), time)
}

/// What is left of an arrival, d·x in place of its phase, without the impact that is due.
fn missed(flow: &Flow, due: &Node, mut arrival: DVector<f64>) -> DVector<f64> {
    let last = arrival.len() - 1;
    let along = arrival[last];
    arrival -= &due.section;
    arrival[last] = along - flow.face(due.stop).gap;
    arrival
}

/// The equations that join two impacts, linearised.
///
/// Flight from u for a time (φ′ − φ)/ω must arrive at the next stop, and the law of impact must turn its arrival
/// into u′: 2n equations R(u, u′) = 0 in the order of [`SectionVector`](super::SectionVector), the last one being d·x = gap.
#[derive(Clone, Debug)]
pub(crate) struct Arc {
    /// R.
    pub residual: DVector<f64>,
    /// ∂R/∂u.
    pub from: DMatrix<f64>,
    /// ∂R/∂φ′: how the section after the impact, with d·x in place of the phase, changes with the phase of arrival.
    pub arriving: DVector<f64>,
    /// [`Joined::section`] over its time.
    pub(super) section: DMatrix<f64>,
}

impl Arc {
    /// The arc between two impacts.
    pub fn between(flow: &Flow, from: &Node, to: &Node) -> Self {
        let (start, time) = departure(flow, from, to);
        let Joined { section, lifted } = flow.joined([from.stop, to.stop], time).into_owned();
        Arc::along(flow, &start, to, section, lifted)
    }

    /// The arc over the same time between two impacts at the same stops, where these have other gaps and all else is as it was.
    pub fn with_gaps_of(&self, flow: &Flow, from: &Node, to: &Node) -> Self {
        let (start, _) = departure(flow, from, to);
        Arc::along(flow, &start, to, self.section.clone(), self.from.clone())
    }

    /// The arc from z just after an impact, with what joins the two; the last column of `lifted` says nothing.
    fn along(
        flow: &Flow,
        start: &DVector<f64>,
        to: &Node,
        section: DMatrix<f64>,
        lifted: DMatrix<f64>,
    ) -> Self {
        let residual = missed(flow, to, &section * start);
        // Flight of z' is z' of flight.
        let arriving = &section * (flow.generator() * start) / flow.omega;
        let mut from = lifted;
        let last = from.ncols() - 1;
        from.set_column(last, &(&section * flow.turned(start) - &arriving));
        Arc { residual, from, arriving, section }
    }

    /// ∂R/∂u′.
    pub fn to(&self) -> DMatrix<f64> {
        let size = self.residual.len();
        let mut to = -DMatrix::identity(size, size);
        to.set_column(size - 1, &self.arriving);
        to
    }

    /// d·v−/ω, the rate at which the stop is reached.
    pub fn approach(&self) -> f64 {
        self.arriving[self.arriving.len() - 1]
    }

    /// The Jacobian ∂u′/∂u of the impact map from this impact to the next, Eqs. (A.1)–(A.6): the arrival shifts by
    /// −(∂(d·x)/∂u)/(∂(d·x)/∂φ′), and everything else with it.
    ///
    /// None where the next impact is a grazing one, d·v− = 0: the map is not differentiable there.
    pub fn jacobian(&self) -> Option<DMatrix<f64>> {
        let shift = self.shift()?;
        let mut jacobian = &self.from + &self.arriving * &shift;
        jacobian.set_row(self.residual.len() - 1, &shift);
        Some(jacobian)
    }

    /// By how much the phase of arrival shifts.
    pub(super) fn shift(&self) -> Option<RowDVector<f64>> {
        let shift = -self.from.row(self.residual.len() - 1) / self.approach();
        shift.iter().all(|value| value.is_finite()).then_some(shift)
    }
}
