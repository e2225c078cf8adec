//! The section on which a control method acts, as the options name it.

use super::error::ControlError;
use super::surface::section_names;
use crate::dynamics::Stop;
use crate::model::Setting;
use crate::system::{Family, Plant};

/// The section on which a method acts.
#[derive(Clone, Debug)]
pub struct Site {
    /// The family of the system.
    pub family: &'static Family,
    /// A system of it.
    pub plant: Plant,
    /// The stop.
    pub stop: Stop,
    /// The components of its points.
    pub names: Vec<String>,
}

impl Site {
    /// The section of the stop of a name, the first where none is given. Of a setting that makes no plant, whose axes
    /// will, the defaults say how the stop stands.
    ///
    /// # Errors
    /// A stop that the system does not have.
    pub fn new(setting: &Setting, name: Option<&str>) -> Result<Self, ControlError> {
        let family = setting.family();
        let stop = match name {
            None => 0,
            Some(name) => family.stop(name).ok_or_else(|| {
                let known: Vec<&str> = family.stops().iter().map(|stop| stop.name.as_str()).collect();
                ControlError::Option(format!(
                    "--stop `{name}`: the system has no such stop; it has {}",
                    known.join(", ")
                ))
            })?,
        };
        let plant = setting
            .plant()
            .or_else(|_| Setting::defaults(family).plant())
            .map_err(|error| ControlError::Option(error.to_string()))?;
        let stop = Stop(stop as u8);
        let names = section_names(&plant, stop);
        Ok(Site { family, plant, stop, names })
    }

    /// How many components a point has.
    pub(super) fn components(&self) -> usize {
        self.names.len()
    }

    /// The components in words, such as v1+, x2, v2 and tau.
    pub(super) fn listed(&self) -> String {
        let (last, others) = self.names.split_last().expect("a section has components");
        format!("{} and {last}", others.join(", "))
    }

    /// The component of a name, τ where none is given; `v_after` is the first.
    pub(super) fn component(&self, name: Option<&str>) -> Result<usize, ControlError> {
        let last = self.components() - 1;
        match name {
            None => Ok(last),
            Some("v_after") => Ok(0),
            Some(name) => {
                let is_it = |own: &String| own == name || own.trim_end_matches('+') == name;
                self.names.iter().position(is_it).ok_or_else(|| {
                    ControlError::Option(format!(
                        "--component `{name}`: a point on the section of stop {} has no such component; it has {}",
                        self.family.stops()[self.stop.index()].name,
                        self.listed()
                    ))
                })
            }
        }
    }

    /// The coordinate of a name, x2 or 2; the first where none is given.
    pub(super) fn coordinate(&self, name: Option<&str>) -> Result<usize, ControlError> {
        let Some(name) = name else { return Ok(0) };
        let all: Vec<String> = (1..=self.plant.n).map(|i| format!("x{i}")).collect();
        all.iter().position(|own| own == name || own[1..] == *name).ok_or_else(|| {
            ControlError::Option(format!(
                "--coordinate `{name}`: the system has no such coordinate; it has {}",
                all.join(", ")
            ))
        })
    }
}

/// A small number in words.
pub(super) fn words(number: usize) -> &'static str {
    ["none", "one", "two", "three", "four", "five", "six", "seven", "eight"][number.min(8)]
}

/// Refuses the number of something that the system does not have.
pub(super) fn exists(what: &'static str, number: usize, count: usize) -> Result<(), ControlError> {
    if number < count { Ok(()) } else { Err(ControlError::NoSuch { what, number, count }) }
}
