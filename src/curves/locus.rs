//! The equations of a branch of motions, and of a bifurcation curve.

use nalgebra::{DMatrix, DVector};

use super::condition::{Kind, test_of_motion};
use super::path::{Equations, differences};
use super::touch::grazing;
use super::unknowns::Unknowns;
use crate::dynamics::Stop;
use crate::theory::Flow;

/// A motion in one parameter: the matching equations alone.
pub(super) struct Branch(pub Unknowns);

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

    /// The phase at which the stop is touched.
    pub fn touch_phase(&self, y: &DVector<f64>) -> f64 {
        y[4 * self.unknowns.pattern.stops.len()]
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
        let condition = differences(y, 0..y.len(), |y| self.condition(y))?;
        let mut all = DMatrix::zeros(matching.nrows() + condition.nrows(), y.len());
        all.rows_mut(0, matching.nrows()).copy_from(&matching);
        all.rows_mut(matching.nrows(), condition.nrows()).copy_from(&condition);
        Some(all)
    }
}
