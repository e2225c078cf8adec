//! A family at one place of its parameters.

use std::collections::HashMap;
use std::fmt;
use std::sync::LazyLock;

use derive_more::{Debug, Display};
use parking_lot::Mutex;
use smallvec::SmallVec;

use super::builtin::builtin;
use super::error::{CellError, FamilyError};
use super::family::Family;
use super::mooring::Mooring;
use super::parameter::{Parameter as ParameterRecord, ParameterError, ParameterId};
use super::plant::Plant;
use super::stops::StopValues;

/// The most parameters of a family.
pub const MOST_PARAMETERS: usize = 32;

/// The paper's oscillator among the families that come with the program.
pub const PAPER: &str = "luo-ma-lv";

/// Families that were read, by their text: each is kept for the life of the process, so that settings can be copied.
static FAMILIES: LazyLock<Mutex<HashMap<String, &'static Family>>> = LazyLock::new(Mutex::default);

impl Family {
    /// The family of a text, read once and kept for the life of the process; `origin` names it in messages.
    ///
    /// # Errors
    /// As [`Family::parse`].
    pub fn kept(text: &str, origin: &str) -> Result<&'static Family, FamilyError> {
        let mut families = FAMILIES.lock();
        if let Some(family) = families.get(text) {
            return Ok(family);
        }
        let family: &'static Family = Box::leak(Box::new(Family::parse(text, origin)?));
        families.insert(text.to_owned(), family);
        Ok(family)
    }

    /// A family that comes with the program.
    ///
    /// # Panics
    /// If there is none of that name.
    pub fn builtin(name: &str) -> &'static Family {
        let text = builtin(name).unwrap_or_else(|| panic!("no family named {name} comes with the program"));
        Family::kept(text, name).expect("the families that come with the program are valid")
    }

    /// The paper's oscillator.
    pub fn paper() -> &'static Family {
        static PAPERS: LazyLock<&'static Family> = LazyLock::new(|| Family::builtin(PAPER));
        *PAPERS
    }

    /// The two parameters in which the neighbourhood of a setting is searched: those of the default plane, else the first
    /// two.
    pub fn searched(&'static self) -> [Option<Parameter>; 2] {
        let named = |axis: &str| {
            let name = axis.split_once('=').map_or(axis, |(name, _)| name);
            Parameter::of(self, name.trim()).ok()
        };
        match &self.plane {
            Some(plane) => [named(&plane.x), named(&plane.y)],
            None => {
                let mut all = Parameter::all(self);
                [all.next(), all.next()]
            }
        }
    }

    /// Whether this is the paper's oscillator.
    pub fn is_paper(&self) -> bool {
        std::ptr::eq(self, Family::paper())
    }
}

/// A parameter of a family, by which settings are asked and changed.
#[derive(Clone, Copy, Debug, Display)]
#[display("{}", self.name())]
#[debug("{self}")]
pub struct Parameter {
    family: &'static Family,
    id: ParameterId,
}

impl Parameter {
    /// The parameter of a name that someone wrote.
    ///
    /// # Errors
    /// [`ParameterError::Unknown`] with the parameters that there are.
    pub fn of(family: &'static Family, name: &str) -> Result<Self, ParameterError> {
        Ok(Parameter { family, id: family.find(name)? })
    }

    /// Every parameter of a family, in the order of its file.
    pub fn all(family: &'static Family) -> impl Iterator<Item = Parameter> {
        family.ids().map(move |id| Parameter { family, id })
    }

    /// The family whose parameter it is.
    pub fn family(self) -> &'static Family {
        self.family
    }

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        &self.about().name
    }

    /// Whether more depends on it than gaps and restitutions.
    pub fn is_of_flow(self) -> bool {
        self.family.of_flow.contains(&self.id)
    }

    /// Whether a coefficient of restitution depends on it.
    pub fn is_of_restitution(self) -> bool {
        self.family.stops.iter().any(|stop| stop.restitution.uses().any(|id| id == self.id))
    }

    /// What the file says about it.
    pub fn about(self) -> &'static ParameterRecord {
        self.family.about(self.id)
    }

    /// Checks one value against the range.
    ///
    /// # Errors
    /// [`ParameterError::OutOfRange`] names the parameter, the value and the range.
    pub fn check(self, value: f64) -> Result<(), ParameterError> {
        self.about().check(value)
    }
}

impl PartialEq for Parameter {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.family, other.family) && self.id == other.id
    }
}

impl Eq for Parameter {}

impl std::hash::Hash for Parameter {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.id.hash(state);
    }
}

/// The values of the parameters of a family on which gaps and restitutions alone depend; few as a rule.
pub type StopParameters = SmallVec<[f64; 3]>;

