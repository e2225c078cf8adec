//! The eight parameters of the oscillator, by name, with their physical ranges.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::number::Number;

/// One of the eight system parameters of Eq. (1); all are non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Forcing frequency ω = Ω √(M1/K1).
    Omega,
    /// Half clearance δ = B K1/(P1+P2): the stops stand at x1 = ±δ.
    Delta,
    /// Damping ratio ζ = C1/(2 √(K1 M1)).
    Zeta,
    /// Coefficient of restitution r.
    R,
    /// Mass ratio μm = M2/(M1+M2).
    MuM,
    /// Stiffness ratio μk = K2/(K1+K2).
    MuK,
    /// Damping ratio μc = C2/(C1+C2); damping is proportional exactly when μc = μk.
    MuC,
    /// Share of the forcing that acts on the second mass, f20 = P2/(P1+P2).
    F20,
}

impl Parameter {
    /// Every parameter, in the order of [`Parameters`].
    pub const ALL: [Parameter; 8] = [
        Parameter::Omega,
        Parameter::Delta,
        Parameter::Zeta,
        Parameter::R,
        Parameter::MuM,
        Parameter::MuK,
        Parameter::MuC,
        Parameter::F20,
    ];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Parameter::Omega => "omega",
            Parameter::Delta => "delta",
            Parameter::Zeta => "zeta",
            Parameter::R => "r",
            Parameter::MuM => "mu_m",
            Parameter::MuK => "mu_k",
            Parameter::MuC => "mu_c",
            Parameter::F20 => "f20",
        }
    }

    /// The symbol used on the axes of pictures.
    pub fn symbol(self) -> &'static str {
        match self {
            Parameter::Omega => "ω",
            Parameter::Delta => "δ",
            Parameter::Zeta => "ζ",
            Parameter::R => "r",
            Parameter::MuM => "μm",
            Parameter::MuK => "μk",
            Parameter::MuC => "μc",
            Parameter::F20 => "f20",
        }
    }

    /// What the parameter is, for help texts and axis titles.
    pub fn description(self) -> &'static str {
        match self {
            Parameter::Omega => "forcing frequency",
            Parameter::Delta => "half clearance",
            Parameter::Zeta => "damping ratio",
            Parameter::R => "coefficient of restitution",
            Parameter::MuM => "mass ratio",
            Parameter::MuK => "stiffness ratio",
            Parameter::MuC => "damping distribution",
            Parameter::F20 => "forcing share of the second mass",
        }
    }

    /// The physical range in words, for error messages.
    pub fn range(self) -> &'static str {
        match self {
            Parameter::Omega => "greater than 0 and at most 1e6",
            Parameter::Delta | Parameter::Zeta => "0 or greater",
            Parameter::R | Parameter::F20 => "between 0 and 1, ends included",
            Parameter::MuM | Parameter::MuK | Parameter::MuC => "between 0 and 1, ends excluded",
        }
    }

    fn admits(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Parameter::Omega => value > 0.0 && value <= 1e6,
                Parameter::Delta | Parameter::Zeta => value >= 0.0,
                Parameter::R | Parameter::F20 => (0.0..=1.0).contains(&value),
                Parameter::MuM | Parameter::MuK | Parameter::MuC => value > 0.0 && value < 1.0,
            }
    }

    /// Checks one value against the physical range.
    ///
    /// # Errors
    /// [`ParameterError::OutOfRange`] names the parameter, the value and the range.
    pub fn check(self, value: f64) -> Result<(), ParameterError> {
        if self.admits(value) { Ok(()) } else { Err(ParameterError::OutOfRange { parameter: self, value }) }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Parameter {
    type Err = ParameterError;

    fn from_str(name: &str) -> Result<Self, ParameterError> {
        Parameter::ALL
            .into_iter()
            .find(|p| p.name() == name)
            .ok_or_else(|| ParameterError::Unknown(name.to_owned()))
    }
}

/// Why a parameter was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ParameterError {
    /// No parameter has that name.
    #[error("unknown parameter `{0}`; the parameters are omega, delta, zeta, r, mu_m, mu_k, mu_c, f20")]
    Unknown(String),
    /// The value is not finite or outside the physical range.
    #[error("{parameter} = {} is out of range: {parameter} must be {}", Number(*value), parameter.range())]
    OutOfRange {
        /// The parameter that was set.
        parameter: Parameter,
        /// The value that was refused.
        value: f64,
    },
}

