//! The equations of a branch of motions, and of a bifurcation curve.

use nalgebra::{DMatrix, DVector};

use super::chain::Chain;
use super::condition::{Kind, test_function, test_of_motion};
use super::path::{Equations, differences, differences_of_each};
use super::seeds::Seed;
use super::touch::grazing;
use super::unknowns::Unknowns;
use crate::dynamics::Stop;
use crate::theory::{Flow, PeriodicMotion, SectionVector};

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
        self.0.matching(y)
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        self.0.matching_derivative(y)
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
    fn condition(&self, y: &DVector<f64>) -> Option<DVector<f64>> {
        let flow = Flow::new(&self.unknowns.system(y)?);
        let sections = self.unknowns.sections(y);
        let pattern = &self.unknowns.pattern;
        let values = match self.touch {
            Some(touch) => grazing(&flow, pattern, &sections, touch, self.touch_phase(y)).to_vec(),
            None => vec![test_of_motion(self.kind, &flow, pattern, &sections)?],
        };
        values.iter().all(|value| value.is_finite()).then(|| DVector::from_vec(values))
    }

    /// The derivatives of a smooth bifurcation's condition with respect to the sections.
    fn test_by_sections(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let flow = Flow::new(&self.unknowns.system(y)?);
        let mut chain = Chain::new(&flow, &self.unknowns.pattern, self.unknowns.sections(y))?;
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
        let matching = self.unknowns.matching(y)?;
        let condition = self.condition(y)?;
        let values = matching.iter().chain(condition.iter()).copied();
        Some(DVector::from_iterator(matching.len() + condition.len(), values))
    }

    fn jacobian(&self, y: &DVector<f64>) -> Option<DMatrix<f64>> {
        let matching = self.unknowns.matching_derivative(y)?;
        let sections = self.unknowns.sections_end();
        let by_sections = match self.touch {
            Some(_) => differences(y, 0..sections, |y| self.condition(y))?,
            None => self.test_by_sections(y)?,
        };
        let by_others = differences(y, sections..y.len(), |y| self.condition(y))?;
        let conditions = by_others.nrows();
        let mut all = DMatrix::zeros(matching.nrows() + conditions, y.len());
        all.rows_mut(0, matching.nrows()).copy_from(&matching);
        all.view_mut((matching.nrows(), 0), (conditions, sections)).copy_from(&by_sections);
        all.view_mut((matching.nrows(), sections), (conditions, y.len() - sections)).copy_from(&by_others);
        Some(all)
    }
}