/// The values of a family's parameters; everything is non-dimensional unless the family says otherwise.
#[derive(Clone, Copy)]
pub struct Setting {
    family: &'static Family,
    values: [f64; MOST_PARAMETERS],
}

impl Family {
    /// The parameter that the forcing frequency depends on, if it depends on a single one.
    pub fn of_frequency(&'static self) -> Option<Parameter> {
        let mut uses = self.equations.frequency.uses();
        let id = uses.next()?;
        uses.all(|other| other == id).then_some(Parameter { family: self, id })
    }
}

impl Setting {
    /// The family's defaults.
    pub fn defaults(family: &'static Family) -> Self {
        let mut values = [0.0; MOST_PARAMETERS];
        values[..family.parameters.len()].copy_from_slice(&family.defaults());
        Setting { family, values }
    }

    /// The family.
    pub fn family(&self) -> &'static Family {
        self.family
    }

    /// The value of one parameter.
    pub fn get(&self, parameter: Parameter) -> f64 {
        self.values[parameter.id.index()]
    }

    /// The value of a parameter by its name, if the family has it.
    pub fn named(&self, name: &str) -> Option<f64> {
        self.family.parameter(name).map(|id| self.values[id.index()])
    }

    /// The same setting with one parameter changed (not checked; see [`Setting::check`]).
    #[must_use]
    pub fn with(mut self, parameter: Parameter, value: f64) -> Self {
        self.set(parameter, value);
        self
    }

    /// Changes one parameter (not checked; see [`Setting::check`]).
    pub fn set(&mut self, parameter: Parameter, value: f64) {
        self.values[parameter.id.index()] = value;
    }

    /// The values on which gaps and restitutions alone depend, all others being the [`Setting::flow_bits`].
    pub fn stop_parameters(&self) -> StopParameters {
        self.family.of_stops.iter().map(|id| self.values[id.index()]).collect()
    }

    /// The same setting with [`Setting::stop_parameters`] of another with the same [`Setting::flow_bits`].
    #[must_use]
    pub fn with_stop_parameters(mut self, values: &StopParameters) -> Self {
        for (id, value) in self.family.of_stops.iter().zip(values) {
            self.values[id.index()] = *value;
        }
        self
    }

    /// Whether it is of the same family, with the same [`Setting::flow_bits`].
    pub fn has_flow_of(&self, other: &Setting) -> bool {
        std::ptr::eq(self.family, other.family) && self.flow_bits().eq(other.flow_bits())
    }

    /// The same setting with a parameter changed that is given by its name.
    ///
    /// # Panics
    /// If the family has no such parameter.
    #[must_use]
    pub fn with_named(self, name: &str, value: f64) -> Self {
        let parameter = Parameter::of(self.family, name).expect("the family has the parameter");
        self.with(parameter, value)
    }

    /// The values, in the order of the family's file.
    fn values(&self) -> &[f64] {
        &self.values[..self.family.parameters.len()]
    }

    /// Every parameter with its value, in the order of the family's file.
    pub fn entries(&self) -> impl Iterator<Item = (Parameter, f64)> + '_ {
        Parameter::all(self.family).map(|parameter| (parameter, self.get(parameter)))
    }

    /// Checks every parameter against its range.
    ///
    /// # Errors
    /// The first parameter that is out of range, with its value.
    pub fn check(&self) -> Result<(), ParameterError> {
        self.family.check(self.values())
    }

    /// The plant of these values, checked.
    ///
    /// # Errors
    /// As [`Family::plant`].
    pub fn plant(&self) -> Result<Plant, CellError> {
        self.family.plant(self.values())
    }

    /// The bits of the values on which more depends than gaps and restitutions: settings of one family in which they are the
    /// same have plants that differ in those alone.
    pub fn flow_bits(&self) -> impl Iterator<Item = u64> + '_ {
        self.family.flow_bits(self.values())
    }

    /// The gaps and restitutions of these values, with which the plant of another setting of the family with the same
    /// [`Setting::flow_bits`] that makes one is the plant of this one; none where [`Setting::plant`] has to look at all of it.
    pub fn stop_values(&self) -> Option<[StopValues; Plant::MOST_STOPS]> {
        self.family.stop_values(self.values())
    }

    /// Whether these values make a plant, and it has a mirror: then there is a symmetric motion to look for.
    pub fn has_mirror(&self) -> bool {
        let held = |plant: Plant| Mooring::of(&plant).map_or(plant, |(held, _)| held);
        self.plant().is_ok_and(|plant| held(plant).mirror().is_some())
    }
}

impl PartialEq for Setting {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.family, other.family) && self.values == other.values
    }
}

impl fmt::Debug for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.entries()).finish()
    }
}

impl serde::Serialize for Setting {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.entries().map(|(parameter, value)| (parameter.name(), value)))
    }
}
