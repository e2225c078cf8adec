//! The kinds of plots of an orbit, by name.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::analysis::{Reading, Section, SectionError};
use crate::model::Number;

/// A quantity on an axis of an orbit's plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum Variable {
    /// The time since the recording began, in forcing periods.
    Time,
    /// Anything else.
    Reading(Reading),
}

impl fmt::Display for Variable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Variable::Time => f.write_str("t"),
            Variable::Reading(reading) => reading.fmt(f),
        }
    }
}

impl FromStr for Variable {
    type Err = PanelError;

    fn from_str(name: &str) -> Result<Self, PanelError> {
        match name {
            "t" => Ok(Variable::Time),
            name => name.parse().map(Variable::Reading).map_err(|_| PanelError::Variable(name.to_owned())),
        }
    }
}

impl From<Variable> for String {
    fn from(variable: Variable) -> String {
        variable.to_string()
    }
}

impl TryFrom<String> for Variable {
    type Error = PanelError;

    fn try_from(name: String) -> Result<Self, PanelError> {
        name.parse()
    }
}

/// A plot of an orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum OrbitPanel {
    /// A phase portrait: two components of the state against each other.
    Portrait([Reading; 2]),
    /// A time series of a component of the state.
    Time(Reading),
    /// A projected section.
    Section(Section, [Reading; 2]),
}

impl OrbitPanel {
    /// The quantities along its axes.
    pub fn axes(self) -> [Variable; 2] {
        match self {
            OrbitPanel::Portrait(axes) | OrbitPanel::Section(_, axes) => axes.map(Variable::Reading),
            OrbitPanel::Time(of) => [Variable::Time, Variable::Reading(of)],
        }
    }

    /// Whether it shows a section.
    pub fn is_section(self) -> bool {
        matches!(self, OrbitPanel::Section(..))
    }
}

/// Components of the state.
fn is_component(reading: Reading) -> bool {
    matches!(reading, Reading::X1 | Reading::X2 | Reading::V1 | Reading::V2)
}

impl fmt::Display for OrbitPanel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OrbitPanel::Portrait([x, y]) => write!(f, "portrait:{x},{y}"),
            OrbitPanel::Time(of) => write!(f, "time:{of}"),
            OrbitPanel::Section(Section::A, [x, y]) => write!(f, "section:{x},{y}"),
            OrbitPanel::Section(Section::B, [x, y]) => write!(f, "section-b:{x},{y}"),
            OrbitPanel::Section(Section::Strobe, [x, y]) => write!(f, "strobe:{x},{y}"),
        }
    }
}

impl FromStr for OrbitPanel {
    type Err = PanelError;

    /// Reads `NAME` or `NAME:X,Y`.
    fn from_str(text: &str) -> Result<Self, PanelError> {
        let (name, axes) = text.split_once(':').map_or((text, None), |(name, axes)| (name, Some(axes)));
        let malformed = || PanelError::Axes(text.to_owned());
        let pair = |default: [Reading; 2]| -> Result<[Reading; 2], PanelError> {
            let Some(axes) = axes else { return Ok(default) };
            let (x, y) = axes.split_once(',').ok_or_else(malformed)?;
            let pair = [x.trim().parse::<Reading>()?, y.trim().parse()?];
            if pair[0] == pair[1] { Err(PanelError::SameAxes(text.to_owned())) } else { Ok(pair) }
        };
        let of_state = |readings: &[Reading]| match readings.iter().find(|reading| !is_component(**reading)) {
            Some(reading) => Err(PanelError::NotAComponent(*reading, text.to_owned())),
            None => Ok(()),
        };
        let section = |section: Section, default| -> Result<OrbitPanel, PanelError> {
            let axes = pair(default)?;
            match axes.into_iter().find(|reading| !reading.is_on(section)) {
                Some(reading) => Err(SectionError::NotThere(reading).into()),
                None => Ok(OrbitPanel::Section(section, axes)),
            }
        };
        match name {
            "portrait" | "portrait2" => {
                let default =
                    if name == "portrait" { [Reading::X1, Reading::V1] } else { [Reading::X2, Reading::V2] };
                let axes = pair(default)?;
                of_state(&axes)?;
                Ok(OrbitPanel::Portrait(axes))
            }
            "time" => {
                let of = axes.map_or(Ok(Reading::X1), |name| name.trim().parse::<Reading>())?;
                of_state(&[of])?;
                Ok(OrbitPanel::Time(of))
            }
            "section" | "section-a" => section(Section::A, [Reading::Tau, Reading::VAfter]),
            "section-b" => section(Section::B, [Reading::Tau, Reading::VAfter]),
            "strobe" => section(Section::Strobe, [Reading::X2, Reading::V2]),
            _ => Err(PanelError::Panel(name.to_owned())),
        }
    }
}

