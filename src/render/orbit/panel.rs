//! The kinds of plots of an orbit, by name.

use std::str::FromStr;

use derive_more::Display;

use super::panel_error::PanelError;
use super::variable::Variable;
use crate::analysis::{Reading, Section, SectionError};
use crate::dynamics::Stop;
use crate::system::Family;

/// A plot of an orbit; displayed with the names of the paper's family.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
#[display("{}", self.name(Family::paper()))]
pub enum OrbitPanel {
    /// A phase portrait: two quantities of the state against each other.
    Portrait([Reading; 2]),
    /// A time series of a quantity of the state.
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

    /// The phase portrait that is drawn where none is asked for: of the coordinate that meets the first stop, or where
    /// several do of the distance to it.
    pub fn portrait(family: &Family) -> Self {
        OrbitPanel::Portrait(match family.met_by(0) {
            Some(i) => [Reading::X(i as u8), Reading::V(i as u8)],
            None => [Reading::Gap(Stop::A), Reading::Speed(Stop::A)],
        })
    }

    /// The time series that is drawn where none is asked for, of the same quantity.
    pub fn time_series(family: &Family) -> Self {
        OrbitPanel::Time(family.met_by(0).map_or(Reading::Gap(Stop::A), |i| Reading::X(i as u8)))
    }

    /// Reads `NAME` or `NAME:X,Y` with the names of a family.
    ///
    /// # Errors
    /// [`PanelError`] with what is wrong.
    pub fn of_family(text: &str, family: &Family) -> Result<Self, PanelError> {
        let (name, axes) = text.split_once(':').map_or((text, None), |(name, axes)| (name, Some(axes)));
        let asked = Asked { text, axes, family };
        if let Some(coordinate) = portrayed(name, family) {
            return match (coordinate, axes) {
                (None, None) => Ok(OrbitPanel::portrait(family)),
                (i, _) => {
                    let i = i.unwrap_or(0);
                    Ok(OrbitPanel::Portrait(asked.of_state([Reading::X(i), Reading::V(i)])?))
                }
            };
        }
        match name {
            "time" => match axes {
                None => Ok(OrbitPanel::time_series(family)),
                Some(of) => Ok(OrbitPanel::Time(asked.component(Reading::named(of.trim(), family)?)?)),
            },
            "strobe" => {
                let i = family.free_coordinate() as u8;
                asked.section(Section::Strobe, [Reading::X(i), Reading::V(i)])
            }
            _ => {
                let stop = match name.strip_prefix("section") {
                    Some("") => Some(0),
                    Some(rest) => rest.strip_prefix('-').and_then(|stop| family.stop_like(stop)),
                    None => None,
                };
                let stop = stop.ok_or_else(|| PanelError::Panel(name.to_owned()))?;
                asked.section(Section::Impact(Stop(stop as u8)), [Reading::Tau, Reading::VAfter])
            }
        }
    }

    /// The text that [`OrbitPanel::of_family`] reads.
    pub fn name(self, family: &Family) -> String {
        let pair = |[x, y]: [Reading; 2]| format!("{},{}", x.name(family), y.name(family));
        match self {
            OrbitPanel::Portrait(axes) => format!("portrait:{}", pair(axes)),
            OrbitPanel::Time(of) => format!("time:{}", of.name(family)),
            OrbitPanel::Section(Section::Impact(Stop::A), axes) => format!("section:{}", pair(axes)),
            OrbitPanel::Section(Section::Impact(stop), axes) => {
                let name = family.stops()[stop.index()].plain_name();
                let lower = name.to_lowercase();
                let known = family.stop_like(&lower) == Some(stop.index());
                format!("section-{}:{}", if known { &lower } else { name }, pair(axes))
            }
            OrbitPanel::Section(Section::Strobe, axes) => format!("strobe:{}", pair(axes)),
        }
    }
}

/// The coordinate of a phase portrait that is named after it, none for the one that is drawn by itself: `portrait2`,
/// `portrait`.
fn portrayed(name: &str, family: &Family) -> Option<Option<u8>> {
    match name.strip_prefix("portrait")? {
        "" => Some(None),
        number => {
            let number: usize = number.parse().ok()?;
            (1..=family.n()).contains(&number).then(|| Some(number as u8 - 1))
        }
    }
}

/// The axes of a panel that is asked for.
struct Asked<'a> {
    text: &'a str,
    axes: Option<&'a str>,
    family: &'a Family,
}

impl Asked<'_> {
    fn pair(&self, default: [Reading; 2]) -> Result<[Reading; 2], PanelError> {
        let Some(axes) = self.axes else { return Ok(default) };
        let (x, y) = axes.split_once(',').ok_or_else(|| PanelError::Axes(self.text.to_owned()))?;
        let pair = [Reading::named(x.trim(), self.family)?, Reading::named(y.trim(), self.family)?];
        if pair[0] == pair[1] { Err(PanelError::SameAxes(self.text.to_owned())) } else { Ok(pair) }
    }

    fn component(&self, reading: Reading) -> Result<Reading, PanelError> {
        if reading.is_of_impacts() {
            return Err(PanelError::NotAComponent(reading.name(self.family), self.text.to_owned()));
        }
        Ok(reading)
    }

    fn of_state(&self, default: [Reading; 2]) -> Result<[Reading; 2], PanelError> {
        let [x, y] = self.pair(default)?;
        Ok([self.component(x)?, self.component(y)?])
    }

    fn section(&self, section: Section, default: [Reading; 2]) -> Result<OrbitPanel, PanelError> {
        let axes = self.pair(default)?;
        match axes.into_iter().find(|reading| !reading.is_on(section)) {
            Some(reading) => Err(SectionError::NotThere(reading.name(self.family)).into()),
            None => Ok(OrbitPanel::Section(section, axes)),
        }
    }
}

/// As [`OrbitPanel::of_family`] for the paper's family.
impl FromStr for OrbitPanel {
    type Err = PanelError;

    fn from_str(text: &str) -> Result<Self, PanelError> {
        OrbitPanel::of_family(text, Family::paper())
    }
}

#[cfg(test)]
mod tests {
    use super::super::zoom::Zoom;
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
        assert_eq!(zoom.name(Family::paper()).parse(), Ok(zoom));
    }

    #[test]
    fn panels_have_the_names_of_their_family() {
        for (system, text, name) in [
            ("bouncing-ball", "portrait", "portrait:x1,v1"),
            ("bouncing-ball", "strobe", "strobe:x1,v1"),
            ("impact-damper", "portrait", "portrait:gap.A,speed.A"),
            ("impact-damper", "time", "time:gap.A"),
            ("impact-damper", "portrait2", "portrait:x2,v2"),
            ("three-mass-chain", "portrait", "portrait:x2,v2"),
            ("three-mass-chain", "strobe", "strobe:x1,v1"),
            ("three-mass-chain", "section-B:x3,v3", "section-b:x3,v3"),
            ("three-mass-chain", "time:speed.B", "time:speed.B"),
        ] {
            let family = Family::builtin(system);
            let panel = OrbitPanel::of_family(text, family).unwrap();
            assert_eq!(panel.name(family), name, "{system} {text}");
            assert_eq!(OrbitPanel::of_family(name, family), Ok(panel));
        }
        for (system, text) in
            [("bouncing-ball", "portrait2"), ("bouncing-ball", "section-b"), ("impact-pair", "time:x2")]
        {
            assert!(OrbitPanel::of_family(text, Family::builtin(system)).is_err(), "{system} {text}");
        }
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
