//! Planes and diagrams as files carry them: names instead of parameters, and the whole family.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::axis::Axis;
use super::quantity::Quantity;
use crate::figure::Steps;
use crate::model::{Parameter, Setting};
use crate::system::Family;

/// An axis by the name of what it varies.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WrittenAxis {
    quantity: String,
    #[serde(flatten)]
    steps: Steps,
}

impl WrittenAxis {
    /// An axis as it is written.
    pub fn of(axis: &Axis) -> Self {
        WrittenAxis { quantity: axis.quantity.name().to_owned(), steps: axis.steps }
    }

    /// The axis of a family.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn read(&self, family: &'static Family) -> Result<Axis, String> {
        let Steps { first, last, count, spacing } = self.steps;
        let axis = Quantity::named(&self.quantity, family)
            .and_then(|quantity| Axis::spaced(quantity, first, last, count, spacing));
        axis.map_err(|error| error.to_string())
    }
}

/// A family as it is written: its file, and the hash by which it is recognised.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct WrittenSystem {
    name: String,
    origin: String,
    hash: String,
    text: String,
}

impl WrittenSystem {
    /// A family as it is written.
    pub fn of(family: &Family) -> Self {
        WrittenSystem {
            name: family.name.clone(),
            origin: family.origin.clone(),
            hash: family.hash.clone(),
            text: family.text.clone(),
        }
    }

    /// The family; the paper's oscillator where none was written.
    ///
    /// # Errors
    /// What is wrong with its file, or that it was changed.
    pub fn read(written: Option<&WrittenSystem>) -> Result<&'static Family, String> {
        let Some(WrittenSystem { origin, hash, text, .. }) = written else { return Ok(Family::paper()) };
        let family = Family::kept(text, origin).map_err(|error| error.to_string())?;
        if family.hash == *hash {
            return Ok(family);
        }
        Err(format!("the family {origin} does not have the hash that is written with it"))
    }
}

/// The values of parameters by their names.
pub type WrittenParameters = BTreeMap<String, f64>;

/// A setting as it is written.
pub fn parameters(setting: &Setting) -> WrittenParameters {
    setting.entries().map(|(parameter, value)| (parameter.name().to_owned(), value)).collect()
}

/// The setting of a family; parameters that are not written have their defaults.
///
/// # Errors
/// A name that the family does not have.
pub fn setting(family: &'static Family, written: &WrittenParameters) -> Result<Setting, String> {
    written.iter().try_fold(Setting::defaults(family), |setting, (name, &value)| {
        let parameter = Parameter::of(family, name).map_err(|error| error.to_string())?;
        Ok(setting.with(parameter, value))
    })
}