/// The eight non-dimensional parameters of Eq. (1).
///
/// [`Parameters::default`] holds the values of the paper's numerics at its first worked point,
/// ω = 3.7 and δ = 0.1; f20 = 0 (force on M1 only) is not printed there but reproduces its orbits.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Parameters {
    /// Forcing frequency.
    pub omega: f64,
    /// Half clearance.
    pub delta: f64,
    /// Damping ratio.
    pub zeta: f64,
    /// Coefficient of restitution.
    pub r: f64,
    /// Mass ratio.
    pub mu_m: f64,
    /// Stiffness ratio.
    pub mu_k: f64,
    /// Damping distribution.
    pub mu_c: f64,
    /// Forcing share of the second mass.
    pub f20: f64,
}

impl Default for Parameters {
    fn default() -> Self {
        Parameters { omega: 3.7, delta: 0.1, zeta: 0.1, r: 0.8, mu_m: 0.5, mu_k: 0.5, mu_c: 0.5, f20: 0.0 }
    }
}

impl Parameters {
    /// The value of one parameter.
    pub fn get(&self, parameter: Parameter) -> f64 {
        match parameter {
            Parameter::Omega => self.omega,
            Parameter::Delta => self.delta,
            Parameter::Zeta => self.zeta,
            Parameter::R => self.r,
            Parameter::MuM => self.mu_m,
            Parameter::MuK => self.mu_k,
            Parameter::MuC => self.mu_c,
            Parameter::F20 => self.f20,
        }
    }

    /// The same parameters with one of them changed (not checked; see [`Parameters::check`]).
    #[must_use]
    pub fn with(mut self, parameter: Parameter, value: f64) -> Self {
        *match parameter {
            Parameter::Omega => &mut self.omega,
            Parameter::Delta => &mut self.delta,
            Parameter::Zeta => &mut self.zeta,
            Parameter::R => &mut self.r,
            Parameter::MuM => &mut self.mu_m,
            Parameter::MuK => &mut self.mu_k,
            Parameter::MuC => &mut self.mu_c,
            Parameter::F20 => &mut self.f20,
        } = value;
        self
    }

    /// Checks every parameter against its physical range.
    ///
    /// # Errors
    /// The first parameter that is out of range, with its value.
    pub fn check(&self) -> Result<(), ParameterError> {
        Parameter::ALL.into_iter().try_for_each(|p| p.check(self.get(p)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip() {
        for parameter in Parameter::ALL {
            assert_eq!(parameter.name().parse::<Parameter>().unwrap(), parameter);
        }
        assert!(matches!("omgea".parse::<Parameter>(), Err(ParameterError::Unknown(_))));
    }

    #[test]
    fn with_and_get_address_the_same_field() {
        for (i, parameter) in Parameter::ALL.into_iter().enumerate() {
            let value = 0.25 + i as f64;
            let changed = Parameters::default().with(parameter, value);
            for other in Parameter::ALL {
                let expected = if other == parameter { value } else { Parameters::default().get(other) };
                assert_eq!(changed.get(other), expected);
            }
        }
    }

    #[test]
    fn ranges_are_enforced_at_their_ends() {
        let refused = [
            (Parameter::Omega, 0.0),
            (Parameter::Omega, f64::INFINITY),
            (Parameter::Omega, 1.1e6),
            (Parameter::Delta, -1e-300),
            (Parameter::Zeta, f64::NAN),
            (Parameter::R, 1.0 + 1e-12),
            (Parameter::R, -1e-12),
            (Parameter::MuM, 0.0),
            (Parameter::MuK, 1.0),
            (Parameter::MuC, 1.0),
            (Parameter::F20, 1.0 + 1e-12),
        ];
        for (parameter, value) in refused {
            assert!(Parameters::default().with(parameter, value).check().is_err(), "{parameter} = {value}");
        }
        let accepted = [
            (Parameter::Delta, 0.0),
            (Parameter::Zeta, 0.0),
            (Parameter::R, 0.0),
            (Parameter::R, 1.0),
            (Parameter::F20, 0.0),
            (Parameter::F20, 1.0),
        ];
        for (parameter, value) in accepted {
            assert!(Parameters::default().with(parameter, value).check().is_ok(), "{parameter} = {value}");
        }
    }
}
