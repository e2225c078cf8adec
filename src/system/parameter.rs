//! The parameters of a family: names, defaults, ranges.

use std::fmt;

use thiserror::Error;

use super::number::Number;

/// Which parameter of a family, in the order of its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ParameterId(pub(super) usize);

impl ParameterId {
    /// Where the parameter stands in the family's order.
    pub fn index(self) -> usize {
        self.0
    }
}

/// A parameter of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// The name in expressions, on the command line and in files.
    pub name: String,
    /// The value where none is given.
    pub default: f64,
    /// The symbol on the axes of pictures; the name where the file gives none.
    pub symbol: String,
    /// What the parameter is, for help texts and axis titles; may be empty.
    pub about: String,
    /// The values that it may take.
    pub range: Range,
}

impl Parameter {
    /// Checks one value against the range.
    ///
    /// # Errors
    /// [`ParameterError::OutOfRange`] names the parameter, the value and the range.
    pub fn check(&self, value: f64) -> Result<(), ParameterError> {
        if self.range.admits(value) {
            return Ok(());
        }
        Err(ParameterError::OutOfRange { name: self.name.clone(), value, range: self.range })
    }
}

/// One end of a range.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// The end.
    pub value: f64,
    /// Whether the end itself is admitted: `at_least`, `at_most`; or not: `above`, `below`.
    pub included: bool,
}

/// The finite values between two ends, either of which may be open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Range {
    /// The lower end.
    pub lower: Option<Bound>,
    /// The upper end.
    pub upper: Option<Bound>,
}

impl Range {
    /// Whether a value is finite and within the range.
    pub fn admits(&self, value: f64) -> bool {
        let above = |bound: Bound| value > bound.value || bound.included && value == bound.value;
        let below = |bound: Bound| value < bound.value || bound.included && value == bound.value;
        value.is_finite() && self.lower.is_none_or(above) && self.upper.is_none_or(below)
    }
}

/// The range in words that follow "must be".
impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.lower, self.upper) {
            (None, None) => f.write_str("a finite number"),
            (Some(Bound { value, included: true }), None) => write!(f, "{} or greater", Number(value)),
            (Some(Bound { value, included: false }), None) => write!(f, "greater than {}", Number(value)),
            (None, Some(Bound { value, included: true })) => write!(f, "{} or less", Number(value)),
            (None, Some(Bound { value, included: false })) => write!(f, "less than {}", Number(value)),
            (Some(lower), Some(upper)) => {
                write!(f, "between {} and {}, ", Number(lower.value), Number(upper.value))?;
                f.write_str(match (lower.included, upper.included) {
                    (true, true) => "ends included",
                    (false, false) => "ends excluded",
                    (true, false) => "the upper end excluded",
                    (false, true) => "the lower end excluded",
                })
            }
        }
    }
}

/// Why a parameter was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParameterError {
    /// The family has no parameter of that name.
    #[error("unknown parameter `{name}`; the parameters are {known}")]
    Unknown {
        /// The name.
        name: String,
        /// The parameters of the family.
        known: String,
    },
    /// The value is not finite or outside the range.
    #[error("{name} = {} is out of range: {name} must be {range}", Number(*value))]
    OutOfRange {
        /// The parameter that was set.
        name: String,
        /// The value that was refused.
        value: f64,
        /// The values that it may take.
        range: Range,
    },
}

/// Names and values of some of a family's parameters, each once, in the family's order.
pub(super) fn named(
    parameters: &[Parameter],
    ids: impl Iterator<Item = ParameterId>,
    values: &[f64],
) -> Vec<(String, f64)> {
    let mut ids: Vec<ParameterId> = ids.collect();
    ids.sort();
    ids.dedup();
    ids.into_iter().map(|id| (parameters[id.0].name.clone(), values[id.0])).collect()
}
