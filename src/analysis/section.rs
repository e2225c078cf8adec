//! Sections: where a motion is looked at, what is read there, and whether its impacts chatter.

use std::f64::consts::TAU;
use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::dynamics::{Event, Stop, Trajectory};
use crate::model::{Flight, Real, State};

/// How many impacts in a row at one stop, each slower than the one before, are called chatter.
pub const CHATTER_RUN: u32 = 5;

/// A section of phase space, through which a motion passes again and again.
///
/// The discriminants are the codes of the GPU, which gets them generated from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[repr(u32)]
pub enum Section {
    /// The impact Poincaré section σ: just after an impact at A, x1 = +δ.
    A = 0,
    /// Just after an impact at Ā, x1 = −δ.
    B = 1,
    /// Forcing phase 0, once in every forcing period.
    #[serde(rename = "strobe")]
    Strobe = 2,
}

impl Section {
    /// Every section.
    pub const ALL: [Section; 3] = [Section::A, Section::B, Section::Strobe];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Section::A => "A",
            Section::B => "B",
            Section::Strobe => "strobe",
        }
    }
}

impl fmt::Display for Section {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Section {
    type Err = SectionError;

    fn from_str(name: &str) -> Result<Self, SectionError> {
        let found = Section::ALL.into_iter().find(|section| section.name() == name);
        found.ok_or_else(|| SectionError::UnknownSection(name.to_owned()))
    }
}

/// A quantity that is read on a section; non-dimensional.
///
/// The discriminants are the codes of the GPU, which gets them generated from here.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[repr(u32)]
pub enum Reading {
    /// v1−, the velocity of the first mass before the impact.
    VBefore = 0,
    /// v1+, the velocity of the first mass after the impact.
    VAfter = 1,
    /// Displacement of the first mass.
    X1 = 2,
    /// Displacement of the second mass.
    X2 = 3,
    /// Velocity of the first mass; after the impact where there is one.
    V1 = 4,
    /// Velocity of the second mass.
    V2 = 5,
    /// τ, the forcing phase at the impact, 0 ≤ τ < 2π.
    Tau = 6,
}

impl Reading {
    /// Every reading, in the order of the codes.
    pub const ALL: [Reading; 7] =
        [Reading::VBefore, Reading::VAfter, Reading::X1, Reading::X2, Reading::V1, Reading::V2, Reading::Tau];

    /// The name used on the command line and in files.
    pub fn name(self) -> &'static str {
        match self {
            Reading::VBefore => "v_before",
            Reading::VAfter => "v_after",
            Reading::X1 => "x1",
            Reading::X2 => "x2",
            Reading::V1 => "v1",
            Reading::V2 => "v2",
            Reading::Tau => "tau",
        }
    }

    /// Whether there is such a thing on a section.
    pub fn is_on(self, section: Section) -> bool {
        section != Section::Strobe || !matches!(self, Reading::VBefore | Reading::VAfter | Reading::Tau)
    }
}

impl fmt::Display for Reading {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Reading {
    type Err = SectionError;

    fn from_str(name: &str) -> Result<Self, SectionError> {
        let found = Reading::ALL.into_iter().find(|reading| reading.name() == name);
        found.ok_or_else(|| SectionError::UnknownReading(name.to_owned()))
    }
}

/// A quantity on a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Probe {
    /// Where.
    pub section: Section,
    /// What.
    pub reading: Reading,
}

impl Probe {
    /// A checked probe.
    ///
    /// # Errors
    /// [`SectionError::NotThere`] for a reading of impacts on the strobe section.
    pub fn new(section: Section, reading: Reading) -> Result<Self, SectionError> {
        let there = reading.is_on(section);
        there.then_some(Probe { section, reading }).ok_or(SectionError::NotThere(reading))
    }

    /// What is read at the end of a move that ended with `event`, if that is on the section.
    ///
    /// The last impact before sticking stands for the rebounds that follow it in finite time; coming to rest on a
    /// stop without an impact is none.
    #[inline(always)]
    pub fn read<T: Real, const N: usize>(
        &self,
        flight: &Flight<T, N>,
        trajectory: &Trajectory<T, N>,
        event: &Event<T>,
    ) -> Option<T> {
        let State { x, v } = trajectory.point.state;
        let (before, after) = match (self.section, event) {
            (Section::Strobe, Event::Strobe) => (T::zero(), v[0]),
            (section, Event::Impact(impact) | Event::Caught { impact, .. })
                if section == section_of(impact.stop) && impact.velocity_before != T::zero() =>
            {
                (impact.velocity_before, impact.velocity_after)
            }
            _ => return None,
        };
        Some(match self.reading {
            Reading::VBefore => before,
            Reading::VAfter | Reading::V1 => after,
            Reading::X1 => x[0],
            Reading::X2 => x[1],
            Reading::V2 => v[1],
            Reading::Tau => phase(flight, trajectory),
        })
    }
}