impl From<OrbitPanel> for String {
    fn from(panel: OrbitPanel) -> String {
        panel.to_string()
    }
}

impl TryFrom<String> for OrbitPanel {
    type Error = PanelError;

    fn try_from(text: String) -> Result<Self, PanelError> {
        text.parse()
    }
}

/// The range that every axis over a quantity shows.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub struct Zoom {
    /// The quantity.
    pub variable: Variable,
    /// The least value shown.
    pub low: f64,
    /// The largest value shown.
    pub high: f64,
}

impl fmt::Display for Zoom {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}={}:{}", self.variable, Number(self.low), Number(self.high))
    }
}

impl FromStr for Zoom {
    type Err = PanelError;

    /// Reads `NAME=LOW:HIGH`.
    fn from_str(text: &str) -> Result<Self, PanelError> {
        let malformed = || PanelError::Zoom(text.to_owned());
        let (name, range) = text.split_once('=').ok_or_else(malformed)?;
        let variable = name.trim().parse()?;
        let (low, high) = range.split_once(':').ok_or_else(malformed)?;
        let low: f64 = low.trim().parse().map_err(|_| malformed())?;
        let high: f64 = high.trim().parse().map_err(|_| malformed())?;
        if !low.is_finite() || !high.is_finite() || low >= high {
            return Err(PanelError::EmptyZoom(text.to_owned()));
        }
        Ok(Zoom { variable, low, high })
    }
}

impl From<Zoom> for String {
    fn from(zoom: Zoom) -> String {
        zoom.to_string()
    }
}

impl TryFrom<String> for Zoom {
    type Error = PanelError;

    fn try_from(text: String) -> Result<Self, PanelError> {
        text.parse()
    }
}

/// Why a plot of an orbit was refused.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PanelError {
    /// No plot has that name.
    #[error("unknown panel `{0}`; the panels are portrait, portrait2, time, section, section-b, strobe")]
    Panel(String),
    /// Two quantities are missing.
    #[error("`{0}` names no two quantities: write them after a colon, for example section:x2,v2")]
    Axes(String),
    /// The same quantity twice.
    #[error("`{0}` has the same quantity on both axes: choose two")]
    SameAxes(String),
    /// A phase portrait and a time series show the state.
    #[error("{0} in `{1}` is no component of the state: choose from x1, x2, v1, v2")]
    NotAComponent(Reading, String),
    /// A section does not have the quantity.
    #[error(transparent)]
    Section(#[from] SectionError),
    /// No axis has that name.
    #[error(
        "unknown quantity `{0}`; axes are t (in forcing periods), x1, x2, v1, v2, v_before, v_after, tau"
    )]
    Variable(String),
    /// Not of the form NAME=LOW:HIGH.
    #[error("`{0}` is not a range: write NAME=LOW:HIGH, for example t=2.1:2.4")]
    Zoom(String),
    /// Nothing between the ends.
    #[error("the range `{0}` is empty: the first number must be less than the second, both finite")]
    EmptyZoom(String),
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panels_read_back_what_they_print() {
        for text in [
            "portrait:x1,v1",
            "portrait:x2,v2",
            "time:x1",
            "time:v2",
            "section:x2,v2",
            "section-b:tau,v_before",
            "strobe:x1,v1",
        ] {
            assert_eq!(text.parse::<OrbitPanel>().unwrap().to_string(), text);
        }
        assert_eq!("portrait2".parse::<OrbitPanel>(), "portrait:x2,v2".parse());
        assert_eq!("section".parse::<OrbitPanel>(), "section-a:tau,v_after".parse());
        let zoom: Zoom = "v1=-0.5:0.25".parse().unwrap();
        assert_eq!(zoom.to_string().parse(), Ok(zoom));
    }

    #[test]
    fn bad_panels_are_named() {
        for (text, part) in [
            ("phase", "unknown panel `phase`"),
            ("section:x2", "no two quantities"),
            ("section:x2,x2", "both axes"),
            ("section:x2,v3", "`v3`"),
            ("strobe:tau,x2", "strobe section"),
            ("portrait:tau,x2", "no component"),
            ("time:v_after", "no component"),
        ] {
            let message = text.parse::<OrbitPanel>().unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
        for (text, part) in [
            ("t", "NAME=LOW:HIGH"),
            ("y=0:1", "`y`"),
            ("t=1", "NAME=LOW:HIGH"),
            ("t=2:1", "empty"),
            ("x1=0:inf", "empty"),
        ] {
            let message = text.parse::<Zoom>().unwrap_err().to_string();
            assert!(message.contains(part), "{text}: {message}");
        }
    }
}
