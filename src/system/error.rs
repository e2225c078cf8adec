//! What is wrong with a family's file, or with one cell of it, and where.

use std::fmt;

use thiserror::Error;

use super::expression::Fault;
use super::number::Number;
use super::parameter::ParameterError;
use super::plant_error::PlantError;

/// A place in a family's file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file, as it was named.
    pub file: String,
    /// The line, from 1.
    pub line: usize,
    /// The key, sections first, with the entries of lists counted from 1: `system.mass[1][2]`; empty for the file.
    pub key: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)?;
        if self.key.is_empty() { Ok(()) } else { write!(f, ": {}", self.key) }
    }
}

/// Why a family's file was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}: {problem}")]
pub struct FamilyError {
    /// The place in the file.
    pub place: Place,
    /// What is wrong there, and the remedy.
    pub problem: String,
}

/// Why a cell of a family has no plant.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CellError {
    /// A parameter is out of its range.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// The expressions give no plant.
    #[error(transparent)]
    Fault(#[from] Box<CellFault>),
}

/// What keeps the expressions of a family from giving a plant, and the values at fault.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{place}: {problem}{}; choose other values", at(.values))]
pub struct CellFault {
    /// Where in the family's file.
    pub place: Place,
    /// What is wrong there.
    pub problem: CellProblem,
    /// The parameters that the expressions at fault name, with their values.
    pub values: Vec<(String, f64)>,
}

impl CellFault {
    /// The same of the default values, as what is wrong with the file.
    pub(super) fn of_defaults(&self) -> FamilyError {
        let CellFault { place, problem, values } = self;
        let problem =
            format!("with the default values, {problem}{}; change them or the expressions", at(values));
        FamilyError { place: place.clone(), problem }
    }
}

/// What keeps expressions from giving a plant.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CellProblem {
    /// An expression has no value.
    #[error(transparent)]
    Expression(#[from] Fault),
    /// The numbers cannot be computed with.
    #[error(transparent)]
    Plant(#[from] PlantError),
}

fn at(values: &[(String, f64)]) -> String {
    let list: Vec<String> =
        values.iter().map(|(name, value)| format!("{name} = {}", Number(*value))).collect();
    if list.is_empty() { String::new() } else { format!(" (at {})", list.join(", ")) }
}
