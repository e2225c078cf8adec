//! What exponents are counted by.

use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use crate::analysis::Section;
use crate::dynamics::Stop;
use crate::theory::Spectrum;

/// What Lyapunov exponents are counted by; natural logarithm.
///
/// The impact map is σ→σ of the section's stop, at A the paper's, and of the first stop on the strobe section; there is none
/// without impacts there, or with infinitely many.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, IntoStaticStr)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum ExponentUnit {
    /// Per forcing period.
    #[strum(serialize = "forcing period")]
    Period,
    /// Per iterate of the impact map.
    #[strum(serialize = "iterate")]
    Iterate,
    /// Per unit of non-dimensional time.
    #[strum(serialize = "unit of time")]
    Time,
}

impl ExponentUnit {
    /// The exponents of a spectrum in this unit on a section, as they are; NaN where it has no meaning.
    pub fn of(self, spectrum: &Spectrum, section: Section) -> Vec<f64> {
        match self {
            ExponentUnit::Period => spectrum.per_period.clone(),
            ExponentUnit::Iterate => {
                let per_iterate = spectrum.per_iterate(Self::counted_at(section));
                per_iterate.unwrap_or_else(|| vec![f64::NAN; spectrum.per_period.len()])
            }
            ExponentUnit::Time => spectrum.per_time(),
        }
    }

    /// The stop whose impacts are iterates, of readings on a section.
    pub(crate) fn counted_at(section: Section) -> Stop {
        match section {
            Section::Impact(stop) => stop,
            Section::Strobe => Stop::A,
        }
    }

    /// The unit in words.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
