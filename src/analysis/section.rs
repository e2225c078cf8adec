//! Sections: where a motion is looked at, and what is read there.

use std::str::FromStr;

use derive_more::Display;
use serde::{Serialize, Serializer};
use thiserror::Error;

use crate::dynamics::Stop;
use crate::model::vector::MOST;
use crate::system::Family;

/// A section of phase space, through which a motion passes again and again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Section {
    /// The impact Poincaré section of a stop: just after an impact there.
    Impact(Stop),
    /// Forcing phase 0, once in every forcing period.
    Strobe,
}

/// The name of the section at forcing phase 0.
const STROBE: &str = "strobe";

impl Section {
    /// The impact Poincaré section of the first stop: σ of the paper's oscillator, x1 = +δ.
    pub const A: Section = Section::Impact(Stop::A);
    /// The impact Poincaré section of the second stop: x1 = −δ of the paper's oscillator.
    pub const B: Section = Section::Impact(Stop::B);
    /// The code of [`Section::Strobe`] on the GPU; that of an impact Poincaré section is its stop's place.
    pub(crate) const STROBE_CODE: u32 = MOST as u32;

    /// The code of the GPU.
    pub(crate) fn code(self) -> u32 {
        match self {
            Section::Impact(stop) => u32::from(stop.0),
            Section::Strobe => Section::STROBE_CODE,
        }
    }

    /// The section of a name: that of a stop of the family, or `strobe`.
    ///
    /// # Errors
    /// [`SectionError::UnknownSection`] with the sections that there are.
    pub fn named(name: &str, family: &Family) -> Result<Self, SectionError> {
        if let Some(stop) = family.stop(name) {
            return Ok(Section::Impact(Stop(stop as u8)));
        }
        if name == STROBE {
            return Ok(Section::Strobe);
        }
        let stops = family.stops().iter().enumerate();
        let known =
            stops.map(|(i, stop)| format!("{} (impacts at {})", stop.plain_name(), family.stop_place(i)));
        let known = known.collect::<Vec<_>>().join(", ");
        Err(SectionError::UnknownSection { name: name.to_owned(), known })
    }

    /// The name used on the command line and in files of a family.
    pub fn name(self, family: &Family) -> &str {
        match self {
            Section::Impact(stop) => family.stops()[stop.index()].plain_name(),
            Section::Strobe => STROBE,
        }
    }
}

/// A quantity that is read on a section, or in flight; non-dimensional. Displayed by its name in the paper's family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Display)]
#[display("{}", self.name(Family::paper()))]
pub enum Reading {
    /// d·v−, the velocity before the impact along the direction of the first stop on the same line; v1− of the paper's.
    VBefore,
    /// d·v+, the same after the impact.
    VAfter,
    /// Displacement of a coordinate, counted from 0.
    X(u8),
    /// Velocity of a coordinate, counted from 0; after the impact where there is one.
    V(u8),
    /// τ, the forcing phase at the impact, 0 ≤ τ < 2π.
    Tau,
    /// The distance that is left to a stop, in units of the direction of the first stop on the same line.
    Gap(Stop),
    /// The velocity towards a stop, in the same units; after the impact where there is one.
    Speed(Stop),
}

impl Reading {
    /// Displacement of the first coordinate.
    pub const X1: Reading = Reading::X(0);
    /// Displacement of the second coordinate.
    pub const X2: Reading = Reading::X(1);
    /// Velocity of the first coordinate.
    pub const V1: Reading = Reading::V(0);
    /// Velocity of the second coordinate.
    pub const V2: Reading = Reading::V(1);
    /// The code of the first displacement on the GPU; the other components of (x1 … xn, v1 … vn) follow.
    pub(crate) const COMPONENT_CODE: u32 = 3;
    /// The code of the distance to the first stop on the GPU; those of the other stops follow.
    pub(crate) const GAP_CODE: u32 = Reading::COMPONENT_CODE + 2 * MOST as u32;
    /// The code of the velocity towards the first stop on the GPU; those of the other stops follow.
    pub(crate) const SPEED_CODE: u32 = Reading::GAP_CODE + MOST as u32;

    /// The code of the GPU for a system of n coordinates; v_before, v_after and tau come first, in this order.
    pub(crate) fn code(self, n: usize) -> u32 {
        match self {
            Reading::VBefore => 0,
            Reading::VAfter => 1,
            Reading::Tau => 2,
            Reading::X(i) => Reading::COMPONENT_CODE + u32::from(i),
            Reading::V(i) => Reading::COMPONENT_CODE + n as u32 + u32::from(i),
            Reading::Gap(stop) => Reading::GAP_CODE + u32::from(stop.0),
            Reading::Speed(stop) => Reading::SPEED_CODE + u32::from(stop.0),
        }
    }

    /// What is read on a section where nothing else is asked for: v_before, on the strobe section the displacement of the
    /// first coordinate that meets no stop.
    pub fn usual(section: Section, family: &Family) -> Reading {
        match section {
            Section::Impact(_) => Reading::VBefore,
            Section::Strobe => Reading::X(family.free_coordinate() as u8),
        }
    }

