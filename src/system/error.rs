//! What is wrong with a family's file, or with one cell of it, and where.

use std::fmt;

use thiserror::Error;

use super::expression::{ExpressionError, Fault};
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
    /// What, and the remedy.
    pub problem: Box<Problem>,
}

/// What is wrong at a place of a family's file, with the remedy.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum Problem {
    /// The text is not TOML.
    #[error("this is not TOML: {0}; `impact-atlas systems shaw-holmes` prints a file to begin with")]
    NotToml(String),
    /// A section or a key is missing.
    #[error("missing: write {0}")]
    Missing(&'static str),
    /// A key or a section that does not exist.
    #[error("unknown key: remove it, or write one of {0}")]
    UnknownKey(String),
    /// A value of the wrong kind.
    #[error("this is {found}: write {wanted}")]
    WrongKind {
        /// The kind of value that stands there.
        found: &'static str,
        /// What should stand there.
        wanted: &'static str,
    },
    /// An empty text or list.
    #[error("empty: write {0}")]
    Empty(&'static str),
    /// A number that is infinite or NaN.
    #[error("{0} is not a finite number: write one")]
    NotFinite(String),
    /// A name that cannot name a parameter.
    #[error("`{name}` cannot name a parameter, {reason}: choose another name")]
    Name {
        /// The name.
        name: String,
        /// Why it is refused.
        reason: &'static str,
    },
    /// A parameter that no expression names.
    #[error("no expression uses this parameter: use it in [system] or in a [[stop]], or remove it")]
    Unused,
    /// Bounds that exclude each other or every number.
    #[error("{0}")]
    Bounds(&'static str),
    /// A default outside the parameter's own range.
    #[error("the default {0}")]
    Default(ParameterError),
    /// More than this version can follow.
    #[error("{count} {what}: this version follows 1 to {most}")]
    TooMany {
        /// How many there are.
        count: usize,
        /// What there are too many of.
        what: &'static str,
        /// The most that are possible.
        most: usize,
    },
    /// A matrix or a vector of the wrong shape.
    #[error(
        "{found} {what} where {wanted} should be: system.mass has {wanted} rows, one for each coordinate"
    )]
    Shape {
        /// How many there are.
        found: usize,
        /// Rows or entries.
        what: &'static str,
        /// The number of coordinates.
        wanted: usize,
    },
    /// A text that is no expression in the parameters.
    #[error(transparent)]
    Expression(#[from] ExpressionError),
    /// A name that cannot name a stop.
    #[error("`{name}` cannot name a stop, {reason}: choose another name")]
    StopName {
        /// The name.
        name: String,
        /// Why it is refused.
        reason: &'static str,
    },
    /// `label_order` is not an order of the stops.
    #[error("{reason}: write each of {stops} once")]
    LabelOrder {
        /// What is wrong with it.
        reason: String,
        /// The names of the stops.
        stops: String,
    },
    /// An axis of the default plane that cannot be one.
    #[error("`{text}` {reason}")]
    Axis {
        /// The axis.
        text: String,
        /// What is wrong with it, and the remedy.
        reason: String,
    },
    /// The default values make no plant.
    #[error("with the default values, {}{}; change them or the expressions", .0.problem, at(&.0.values))]
    Defaults(Box<CellFault>),
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
