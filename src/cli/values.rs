//! Typed values of options.

use std::error::Error;
use std::str::FromStr;

use derive_more::Display;
use impact_atlas::figure::Size;
use impact_atlas::model::{Number, Parameter, ParameterError, whole};
use impact_atlas::plane::Quantity;
use impact_atlas::system::Family;
use thiserror::Error;

use super::{Result, wrong};

/// Reads a value for clap, with the whole chain of causes in the message.
pub fn parse<T>(text: &str) -> Result<T, String>
where
    T: FromStr,
    T::Err: Error + Send + Sync + 'static,
{
    text.parse().map_err(|error| format!("{:#}", anyhow::Error::new(error)))
}

/// A value for a parameter, or for a setting of a control method, `NAME=VALUE`.
#[derive(Clone, Copy, Debug, PartialEq, Display)]
#[display("{}={}", quantity.name(), Number(*value))]
pub struct Assignment {
    /// What is set.
    pub quantity: Quantity,
    /// The value that it is set to; non-dimensional.
    pub value: f64,
}

impl Assignment {
    /// Reads `NAME=VALUE` with the names of a family.
    ///
    /// # Errors
    /// What is wrong with the text, with the name or with the value.
    pub fn of_family(text: &str, family: &'static Family) -> Result<Self, AssignmentError> {
        let malformed = || AssignmentError::Malformed(text.to_owned());
        let (name, value) = text.split_once('=').ok_or_else(malformed)?;
        let name = name.trim();
        let quantity = match Quantity::named(name, family) {
            Ok(Quantity::Start(_)) => return Err(AssignmentError::Component(name.to_owned())),
            Ok(quantity) => quantity,
            Err(_) => Quantity::Parameter(Parameter::of(family, name)?),
        };
        let value = value.trim().parse().map_err(|_| malformed())?;
        match quantity {
            Quantity::Parameter(parameter) => parameter.check(value)?,
            Quantity::Control(setting) if setting.is_whole && !is_count(value) => {
                return Err(AssignmentError::NotWhole(text.to_owned()));
            }
            Quantity::Control(_) | Quantity::Start(_) => {}
        }
        Ok(Assignment { quantity, value })
    }

    /// Refuses a quantity that is set twice.
    pub fn refuse_twice(all: &[Assignment]) -> Result<()> {
        for (i, set) in all.iter().enumerate() {
            if let Some(other) = all[..i].iter().find(|other| other.quantity == set.quantity) {
                return Err(wrong!(
                    "{} is set twice, by --set {other} and --set {set}: drop one of the two",
                    set.quantity.name()
                ));
            }
        }
        Ok(())
    }
}

fn is_count(value: f64) -> bool {
    value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value)
}

/// Why an assignment was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum AssignmentError {
    /// Not of the form NAME=VALUE.
    #[error("`{0}` is not NAME=VALUE with a number, for example delta=0.1")]
    Malformed(String),
    /// A component of the start is not a parameter.
    #[error(
        "{0} is a component of the start and not a parameter: give it with --start X1,X2,V1,V2, where the command has one"
    )]
    Component(String),
    /// Iterates are counted.
    #[error("`{0}` sets a number of iterates: give a whole number")]
    NotWhole(String),
    /// The parameter or its value cannot be used.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
}

/// Reads a whole number as people write it: 1000 or 1e3.
pub fn count(text: &str) -> Result<u32, String> {
    let number =
        whole(text).ok_or_else(|| format!("`{text}` is not a whole number: write one like 1000 or 1e3"))?;
    u32::try_from(number).map_err(|_| format!("{number} is too large: at most {} is accepted", u32::MAX))
}

/// Reads a whole number from `least` to `most`.
pub fn counted(
    least: u32,
    most: u32,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    move |text| match count(text)? {
        number if (least..=most).contains(&number) => Ok(number),
        number => Err(format!("{number} is out of range: give {least} to {most}")),
    }
}

