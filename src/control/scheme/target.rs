//! The point on σ that control aims at.

use serde::{Deserialize, Serialize};

use super::error::ControlError;
use crate::model::{Parameter, Parameters, System};
use crate::system::Family;
use crate::theory::symmetric_target;

/// A target on σ: the physical 1-1-1 symmetric motion at a reference frequency, or what is given instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// ω of the 1-1-1 motion; the other parameters are those of the controlled system.
    pub reference: f64,
    /// v1+, x2, v2 and τ where they are given.
    pub given: [Option<f64>; 4],
}

impl Target {
    /// The target's components (v1+, x2, v2, τ) for a system.
    ///
    /// # Errors
    /// [`ControlError::NoTarget`] where a component is to be that of a motion that does not exist.
    pub fn resolve(&self, system: &System, needed: &[usize]) -> Result<[f64; 4], ControlError> {
        let mut components = self.given.map(|value| value.unwrap_or(0.0));
        if needed.iter().any(|&i| self.given[i].is_none()) {
            let parameters = Parameters { omega: self.reference, ..system.parameters() };
            let missing = ControlError::NoTarget { omega: self.reference, delta: parameters.delta };
            let found = symmetric_target(&System::new(parameters)?).ok_or(missing)?;
            for (i, value) in found.into_iter().enumerate() {
                components[i] = self.given[i].unwrap_or(value);
            }
        }
        Ok(components)
    }

    pub(super) fn check(&self) -> Result<(), ControlError> {
        let [v1, .., tau] = self.given;
        if let Some(value) = self.given.into_iter().flatten().find(|value| !value.is_finite()) {
            return Err(ControlError::TargetNotFinite(value));
        }
        if let Some(v1) = v1.filter(|&v1| v1 > 0.0) {
            return Err(ControlError::TargetVelocity(v1));
        }
        if let Some(tau) = tau.filter(|tau| !(0.0..std::f64::consts::TAU).contains(tau)) {
            return Err(ControlError::TargetPhase(tau));
        }
        let omega = Parameter::of(Family::paper(), "omega").expect("the paper's oscillator is forced");
        omega.check(self.reference).map_err(ControlError::Reference)
    }
}
