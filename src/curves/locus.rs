//! The equations of a branch of motions, and of a bifurcation curve.

use nalgebra::{DMatrix, DVector};

use super::chain::Chain;
use super::condensed::Chained;
use super::condition::{Kind, test_by_entries, test_function};
use super::path::{Equations, differences};
use super::seeds::Seed;
use super::touch::{grazing, grazing_by_section};
use super::unknowns::Unknowns;
use crate::dynamics::Stop;
use crate::theory::newton::{arcs, derivative, residual};
use crate::theory::{Arc, Flow, PeriodicMotion, SectionVector, turn_along};

/// A motion in one parameter: the matching equations alone.
pub(super) struct Branch(pub Unknowns);

impl Branch {
    /// The motion at a point.
    pub fn seed(&self, y: &DVector<f64>) -> Seed {
        let pattern = self.0.pattern.clone();
        let motion = PeriodicMotion { pattern, sections: self.0.sections(y), residual: 0.0 };
        Seed { parameters: self.0.parameters(y), motion }
    }
}

impl Equations for Branch {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        self.0.matching(&self.0.flow(y)?, &self.0.sections(y))
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let (flow, sections) = (self.0.flow(y)?, self.0.sections(y));
        let arcs = arcs(&flow, &self.0.pattern, &sections);
        let own = derivative(&flow, &arcs, &self.0.pattern);
        let beside_it = |y: &DVector<f64>| Some(self.0.matching_beside(y, &flow, &arcs)?.1);
        let by_parameters = differences(y, self.0.parameters_at()..y.len(), beside_it)?;
        Some(beside(&[own], &by_parameters))
    }

    fn chained(&self) -> Chained {
        self.0.chained()
    }
}

/// Derivatives of some equations by what the parameters leave as it is, from top to bottom, beside those of all by the parameters.
fn beside(own: &[DMatrix<f64>], by_parameters: &DMatrix<f64>) -> DMatrix<f64> {
    let at = own.iter().map(DMatrix::ncols).max().unwrap_or(0);
    let mut all = DMatrix::zeros(by_parameters.nrows(), at + by_parameters.ncols());
    let mut row = 0;
    for rows in own {
        all.view_mut((row, 0), rows.shape()).copy_from(rows);
        row += rows.nrows();
    }
    all.columns_mut(at, by_parameters.ncols()).copy_from(by_parameters);
    all
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
    /// How far beyond the stop the motion is where it touches it, and how fast it moves into it.
    fn touching(&self, touch: (usize, Stop), flow: &Flow, y: &DVector<f64>) -> Option<DVector<f64>> {
        let values =
            grazing(flow, &self.unknowns.pattern, &self.unknowns.sections(y), touch, self.touch_phase(y));
        values.iter().all(|value| value.is_finite()).then(|| DVector::from_row_slice(&values))
    }

    /// Their derivatives by the sections and the phase of the touch.
    fn touching_by_sections(&self, touch: (usize, Stop), flow: &Flow, y: &DVector<f64>) -> DMatrix<f64> {
        let Unknowns { pattern, .. } = &self.unknowns;
        let (by_section, by_phase) =
            grazing_by_section(flow, pattern, &self.unknowns.sections(y), touch, self.touch_phase(y));
        let mut all = DMatrix::zeros(by_section.nrows(), self.unknowns.parameters_at());
        all.columns_mut(touch.0 * by_section.ncols(), by_section.ncols()).copy_from(&by_section);
        all.set_column(self.unknowns.sections_end(), &by_phase);
        all
    }

    /// The function that vanishes at a smooth bifurcation, of a motion with its arcs.
    fn test(&self, flow: &Flow, arcs: &[Arc]) -> Option<DVector<f64>> {
        let test = test_function(self.kind, &turn_along(flow, &self.unknowns.pattern, arcs)?);
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
        let chain = Chain::new(flow, pattern, arcs)?;
        let by_entries = test_by_entries(self.kind, chain.turn())?;
        let by_sections = chain.by_sections(flow, pattern, sections, &by_entries)?;
        Some(DMatrix::from_row_slice(1, by_sections.len(), by_sections.as_slice()))
    }

    /// The matching equations, and what defines the bifurcation.
    fn together(matching: &DVector<f64>, condition: &DVector<f64>) -> DVector<f64> {
        let values = matching.iter().chain(condition.iter()).copied();
        DVector::from_iterator(matching.len() + condition.len(), values)
    }

    /// The residuals of the same sections at other parameters; with the flow here and the arcs.
    fn residual_beside(&self, y: &DVector<f64>, here: &Flow, arcs: &[Arc]) -> Option<DVector<f64>> {
        let unknowns = &self.unknowns;
        let Some(touch) = self.touch else {
            let (flow, arcs) = unknowns.arcs_beside(y, here, arcs)?;
            let matching = unknowns.matched(&unknowns.sections(y), residual(&arcs))?;
            return Some(Locus::together(&matching, &self.test(&flow, &arcs)?));
        };
        let (flow, matching) = unknowns.matching_beside(y, here, arcs)?;
        Some(Locus::together(&matching, &self.touching(touch, &flow, y)?))
    }

    /// The phase at which the stop is touched.
    pub fn touch_phase(&self, y: &DVector<f64>) -> f64 {
        y[self.unknowns.sections_end()]
    }
}

impl Equations for Locus {
    fn residual(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        let Locus { unknowns, touch, .. } = self;
        let (flow, sections) = (unknowns.flow(y)?, unknowns.sections(y));
        let (matching, condition) = match *touch {
            Some(touch) => (unknowns.matching(&flow, &sections)?, self.touching(touch, &flow, y)?),
            None => {
                let arcs = arcs(&flow, &unknowns.pattern, &sections);
                (unknowns.matched(&sections, residual(&arcs))?, self.test(&flow, &arcs)?)
            }
        };
        Some(Locus::together(&matching, &condition))
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let Locus { unknowns, touch, .. } = self;
        let (flow, sections, at) = (unknowns.flow(y)?, unknowns.sections(y), unknowns.parameters_at());
        let arcs = arcs(&flow, &unknowns.pattern, &sections);
        let matching = derivative(&flow, &arcs, &unknowns.pattern);
        // The sections, and the phase of a touch, leave the flow as it is.
        let conditions = match *touch {
            Some(touch) => self.touching_by_sections(touch, &flow, y),
            None => self.test_by_sections(&flow, &sections, &arcs)?,
        };
        let by_parameters = differences(y, at..y.len(), |y| self.residual_beside(y, &flow, &arcs))?;
        Some(beside(&[matching, conditions], &by_parameters))
    }

    fn chained(&self) -> Chained {
        self.unknowns.chained()
    }
}