/// Reads the size of a picture, `WIDTHxHEIGHT` in pixels.
pub fn parse_size(text: &str) -> Result<Size, String> {
    let sides = text
        .split_once(['x', 'X'])
        .and_then(|(width, height)| Some((count(width).ok()?, count(height).ok()?)));
    let Some((width, height)) = sides else {
        return Err(format!("`{text}` is not a size: write WIDTHxHEIGHT in pixels, for example 1600x1200"));
    };
    Size::new(width, height).map_err(|error| error.to_string())
}

/// Reads two different numbers, `A:B`, the lesser first.
pub fn parse_span(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|value| value.is_finite());
    let ends = text.split_once(':').and_then(|(a, b)| Some([number(a)?, number(b)?]));
    match ends {
        Some([a, b]) if a != b => Ok([a.min(b), a.max(b)]),
        _ => {
            Err(format!("`{text}` is not a range: write A:B with two different numbers, for example 0.5:1.5"))
        }
    }
}

/// Reads a range of iterates, `FIRST:LAST`.
pub fn parse_range(text: &str) -> Result<[u32; 2], String> {
    let ends = text.split_once(':').and_then(|(first, last)| Some([count(first).ok()?, count(last).ok()?]));
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
    use impact_atlas::control::ControlQuantity;

    use super::*;

    #[test]
    fn assignments_are_read_and_bad_ones_are_named() {
        let set = Assignment::of_family("mu_m = 0.25", Family::paper()).unwrap();
        assert_eq!(
            set,
            Assignment { quantity: Quantity::named("mu_m", Family::paper()).unwrap(), value: 0.25 }
        );
        assert_eq!(Assignment::of_family("mu_m=1e-100", Family::paper()).unwrap().to_string(), "mu_m=1e-100");
        let gain = Assignment::of_family("gain=0.3", Family::paper()).unwrap();
        let of_gain = ControlQuantity::all().find(|setting| setting.name == "gain").unwrap();
        assert_eq!(gain, Assignment { quantity: Quantity::Control(of_gain), value: 0.3 });
        let refused = [
            ("omega", "NAME=VALUE"),
            ("omega=", "NAME=VALUE"),
            ("omega=fast", "NAME=VALUE"),
            ("omgea=3", "unknown parameter `omgea`"),
            ("x1=0.1", "--start"),
            ("r=1.5", "r = 1.5 is out of range"),
            ("omega=nan", "omega = NaN"),
            ("zeta=inf", "zeta = inf"),
            ("delay=1.5", "whole number"),
            ("period=-1", "whole number"),
            ("mu_m=-1e-100", "mu_m = -1e-100"),
        ];
        for (text, part) in refused {
            let message = Assignment::of_family(text, Family::paper()).unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
    }

    #[test]
    fn sizes_are_read_and_bad_ones_are_named() {
        assert_eq!(parse_size("1600x1200"), Ok(Size::new(1600, 1200).unwrap()));
        assert_eq!(parse_size("1e3x1e3"), Ok(Size::new(1000, 1000).unwrap()));
        for text in ["", "1600", "x", "1600x", "-1x5", "1600x1200x3", "1.5x1000"] {
            assert!(parse_size(text).unwrap_err().contains("WIDTHxHEIGHT"), "{text}");
        }
        assert!(parse_size("0x0").unwrap_err().contains("0 × 0"));
    }

    #[test]
    fn counts_are_read_and_bad_ones_are_named() {
        assert_eq!((count("1e3"), count("150")), (Ok(1000), Ok(150)));
        for text in ["many", "1.5", "-3", "1e-2", ""] {
            assert!(count(text).unwrap_err().contains(&format!("`{text}` is not a whole number")), "{text}");
        }
        assert!(count("4294967296").unwrap_err().contains("at most 4294967295"));
        let few = counted(2, 8);
        assert_eq!((few("2"), few("8e0")), (Ok(2), Ok(8)));
        assert!(few("1").unwrap_err().contains("2 to 8") && few("9").is_err());
    }
}
