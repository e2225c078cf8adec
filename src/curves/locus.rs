//! The equations of a branch of motions, and of a bifurcation curve.

use nalgebra::{DMatrix, DVector};

use super::chain::Chain;
use super::condition::{Kind, test_by_entries, test_function};
use super::path::{Equations, differences};
use super::seeds::Seed;
use super::touch::Grazing;
use super::unknowns::{Known, Unknowns};
use crate::dynamics::Stop;
use crate::theory::newton::residual;
use crate::theory::{Arc, Cyclic, Flow, PeriodicMotion, SectionVector, in_units, turn_along};

/// A motion in one parameter: the matching equations alone.
pub(super) struct Branch(pub Unknowns);

impl Branch {
    /// The motion at a point.
    pub fn seed(&self, y: &DVector<f64>) -> Seed {
        let pattern = self.0.pattern.clone();
        let motion = PeriodicMotion { pattern, sections: self.0.sections(y), residual: 0.0 };
        Seed { parameters: self.0.parameters(y), motion }
    }

    /// Residuals, with what is known of the same sections at other parameters.
    fn residual_by(&self, y: &DVector<f64>, known: Option<Known<'_>>) -> Option<DVector<f64>> {
        let (flow, sections) = (self.0.flow(y)?, self.0.sections(y));
        self.0.matched(&sections, self.0.residual(&flow, &sections, known))
    }
}

impl Equations for Branch {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        self.residual_by(y, None)
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<Cyclic> {
        let (flow, sections, at) = (self.0.flow(y)?, self.0.sections(y), self.0.parameters_at());
        let arcs = self.0.arcs(&flow, &sections, None);
        let known = Known { flow: &flow, arcs: &arcs };
        let common = differences(y, at..y.len(), |y| self.residual_by(y, Some(known)))?;
        let joints = self.0.joints(&flow, &arcs);
        Some(Cyclic { joints, common, others: DMatrix::zeros(0, y.len()) })
    }
}

/// A bifurcation in two parameters: the matching equations and what defines the bifurcation.
///
/// Grazing has the phase of the touch as one more unknown.
#[derive(Clone, Debug)]
pub(super) struct Locus {
    pub unknowns: Unknowns,
    pub kind: Kind,
    /// The arc and the stop that is touched, for grazing.
    pub touch: Option<(usize, Stop)>,
}

impl Locus {
    /// The motion where it may touch a stop.
    fn grazing<'a>(
        &self,
        touch: (usize, Stop),
        flow: &'a Flow,
        sections: &[SectionVector],
        y: &DVector<f64>,
    ) -> Grazing<'a> {
        Grazing::new(flow, &self.unknowns.pattern, sections, touch, self.touch_phase(y))
    }

    /// The derivatives of what defines grazing by the sections and the phase of the touch.
    fn grazing_by_sections(&self, arc: usize, grazing: &Grazing<'_>) -> DMatrix<f64> {
        let by_section = grazing.by_section();
        let (conditions, size) = by_section.shape();
        let mut all = DMatrix::zeros(conditions, self.unknowns.parameters_at());
        all.columns_mut(arc * size, size).copy_from(&self.unknowns.by_sections(by_section));
        all.set_column(self.unknowns.sections_end(), &self.unknowns.left(grazing.by_phase()));
        all
    }

    /// The function that vanishes at a smooth bifurcation, of a motion with its arcs.
    fn test(&self, flow: &Flow, arcs: &[Arc]) -> Option<DVector<f64>> {
        let turn = in_units(turn_along(flow, &self.unknowns.pattern, arcs)?, self.unknowns.unit);
        let test = test_function(self.kind, &turn);
        test.is_finite().then(|| DVector::from_element(1, test))
    }

    /// Its derivatives by the sections.
    fn test_by_sections(
        &self,
        flow: &Flow,
        sections: &[SectionVector],
        arcs: &[Arc],
    ) -> Option<DMatrix<f64>> {
        let pattern = &self.unknowns.pattern;
        let chain = Chain::new(flow, pattern, sections, arcs)?;
        let unit = self.unknowns.unit;
        let by_entries = test_by_entries(self.kind, &in_units(chain.turn().clone(), unit))?;
        let by_sections = chain.by_sections(&in_units(by_entries, unit))?;
        let by_sections = DMatrix::from_row_slice(1, by_sections.len(), by_sections.as_slice());
        // A number that has no unit, by displacements and velocities that have one.
        Some(self.unknowns.by_sections(by_sections * unit))
    }

    /// Residuals, with what is known of the same sections at other parameters.
    fn residual_by(&self, y: &DVector<f64>, known: Option<Known<'_>>) -> Option<DVector<f64>> {
        let unknowns = &self.unknowns;
        let (flow, sections) = (unknowns.flow(y)?, unknowns.sections(y));
        let (residual, condition) = match self.touch {
            Some(touch) => {
                let grazing = self.grazing(touch, &flow, &sections, y);
                (unknowns.residual(&flow, &sections, known), unknowns.left(grazing.values()?))
            }
            None => {
                let arcs = unknowns.arcs(&flow, &sections, known);
                (residual(&arcs), self.test(&flow, &arcs)?)
            }
        };
        let matching = unknowns.matched(&sections, residual)?;
        let values = matching.iter().chain(condition.iter()).copied();
        Some(DVector::from_iterator(matching.len() + condition.len(), values))
    }

    /// The phase at which the stop is touched.
    pub fn touch_phase(&self, y: &DVector<f64>) -> f64 {
        y[self.unknowns.sections_end()]
    }
}

impl Equations for Locus {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        self.residual_by(y, None)
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<Cyclic> {
        let Locus { unknowns, touch, .. } = self;
        let (flow, sections, at) = (unknowns.flow(y)?, unknowns.sections(y), unknowns.parameters_at());
        let arcs = unknowns.arcs(&flow, &sections, None);
        // The sections, and the phase of a touch, leave the flow as it is.
        let conditions = match *touch {
            Some(touch) => self.grazing_by_sections(touch.0, &self.grazing(touch, &flow, &sections, y)),
            None => self.test_by_sections(&flow, &sections, &arcs)?,
        };
        let known = Known { flow: &flow, arcs: &arcs };
        let by_parameters = differences(y, at..y.len(), |y| self.residual_by(y, Some(known)))?;
        let end = unknowns.sections_end();
        let mut common = DMatrix::zeros(end, y.len() - end);
        common.columns_mut(at - end, y.len() - at).copy_from(&by_parameters.rows(0, end));
        let mut others = DMatrix::zeros(conditions.nrows(), y.len());
        others.columns_mut(0, at).copy_from(&conditions);
        others.columns_mut(at, y.len() - at).copy_from(&by_parameters.rows(end, conditions.nrows()));
        Some(Cyclic { joints: unknowns.joints(&flow, &arcs), common, others })
    }
}
