//! The equations of a branch of motions, and of a bifurcation curve.

use nalgebra::{DMatrix, DVector};

use super::chain::Chain;
use super::condition::{Kind, test_function};
use super::path::{Equations, differences, differences_of_each};
use super::seeds::Seed;
use super::touch::grazing;
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
        let own = derivative(&flow, &arcs(&flow, &self.0.pattern, &sections), &self.0.pattern);
        let by_parameters = differences(y, self.0.parameters_at()..y.len(), |y| self.residual(y))?;
        Some(beside(&[own], &by_parameters))
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
        let (pattern, sections) = (&self.unknowns.pattern, self.unknowns.sections(y));
        let values = grazing(flow, pattern, &sections, touch, self.touch_phase(y));
        values.iter().all(|value| value.is_finite()).then(|| DVector::from_row_slice(&values))
    }

    /// The function that vanishes at a smooth bifurcation, of a motion with its arcs.
    fn test(&self, flow: &Flow, arcs: &[Arc]) -> Option<DVector<f64>> {
        let test = test_function(self.kind, &turn_along(flow, &self.unknowns.pattern, arcs)?);
        test.is_finite().then(|| DVector::from_element(1, test))
    }

    /// Its derivatives with respect to the sections.
    fn test_by_sections(&self, flow: &Flow, arcs: &[Arc], y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let mut chain = Chain::new(flow, &self.unknowns.pattern, self.unknowns.sections(y), arcs)?;
        let size = self.unknowns.size();
        differences_of_each(y, 0..self.unknowns.sections_end(), |j, value| {
            let mut section: SectionVector = y.rows(j / size * size, size).into_owned();
            section[j % size] = value;
            let test = test_function(self.kind, &chain.turn_with(j / size, section)?);
            test.is_finite().then(|| DVector::from_element(1, test))
        })
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
        let values = matching.iter().chain(condition.iter()).copied();
        Some(DVector::from_iterator(matching.len() + condition.len(), values))
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let Locus { unknowns, touch, .. } = self;
        let (flow, sections, at) = (unknowns.flow(y)?, unknowns.sections(y), unknowns.parameters_at());
        let arcs = arcs(&flow, &unknowns.pattern, &sections);
        let matching = derivative(&flow, &arcs, &unknowns.pattern);
        // The sections, and the phase of a touch, leave the flow as it is.
        let conditions = match *touch {
            Some(touch) => differences(y, 0..at, |y| self.touching(touch, &flow, y))?,
            None => self.test_by_sections(&flow, &arcs, y)?,
        };
        let by_parameters = differences(y, at..y.len(), |y| self.residual(y))?;
        Some(beside(&[matching, conditions], &by_parameters))
    }
}
