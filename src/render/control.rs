//! A control run: time responses of the section point and of the control signal, and the motion that is reached.

use super::colours::{INK, STEADY_BLUE, STRIKING};
use super::figure::{Figure, KeyEntry, Mark, Panel, Row, Sample};
use super::frame::{AxisTitle, Frame};
use super::orbit::{Orbit, OrbitPanel, orbit_key};
use super::scale::Scale;
use super::symbols;
use super::text::Text;
use crate::analysis::Reading;
use crate::control::{ControlQuantity, ControlSchedule, Convention, History, Scheme, Sign};
use crate::model::{Setting, System};
use crate::plane::Start;

/// Dots and lines, in em.
const DOT: f64 = 0.14;
const SWITCH: f64 = 0.09;
const AROUND: f64 = 0.06;

/// A control run, to be drawn.
#[derive(Clone, Copy, Debug)]
pub struct ControlPicture<'a> {
    /// The system.
    pub system: &'a System,
    /// How the trajectory began.
    pub start: Start,
    /// What controlled it.
    pub scheme: &'a Scheme,
    /// When.
    pub schedule: ControlSchedule,
    /// What was written down.
    pub history: &'a History,
    /// The motion before and after, by name.
    pub labels: [&'a str; 2],
}

/// A quantity of the time responses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Response {
    /// The control signal: B, or the length of the correction.
    Signal,
    /// A component of the section point.
    Component(Reading),
}

impl ControlPicture<'_> {
    /// The figure: the signal and the four components against the iterate, the phase portrait and the time series after
    /// control. `range` cuts the iterates shown.
    pub fn figure(&self, range: Option<[u32; 2]>) -> Figure {
        let component = |reading| Response::Component(reading);
        let responses = [
            Response::Signal,
            component(Reading::Tau),
            component(Reading::VAfter),
            component(Reading::X2),
            component(Reading::V2),
        ];
        let mut panels: Vec<Panel> = responses.iter().map(|&of| self.response(of, range)).collect();
        let orbit = self.orbit();
        let after = [OrbitPanel::Portrait([Reading::X1, Reading::V1]), OrbitPanel::Time(Reading::X1)];
        panels.extend(after.map(|panel| orbit.panel(panel, &[])));
        for (panel, (letter, words)) in panels.iter_mut().zip(('a'..).zip(CAPTIONS)) {
            panel.weight = 1.0;
            panel.caption = Some(Text::from(format!("({letter}) {words}")));
        }
        let switched = panels[..responses.len()].iter().any(|p| p.frame.x.shows(self.schedule.from.into()));
        let mut key = if switched { vec![self.switch_key()] } else { Vec::new() };
        key.extend(orbit_key(self.setting().family(), &panels[responses.len()..]));
        let time = panels.pop();
        let mut rows: Vec<Row> = Vec::new();
        for panel in panels {
            match rows.last_mut().filter(|row| row.panels.len() < 2) {
                Some(row) => row.panels.push(panel),
                None => rows.push(Row { panels: vec![panel], weight: 0.62 }),
            }
        }
        rows.extend(time.map(|panel| Row { panels: vec![panel], weight: 0.62 }));
        Figure { title: self.title(|_| false), rows, key, notes: self.notes(), width: 60.0 }
    }

    /// What the line at the first controlled iterate stands for.
    pub fn switch_key(&self) -> KeyEntry {
        let name = Text::from("control on, ").italic("n").upright(format!(" = {}", self.schedule.from));
        KeyEntry { sample: Sample::Line(STRIKING), name }
    }

    /// A response against the iterate.
    pub fn response(&self, of: Response, range: Option<[u32; 2]>) -> Panel {
        let last = self.history.returns.len().saturating_sub(1) as u32;
        let [from, until] = range.unwrap_or([0, last.max(1)]);
        let points: Vec<[f64; 2]> = (self.history.returns.iter())
            .filter(|met| (from..=until).contains(&met.iterate))
            .map(|met| {
                let value = match of {
                    Response::Signal => met.signal,
                    Response::Component(reading) => component(&met.section, reading),
                };
                [f64::from(met.iterate), value]
            })
            .collect();
        let short = Text::new().italic("n");
        let frame = Frame {
            x: Scale::new(f64::from(from), f64::from(until.max(from + 1))),
            y: Scale::around(points.iter().map(|point| point[1]), AROUND),
            x_title: AxisTitle { long: Text::from("iterate ").then(short.clone()), short },
            y_title: self.response_title(of),
        };
        let colour = if of == Response::Signal { INK } else { STEADY_BLUE };
        let marks = vec![
            Mark::Upright { x: f64::from(self.schedule.from), width: SWITCH, colour: STRIKING },
            Mark::Dots { points, diameter: DOT, colour },
        ];
        Panel { caption: None, frame, marks, strips: Vec::new(), weight: 1.0 }
    }

    /// The flight after control.
    pub fn orbit(&self) -> Orbit<'_> {
        let recording = &self.history.recording;
        Orbit { system: self.system, recording, sections: recording }
    }

    /// The projection of the section points after so many iterates under control.
    pub fn section(&self, [x, y]: [Reading; 2], settled: u32) -> Panel {
        let begun = self.schedule.from + settled;
        let points: Vec<[f64; 2]> = (self.history.returns.iter())
            .filter(|met| met.iterate >= begun)
            .map(|met| [component(&met.section, x), component(&met.section, y)])
            .collect();
        let scale = |i: usize| Scale::around(points.iter().map(|point| point[i]), AROUND);
        let frame = Frame {
            x: scale(0),
            y: scale(1),
            x_title: symbols::reading_title(x),
            y_title: symbols::reading_title(y),
        };
        let marks = vec![Mark::Dots { points, diameter: 2.0 * DOT, colour: STEADY_BLUE }];
        Panel { caption: None, frame, marks, strips: Vec::new(), weight: 1.0 }
    }

    fn response_title(&self, of: Response) -> AxisTitle {
        match (of, self.scheme) {
            (Response::Signal, Scheme::Sine(_)) => {
                let short = Text::new().italic("B");
                AxisTitle { long: Text::from("amplitude ").then(short.clone()), short }
            }
            (Response::Signal, _) => {
                let short = Text::from("|Δ").italic("X").upright("|");
                AxisTitle { long: Text::from("correction ").then(short.clone()), short }
            }
            (Response::Component(reading), _) => symbols::reading_title(reading),
        }
    }

    fn setting(&self) -> &Setting {
        self.system.setting().expect("a system that is drawn is made of a setting")
    }

    /// The system, the start and the method, without the settings of which `varied` says so.
    pub fn title(&self, varied: impl Fn(ControlQuantity) -> bool) -> Vec<Text> {
        let mut title = symbols::equations(self.setting(), |_| false);
        title.extend(symbols::start(self.start, self.system.plant().n, |_| false));
        if let Some(last) = title.last_mut() {
            *last = last.clone().upright(";");
        }
        title.extend(describe(self.scheme, varied));
        title
    }

    fn notes(&self) -> Vec<Text> {
        let [before, after] = self.labels;
        vec![
            Text::from(format!("Before control: {before};")),
            Text::from(format!("under control: {after}.")),
            Text::from("Iterates are returns to x").subscript("1").upright(" = +").italic("δ").upright(","),
            "just after an impact.".into(),
        ]
    }
}