/// The impact Poincaré section of a stop.
#[inline(always)]
fn section_of(stop: Stop) -> Section {
    if stop == Stop::A { Section::A } else { Section::B }
}

/// The forcing phase, from the step and the offset in it.
#[inline(always)]
fn phase<T: Real, const N: usize>(flight: &Flight<T, N>, trajectory: &Trajectory<T, N>) -> T {
    let steps = T::of(f64::from(trajectory.step)) + trajectory.offset * flight.inverse_h;
    steps * (T::of(TAU) / T::of(f64::from(flight.steps)))
}

/// Counts impacts in a row at one stop, each slower than the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rebounds<T> {
    /// v1− of the last impact; its sign tells the stop. 0 before the first.
    last: T,
    /// Impacts in the present row.
    run: u32,
    /// Impacts in the longest row.
    pub longest: u32,
}

impl<T: Real> Default for Rebounds<T> {
    fn default() -> Self {
        Rebounds { last: T::zero(), run: 0, longest: 0 }
    }
}

impl<T: Real> Rebounds<T> {
    /// Sees what ended a move.
    #[inline(always)]
    pub fn see(&mut self, event: &Event<T>) {
        let (Event::Impact(impact) | Event::Caught { impact, .. }) = event else { return };
        let velocity = impact.velocity_before;
        if velocity == T::zero() {
            return;
        }
        let slower = velocity * self.last > T::zero() && velocity.abs() < self.last.abs();
        self.run = if slower { self.run + 1 } else { 1 };
        self.longest = if self.run > self.longest { self.run } else { self.longest };
        self.last = velocity;
    }
}

/// Why something cannot be read on a section.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum SectionError {
    /// No section has that name.
    #[error(
        "unknown section `{0}`; the sections are A (impacts at x1 = +delta), B (impacts at x1 = -delta) and strobe"
    )]
    UnknownSection(String),
    /// No reading has that name.
    #[error("unknown quantity `{0}`; on a section there are v_before, v_after, x1, x2, v1, v2, tau")]
    UnknownReading(String),
    /// The strobe section has no impacts.
    #[error("there is no {0} on the strobe section: choose x1, x2, v1 or v2, or section A or B")]
    NotThere(Reading),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::Impact;
    use crate::model::{Parameters, System};

    fn impact(velocity_before: f64) -> Event<f64> {
        let stop = if velocity_before > 0.0 { Stop::A } else { Stop::B };
        Event::Impact(Impact { stop, velocity_before, velocity_after: -0.8 * velocity_before })
    }

    #[test]
    fn names_and_codes_round_trip() {
        for (code, reading) in Reading::ALL.into_iter().enumerate() {
            assert_eq!(reading as usize, code);
            assert_eq!(reading.name().parse(), Ok(reading));
        }
        for section in Section::ALL {
            assert_eq!(section.name().parse(), Ok(section));
        }
        assert!("C".parse::<Section>().unwrap_err().to_string().contains("`C`"));
        assert!("v3".parse::<Reading>().unwrap_err().to_string().contains("`v3`"));
        assert_eq!(Probe::new(Section::Strobe, Reading::Tau), Err(SectionError::NotThere(Reading::Tau)));
    }

    #[test]
    fn a_row_of_rebounds_shrinks_at_one_stop() {
        let longest = |velocities: &[f64]| {
            let mut rebounds = Rebounds::default();
            velocities.iter().for_each(|&v| rebounds.see(&impact(v)));
            rebounds.see(&Event::Strobe);
            rebounds.longest
        };
        assert_eq!(longest(&[]), 0);
        assert_eq!(longest(&[1.0, -1.0, 0.5, -0.5]), 1);
        assert_eq!(longest(&[1.0, 0.8, 0.7, -0.9, -0.8, 0.1]), 3);
        assert_eq!(longest(&[1.0, 0.8, 0.9, 0.7]), 2);
    }

    /// The printed X* at ω = 3.7: what is read at an impact is the impact's.
    #[test]
    fn readings_are_those_of_the_instant() {
        let flight = Flight::<f64, 2>::new(&System::new(Parameters::default()).unwrap());
        let mut trajectory = Trajectory::new(&flight, State::zero());
        let mut last = [f64::NAN; 7];
        let mut strobes = 0;
        while strobes < 2000 {
            let event = trajectory.advance(&flight, &mut ()).event;
            strobes += u32::from(event == Event::Strobe);
            for (last, reading) in last.iter_mut().zip(Reading::ALL) {
                let probe = Probe { section: Section::A, reading };
                *last = probe.read(&flight, &trajectory, &event).unwrap_or(*last);
            }
        }
        let printed = [0.345457 / 0.8, -0.345457, 0.1, -0.006341, -0.345457, 0.021160, 1.802134];
        for (read, printed) in last.iter().zip(printed) {
            assert!((read - printed).abs() < 1e-6, "{last:?}");
        }
    }
}