    /// Every reading of a family, in the order in which they are listed.
    pub fn all(family: &Family) -> Vec<Reading> {
        let n = family.n() as u8;
        let stops = || (0..family.stops().len() as u8).map(Stop);
        let components = (0..n).map(Reading::X).chain((0..n).map(Reading::V));
        let along = stops().map(Reading::Gap).chain(stops().map(Reading::Speed));
        [Reading::VBefore, Reading::VAfter]
            .into_iter()
            .chain(components)
            .chain([Reading::Tau])
            .chain(along)
            .collect()
    }

    /// The reading of a name in a family.
    ///
    /// # Errors
    /// [`SectionError::UnknownReading`] with the readings that there are.
    pub fn named(name: &str, family: &Family) -> Result<Self, SectionError> {
        let along = |prefix: &str| {
            let stop = name.strip_prefix(prefix).and_then(|name| family.stop(name))?;
            Some(Stop(stop as u8))
        };
        let found = (along("gap.").map(Reading::Gap))
            .or_else(|| along("speed.").map(Reading::Speed))
            .or_else(|| Reading::all(family).into_iter().find(|reading| reading.name(family) == name));
        found.ok_or_else(|| {
            let known: Vec<String> =
                Reading::all(family).iter().map(|reading| reading.name(family)).collect();
            SectionError::UnknownReading { name: name.to_owned(), known: known.join(", ") }
        })
    }

    /// The name used on the command line and in files of a family: v_before, v_after, x1 … xn, v1 … vn, tau, and for a
    /// stop A gap.A and speed.A.
    pub fn name(self, family: &Family) -> String {
        let stop = |stop: Stop| family.stops()[stop.index()].plain_name();
        match self {
            Reading::VBefore => "v_before".to_owned(),
            Reading::VAfter => "v_after".to_owned(),
            Reading::X(i) => format!("x{}", i + 1),
            Reading::V(i) => format!("v{}", i + 1),
            Reading::Tau => "tau".to_owned(),
            Reading::Gap(of) => format!("gap.{}", stop(of)),
            Reading::Speed(of) => format!("speed.{}", stop(of)),
        }
    }

    /// Whether there is such a thing on a section.
    pub fn is_on(self, section: Section) -> bool {
        section != Section::Strobe || !self.is_of_impacts()
    }

    /// Whether it is a quantity of impacts, and not of the state.
    pub fn is_of_impacts(self) -> bool {
        matches!(self, Reading::VBefore | Reading::VAfter | Reading::Tau)
    }
}

/// As [`Reading::named`] for the paper's family.
impl FromStr for Reading {
    type Err = SectionError;

    fn from_str(name: &str) -> Result<Self, SectionError> {
        Reading::named(name, Family::paper())
    }
}

impl Serialize for Reading {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// Why something cannot be read on a section.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SectionError {
    /// No section has that name.
    #[error("unknown section `{name}`; the sections are {known} and strobe")]
    UnknownSection {
        /// The name.
        name: String,
        /// The stops, with their places.
        known: String,
    },
    /// No reading has that name.
    #[error("unknown quantity `{name}`; on a section there are {known}")]
    UnknownReading {
        /// The name.
        name: String,
        /// The readings.
        known: String,
    },
    /// The strobe section has no impacts.
    #[error(
        "there is no {0} on the strobe section: choose a component of the state (x1 … xn, v1 … vn), or the section of a stop"
    )]
    NotThere(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_round_trip_in_every_family() {
        for builtin in crate::system::BUILTIN {
            let family = Family::builtin(builtin.name);
            let mut codes = Vec::new();
            for reading in Reading::all(family) {
                assert_eq!(Reading::named(&reading.name(family), family), Ok(reading));
                codes.push(reading.code(family.n()));
            }
            codes.sort_unstable();
            codes.dedup();
            assert_eq!(codes.len(), Reading::all(family).len(), "codes differ");
            let stops = (0..family.stops().len() as u8).map(|stop| Section::Impact(Stop(stop)));
            for section in stops.chain([Section::Strobe]) {
                assert_eq!(Section::named(section.name(family), family), Ok(section));
            }
        }
    }

    #[test]
    fn names_that_there_are_not_are_told() {
        let chain = Family::builtin("three-mass-chain");
        assert_eq!(Section::named("Ā", Family::paper()), Ok(Section::B));
        for (name, part) in
            [("C", "A (impacts at x1 = +delta), B (impacts at x1 = -delta) and strobe"), ("a", "`a`")]
        {
            assert!(Section::named(name, Family::paper()).unwrap_err().to_string().contains(part));
        }
        assert_eq!(Reading::named("v3", chain), Ok(Reading::V(2)));
        let message = "v3".parse::<Reading>().unwrap_err().to_string();
        assert!(message.contains("`v3`") && message.contains("x1, x2, v1, v2, tau, gap.A"), "{message}");
        assert!(!Reading::Tau.is_on(Section::Strobe) && Reading::Gap(Stop::A).is_on(Section::Strobe));
    }
}