/// A component of a point on the section of a stop of the first coordinate.
fn component(section: &[f64], reading: Reading) -> f64 {
    match reading {
        Reading::X2 => section[1],
        Reading::V2 => section[section.len() / 2],
        Reading::Tau => section[section.len() - 1],
        _ => section[0],
    }
}

const CAPTIONS: [&str; 7] = [
    "control signal",
    "forcing phase at impact",
    "velocity after impact",
    "second mass, displacement",
    "second mass, velocity",
    "phase portrait under control",
    "time series under control",
];

/// A scheme in words, in pieces that belong together, without the settings of which `varied` says so.
pub(super) fn describe(scheme: &Scheme, varied: impl Fn(ControlQuantity) -> bool) -> Vec<Text> {
    use ControlQuantity as Q;
    let number = symbols::number;
    let setting = |quantity, value: f64| {
        let text = symbols::control_symbol(quantity).upright(format!(" = {}", number(value)));
        (!varied(quantity)).then_some(text)
    };
    let (method, settings): (&str, Vec<Option<Text>>) = match scheme {
        Scheme::Sine(sine) => {
            let method = match sine.convention {
                Convention::Kick => "sine kick",
                Convention::Force => "sine force",
                Convention::ForceLocal => "sine force from each impact",
            };
            let settings = [
                (Q::Amplitude, sine.amplitude),
                (Q::Alpha, sine.alpha),
                (Q::DeadBand, sine.dead_band),
                (Q::Gamma, sine.gamma),
            ];
            (method, settings.map(|(quantity, value)| setting(quantity, value)).to_vec())
        }
        Scheme::Pulse(pulse) => {
            let settings = [setting(Q::Period, f64::from(pulse.period)), setting(Q::Noise, pulse.noise)];
            ("period pulse", settings.to_vec())
        }
        Scheme::Delay(delay) => {
            let g = delay.gains[0];
            let gain = if delay.gains.iter().all(|&gain| gain == g) {
                setting(Q::Gain, g)
            } else {
                let listed: Vec<String> = delay.gains.iter().map(|&gain| number(gain)).collect();
                Some(Text::new().italic("G").upright(format!(" = diag({})", listed.join("; "))))
            };
            let method = match delay.sign {
                Sign::Stabilising => "delayed feedback",
                Sign::Printed => "delayed feedback, printed sign",
            };
            (method, vec![gain, setting(Q::Delay, f64::from(delay.delay))])
        }
    };
    let mut pieces = vec![Text::from(method)];
    pieces.extend(settings.into_iter().flatten());
    let last = pieces.len() - 1;
    pieces.iter_mut().take(last).for_each(|piece| *piece = piece.clone().upright(","));
    pieces
}
