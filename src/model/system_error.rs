//! Why a system is refused.

use thiserror::Error;

use super::parameters::Parameters;
use crate::system::{CellError, Number, PlantError, Setting};

/// The most steps of one forcing period that are accepted.
pub(super) const MOST_STEPS: u32 = 1 << 16;

/// Why a system was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SystemError {
    /// A parameter is outside its range, or the family cannot make a plant of the values.
    #[error(transparent)]
    Cell(#[from] CellError),
    /// The time scales are too far apart.
    #[error(
        "{} needs more than {most} steps per forcing period, since the fastest motion has a rate of {rate:.3e}: {remedy}",
        .0.place(),
        most = MOST_STEPS,
        rate = .0.rate,
        remedy = .0.remedy()
    )]
    TooStiff(Box<Stiff>),
    /// The plant cannot be followed.
    #[error(transparent)]
    Plant(#[from] PlantError),
}

/// A system whose time scales are too far apart.
#[derive(Clone, Debug, PartialEq)]
pub struct Stiff {
    pub(super) setting: Option<Setting>,
    pub(super) omega: f64,
    pub(super) rate: f64,
}

impl Stiff {
    /// The parameters with their values, or the frequency alone.
    fn place(&self) -> String {
        let Some(setting) = &self.setting else {
            return format!("a forcing frequency of {}", Number(self.omega));
        };
        let named = setting.entries().map(|(parameter, value)| format!("{parameter} = {}", Number(value)));
        named.collect::<Vec<_>>().join(", ")
    }

    /// Of the paper's oscillator the parameter that is furthest from its default, in powers of e, and where to move it.
    fn remedy(&self) -> &'static str {
        let Some(parameters) = self.setting.as_ref().and_then(Parameters::of) else {
            return "raise the forcing frequency, lower stiffness and damping, or raise the lightest mass";
        };
        let odds = |ratio: f64| libm::log(ratio / (1.0 - ratio));
        let least = f64::MIN_POSITIVE;
        let far = [
            (-libm::log(parameters.omega.max(least)), "raise omega"),
            (libm::log(parameters.zeta.max(least)) + 2.0, "lower zeta"),
            (-odds(parameters.mu_m.max(least)), "raise mu_m"),
            (odds(parameters.mu_k), "lower mu_k"),
            (odds(parameters.mu_c), "lower mu_c"),
        ];
        far.into_iter().fold((0.0, "raise omega"), |a, b| if b.0 > a.0 { b } else { a }).1
    }
}
