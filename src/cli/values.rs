//! Typed values of options.

use std::error::Error;
use std::fmt;
use std::str::FromStr;

use impact_atlas::model::{Parameter, ParameterError};
use impact_atlas::plane::Component;
use impact_atlas::render::Size;
use thiserror::Error;

/// Reads a value for clap, with the whole chain of causes in the message.
pub fn parse<T>(text: &str) -> Result<T, String>
where
    T: FromStr,
    T::Err: Error + Send + Sync + 'static,
{
    text.parse().map_err(|error| format!("{:#}", anyhow::Error::new(error)))
}

/// A value for a parameter, `NAME=VALUE`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assignment {
    /// What is set.
    pub parameter: Parameter,
    /// To what; non-dimensional.
    pub value: f64,
}

impl fmt::Display for Assignment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}", self.parameter, self.value)
    }
}

impl FromStr for Assignment {
    type Err = AssignmentError;

    fn from_str(text: &str) -> Result<Self, AssignmentError> {
        let malformed = || AssignmentError::Malformed(text.to_owned());
        let (name, value) = text.split_once('=').ok_or_else(malformed)?;
        let name = name.trim();
        if Component::ALL.iter().any(|component| component.name() == name) {
            return Err(AssignmentError::Component(name.to_owned()));
        }
        let parameter: Parameter = name.parse()?;
        let value = value.trim().parse().map_err(|_| malformed())?;
        parameter.check(value)?;
        Ok(Assignment { parameter, value })
    }
}

/// Why an assignment was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AssignmentError {
    /// Not of the form NAME=VALUE.
    #[error("`{0}` is not NAME=VALUE with a number, for example delta=0.1")]
    Malformed(String),
    /// A component of the start is not a parameter.
    #[error("{0} is a component of the start and not a parameter: give it with --start X1,X2,V1,V2")]
    Component(String),
    /// The parameter or its value cannot be used.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// Reads the size of a picture, `WIDTHxHEIGHT` in pixels.
pub fn parse_size(text: &str) -> Result<Size, String> {
    let sides = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some((width.trim().parse().ok()?, height.trim().parse().ok()?)));
    let Some((width, height)) = sides else {
        return Err(format!("`{text}` is not a size: write WIDTHxHEIGHT in pixels, for example 1600x1200"));
    };
    Size::new(width, height).map_err(|error| error.to_string())
}

/// Reads a range of iterates, `FIRST:LAST`.
pub fn parse_range(text: &str) -> Result<[u32; 2], String> {
    let ends = text
        .split_once(':')
        .and_then(|(first, last)| Some([first.trim().parse().ok()?, last.trim().parse().ok()?]));
    match ends {
        None => Err(format!("`{text}` is not a range of iterates: write FIRST:LAST, for example 1990:2100")),
        Some([first, last]) if first >= last => {
            Err(format!("the range `{text}` is empty: the first iterate must be less than the last"))
        }
        Some(range) => Ok(range),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn assignments_are_read_and_bad_ones_are_named() {
        let set = parse::<Assignment>("mu_m = 0.25").unwrap();
        assert_eq!(set, Assignment { parameter: Parameter::MuM, value: 0.25 });
        let refused = [
            ("omega", "NAME=VALUE"),
            ("omega=", "NAME=VALUE"),
            ("omega=fast", "NAME=VALUE"),
            ("omgea=3", "unknown parameter `omgea`"),
            ("x1=0.1", "--start"),
            ("r=1.5", "r = 1.5 is out of range"),
            ("omega=nan", "omega = NaN"),
            ("zeta=inf", "zeta = inf"),
        ];
        for (text, part) in refused {
            let message = parse::<Assignment>(text).unwrap_err();
            assert!(message.contains(part), "{text}: {message}");
        }
    }

    #[test]
    fn sizes_are_read_and_bad_ones_are_named() {
        assert_eq!(parse_size("1600x1200"), Ok(Size::new(1600, 1200).unwrap()));
        for text in ["", "1600", "x", "1600x", "-1x5", "1600x1200x3", "1e3x1e3"] {
            assert!(parse_size(text).unwrap_err().contains("WIDTHxHEIGHT"), "{text}");
        }
        assert!(parse_size("0x0").unwrap_err().contains("0 × 0"));
    }
}
