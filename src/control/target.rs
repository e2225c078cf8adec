//! The point on σ that control aims at.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::error::ControlError;
use super::option::{Arguments, GivenOptions, MethodOption, OptionKind};
use super::quantity::ControlQuantity;
use super::site::{Site, words};
use super::surface::section_names;
use super::values::SectionValues;
use crate::dynamics::Stop;
use crate::model::{Number, System};
use crate::system::{Mirror, Plant};
use crate::theory::symmetric_target_at;

/// A target on σ: the physical 1-1-1 symmetric motion at a reference frequency, or what is given instead.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Target {
    /// ω of the 1-1-1 motion; everything else is as in the controlled system.
    pub reference: f64,
    /// The components of X (v1+, x2, v2 and τ on the paper's section) where they are given.
    pub given: SectionValues<Option<f64>>,
    /// The coordinate, from 0, whose velocity is the first of them: that which the stop's gap determines.
    #[serde(default, skip_serializing_if = "is_first")]
    pub own: usize,
}

/// The options of a target.
pub const TARGET_OPTIONS: [MethodOption; 2] = [
    MethodOption::new(
        OptionKind::Number,
        ["reference", "OMEGA"],
        "the forcing frequency at which the symmetric 1-1-1 motion is the target [default: 3.7 for the paper's oscillator, the \
         system's own frequency for others]",
    ),
    MethodOption::new(
        OptionKind::Numbers,
        ["target", "X0"],
        "the target itself: one number (sine) or one for each component of X (pulse)",
    )
    .instead_of("reference"),
];

/// The frequency of the target motion of the paper's oscillator.
const REFERENCE: f64 = 3.7;

#[allow(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_first(own: &usize) -> bool {
    *own == 0
}

impl Target {
    /// The target that options give, from so many numbers or from a reference motion; a single number comes first.
    pub(super) fn given(options: &GivenOptions, site: &Site, count: usize) -> Result<Self, ControlError> {
        let own = if site.family.is_paper() { REFERENCE } else { site.plant.omega };
        let reference = options.number("reference", own);
        let none = vec![None; site.components()];
        let mut given = SectionValues::from_slice(&none).expect("a section has 2 to 8 components");
        if let Some(values) = options.numbers("target") {
            if values.len() != count {
                let wanted = match count {
                    1 => "one, for --component".to_owned(),
                    count => format!("{}, for {}", words(count), site.listed()),
                };
                let numbers =
                    if values.len() == 1 { "1 number" } else { &format!("{} numbers", values.len()) };
                return Err(ControlError::Option(format!("--target has {numbers}: give {wanted}")));
            }
            given.iter_mut().zip(values).for_each(|(given, value)| *given = Some(*value));
        }
        Ok(Target { reference, given, own: site.plant.stops[site.stop.index()].own_coordinate() })
    }

    /// The options that make some of its components again.
    pub(super) fn write(&self, components: &[usize], to: &mut Arguments) {
        let values: Option<Vec<String>> =
            components.iter().map(|&i| self.given[i].map(|value| Number(value).to_string())).collect();
        match values {
            Some(values) => to.value("target", &values.join(",")),
            None => to.value("reference", &Number(self.reference).to_string()),
        }
    }

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
        let mut components = self.reference_motion(system, stop, needed)?;
        for (component, given) in components.iter_mut().zip(given.iter()) {
            *component = given.unwrap_or(*component);
        }
        Ok(components)
    }

    /// What is given, a value or none for each component of the section.
    fn given_on(&self, plant: &Plant, stop: Stop) -> Result<SectionValues<Option<f64>>, ControlError> {
        let wanted = 2 * plant.n;
        if self.given.iter().all(Option::is_none) {
            return Ok(
                SectionValues::from_slice(&vec![None; wanted]).expect("a plant has 1 to 4 coordinates")
            );
        }
        let names = section_names(plant, stop).join(", ");
        if self.given.len() != wanted {
            return Err(ControlError::Count { what: "target", given: self.given.len(), wanted, names });
        }
        if plant.stops[stop.index()].own_coordinate() != self.own {
            return Err(ControlError::OtherComponents { own: self.own + 1, names });
        }
        Ok(self.given)
    }

    /// The point of the 1-1-1 motion at the reference frequency; some of its components are needed.
    fn reference_motion(
        &self,
        system: &System,
        stop: Stop,
        needed: &[usize],
    ) -> Result<SectionValues<f64>, ControlError> {
        let plant = system.plant();
        let names = section_names(plant, stop);
        let names: Vec<&str> = needed.iter().map(|&i| names[i].as_ref()).collect();
        let needed = || ControlError::TargetNeeded(names.join(", "));
        let exchanged = |mirror: &Mirror| is_met(mirror, stop);
        plant.mirror().filter(exchanged).ok_or_else(needed)?;
        let missing = ControlError::NoTarget { omega: self.reference, gap: plant.stops[stop.index()].gap };
        let target = symmetric_target_at(&system.at_frequency(self.reference)?, stop).ok_or(missing)?;
        SectionValues::from_slice(&target).ok_or_else(needed)
    }

    /// Which component a setting is.
    pub(super) fn component(&self, setting: ControlQuantity) -> Option<usize> {
        setting.component(self.given.len() / 2, self.own)
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

/// Whether the symmetric 1-1-1 motion meets a stop: it goes between the first two that the mirror exchanges.
fn is_met(mirror: &Mirror, stop: Stop) -> bool {
    let first = mirror.stops.iter().enumerate().find(|(stop, image)| stop != *image);
    first.is_some_and(|(first, &image)| [first, image].contains(&stop.index()))
}
