//! The point on σ that control aims at.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use super::error::ControlError;
use crate::control::section::into_turn;
use crate::control::surface::section_names;
use crate::control::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::System;
use crate::system::{Mirror, Plant};
use crate::theory::symmetric_target;

/// A target on σ: the physical 1-1-1 symmetric motion at a reference frequency, or what is given instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// ω of the 1-1-1 motion; everything else is as in the controlled system.
    pub reference: f64,
    /// The components of X (v1+, x2, v2 and τ on the paper's section) where they are given.
    pub given: SectionValues<Option<f64>>,
}

impl Target {
    /// The target's components on the section of a stop of a system; those not in `needed` are 0 if they are not given.
    ///
    /// # Errors
    /// [`ControlError::TargetNeeded`] and [`ControlError::NoTarget`] where a component is to be that of a motion that is
    /// not known or does not exist, [`ControlError::TargetVelocity`] where the target leads into the stop, and
    /// [`ControlError::Count`] for another number of components than the section has.
    pub fn resolve(
        &self,
        system: &System,
        stop: Stop,
        needed: &[usize],
    ) -> Result<SectionValues<f64>, ControlError> {
        let plant = system.plant();
        let given = self.given_on(plant, stop)?;
        check_velocity(plant, stop, &given)?;
        if needed.iter().all(|&i| given[i].is_some()) {
            return Ok(given.map(|value| value.unwrap_or(0.0)));
        }
        let mut components = self.reference_motion(system, stop)?;
        for (component, given) in components.iter_mut().zip(given.iter()) {
            *component = given.unwrap_or(*component);
        }
        Ok(components)
    }

    /// What is given, a value or none for each component of the section.
    fn given_on(&self, plant: &Plant, stop: Stop) -> Result<SectionValues<Option<f64>>, ControlError> {
        let wanted = 2 * plant.n;
        if self.given.len() == wanted {
            return Ok(self.given);
        }
        if self.given.iter().any(Option::is_some) {
            let names = section_names(plant, stop).join(", ");
            return Err(ControlError::Count { what: "target", given: self.given.len(), wanted, names });
        }
        Ok(SectionValues::from_slice(&vec![None; wanted]).expect("a plant has 1 to 4 coordinates"))
    }

    /// The point of the 1-1-1 motion at the reference frequency.
    fn reference_motion(&self, system: &System, stop: Stop) -> Result<SectionValues<f64>, ControlError> {
        let plant = system.plant();
        let needed = || ControlError::TargetNeeded { names: section_names(plant, stop).join(", ") };
        plant.mirror().filter(|mirror| is_in_closed_form(plant, mirror)).ok_or_else(needed)?;
        let missing = ControlError::NoTarget { omega: self.reference, gap: plant.stops[0].gap };
        let target = symmetric_target(&system.at_frequency(self.reference)?).ok_or(missing)?;
        let [v1, x2, v2, tau] = target.try_into().map_err(|_| needed())?;
        Ok(SectionValues::new(if stop == Stop::A {
            [v1, x2, v2, tau]
        } else {
            // Half its period later the motion is its own mirror image.
            [-v1, -x2, -v2, into_turn(tau + PI)]
        }))
    }

    pub(super) fn check(&self) -> Result<(), ControlError> {
        if let Some(&value) = self.given.iter().flatten().find(|value| !value.is_finite()) {
            return Err(ControlError::TargetNotFinite(value));
        }
        if let Some(tau) = self.given.last().copied().flatten().filter(|tau| !(0.0..TAU).contains(tau)) {
            return Err(ControlError::TargetPhase(tau));
        }
        if !(self.reference > 0.0 && self.reference.is_finite()) {
            return Err(ControlError::Reference(self.reference));
        }
        Ok(())
    }
}

/// Refuses a velocity that leads into the stop of the section, where it can be told from what is given.
fn check_velocity(plant: &Plant, stop: Stop, given: &SectionValues<Option<f64>>) -> Result<(), ControlError> {
    let names = section_names(plant, stop);
    let direction = &plant.stops[stop.index()].direction;
    let mut into = 0.0;
    for (i, share) in direction.iter().enumerate().filter(|(_, share)| **share != 0.0) {
        let velocity = [format!("v{}+", i + 1), format!("v{}", i + 1)];
        let place = names.iter().position(|name| velocity.contains(name));
        let Some(velocity) = place.and_then(|place| given[place]) else { return Ok(()) };
        into += share * velocity;
    }
    match given[0] {
        Some(velocity) if into > 0.0 => {
            Err(ControlError::TargetVelocity { name: names[0].clone(), velocity })
        }
        _ => Ok(()),
    }
}

/// Whether the 1-1-1 motion of a plant is known in closed form: two coordinates, driven in the phase of the sine, the first
/// of them between two stops.
fn is_in_closed_form(plant: &Plant, mirror: &Mirror) -> bool {
    let turned_back = (0..plant.n).all(|i| mirror.matrix[(i, i)] == -1.0);
    let first = plant.stops.first().is_some_and(|stop| stop.direction.as_slice() == [1.0, 0.0]);
    let unloaded = plant.force_cos.amax() == 0.0 && plant.load.amax() == 0.0;
    plant.n == 2 && turned_back && first && plant.stops.len() == 2 && unloaded
}
