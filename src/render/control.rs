//! A control run: time responses of the section point and of the control signal, and the motion that is reached.

use super::colours::{STEADY_BLUE, STRIKING};
use super::orbit::{Orbit, OrbitPanel, orbit_key};
use super::places::stop_place;
use super::symbol::control_symbol;
use super::symbols;
use crate::analysis::{Reading, Section};
use crate::control::{ControlQuantity, ControlSchedule, History, Scheme, Shown};
use crate::dynamics::Stop;
use crate::figure::{AxisTitle, Figure, Frame, INK, KeyEntry, Mark, Panel, Row, Sample, Scale, Text, number};
use crate::model::{Setting, System};
use crate::plane::Start;
use crate::system::Family;

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
    /// From which iterate it controls, and for how many.
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
    /// The figure: the signal and the components against the iterate, the phase portrait and the time series after
    /// control. `range` cuts the iterates shown.
    pub fn figure(&self, range: Option<[u32; 2]>) -> Figure {
        let responses = self.responses();
        let mut panels: Vec<Panel> = responses.iter().map(|&of| self.response(of, range)).collect();
        let orbit = self.orbit();
        let stop = self.scheme.stop();
        let (x, v) = match self.setting().family().met_by(stop.index()) {
            Some(i) => (Reading::X(i as u8), Reading::V(i as u8)),
            None => (Reading::Gap(stop), Reading::Speed(stop)),
        };
        panels
            .extend([OrbitPanel::Portrait([x, v]), OrbitPanel::Time(x)].map(|panel| orbit.panel(panel, &[])));
        let after = AFTER.iter().map(|&words| words.to_owned());
        let captions = responses.iter().map(|&of| self.caption(of)).chain(after);
        for (panel, (letter, words)) in panels.iter_mut().zip(('a'..).zip(captions)) {
            panel.weight = 1.0;
            panel.caption = Some(Text::from(format!("({letter}) {words}")));
        }
        let switched = panels[..responses.len()].iter().any(|p| p.frame.x.shows(self.schedule.from.into()));
        let mut key = if switched { vec![self.switch_key()] } else { Vec::new() };
        key.extend(orbit_key(self.setting().family(), &panels[responses.len()..]));
        let time = panels.pop();
        let mut rows = Row::of(panels, 2, 0.62);
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
                    Response::Component(reading) => met.section[self.place(reading)],
                };
                [f64::from(met.iterate), value]
            })
            .collect();
        let frame = Frame {
            x: Scale::new(f64::from(from), f64::from(until.max(from + 1))),
            y: Scale::around(points.iter().map(|point| point[1]), AROUND),
            x_title: AxisTitle::new("iterate", Text::new().italic("n")),
            y_title: self.response_title(of),
        };
        let colour = if of == Response::Signal { INK } else { STEADY_BLUE };
        let marks = vec![
            Mark::Upright { x: f64::from(self.schedule.from), width: SWITCH, colour: STRIKING },
            Mark::Dots { points, diameter: DOT, colour },
        ];
        Panel::new(frame, marks)
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
            .map(|met| [met.section[self.place(x)], met.section[self.place(y)]])
            .collect();
        let scale = |i: usize| Scale::around(points.iter().map(|point| point[i]), AROUND);
        let frame = Frame {
            x: scale(0),
            y: scale(1),
            x_title: self.component_title(x),
            y_title: self.component_title(y),
        };
        let marks = vec![Mark::Dots { points, diameter: 2.0 * DOT, colour: STEADY_BLUE }];
        Panel::new(frame, marks)
    }

    /// The coordinate whose velocity is the first component of a point on the section.
    fn own(&self) -> u8 {
        self.system.plant().stops[self.scheme.stop().index()].own_coordinate() as u8
    }

    /// The signal, and every component of a point on the section: the phase, then the others in their order.
    fn responses(&self) -> Vec<Response> {
        let own = self.own();
        let others = || (0..self.system.plant().n as u8).filter(move |&i| i != own);
        let components = [Reading::Tau, Reading::VAfter].into_iter();
        let components = components.chain(others().map(Reading::X)).chain(others().map(Reading::V));
        std::iter::once(Response::Signal).chain(components.map(Response::Component)).collect()
    }

    /// Where a component of a point on the section stands; the velocity after the impact is that of its own coordinate.
    fn place(&self, reading: Reading) -> usize {
        let (n, own) = (self.system.plant().n, self.own());
        let among_others = |i: u8| usize::from(if i < own { i } else { i - 1 });
        match reading {
            Reading::Tau => 2 * n - 1,
            Reading::X(i) => 1 + among_others(i),
            Reading::V(i) if i != own => n + among_others(i),
            _ => 0,
        }
    }

    fn component_title(&self, reading: Reading) -> AxisTitle {
        let own = self.own();
        match reading {
            Reading::VAfter if own > 0 => {
                let short = symbols::reading_symbol(Reading::V(own)).superscript("+");
                AxisTitle::new("velocity after impact", short)
            }
            Reading::VAfter | Reading::Tau => symbols::reading_title(reading),
            _ => symbols::title_on(&self.setting(), Section::Impact(self.scheme.stop()), reading),
        }
    }

    fn caption(&self, of: Response) -> String {
        let of_mass = |i: u8, what: &str| format!("{} mass, {what}", symbols::ORDINALS[usize::from(i)]);
        match of {
            Response::Signal => "control signal".to_owned(),
            Response::Component(Reading::Tau) => "forcing phase at impact".to_owned(),
            Response::Component(Reading::X(i)) => of_mass(i, "displacement"),
            Response::Component(Reading::V(i)) => of_mass(i, "velocity"),
            Response::Component(_) => "velocity after impact".to_owned(),
        }
    }

    fn response_title(&self, of: Response) -> AxisTitle {
        match of {
            Response::Signal => {
                let (long, pieces) = self.scheme.method().signal;
                let short = pieces.iter().enumerate().fold(Text::new(), |text, (i, piece)| match i % 2 {
                    0 if piece.is_empty() => text,
                    0 => text.upright(*piece),
                    _ => text.italic(*piece),
                });
                AxisTitle { long: Text::from(long).then(short.clone()), short }
            }
            Response::Component(reading) => self.component_title(reading),
        }
    }

    fn setting(&self) -> Setting {
        self.system.setting().expect("a system that is drawn is made of a setting")
    }

    /// The system, the start and the method, without the settings of which `varied` says so.
    pub fn title(&self, varied: impl Fn(ControlQuantity) -> bool) -> Vec<Text> {
        let setting = self.setting();
        let mut title = symbols::equations(&setting, |_| false);
        title.extend(symbols::start(self.start, setting.has_mirror(), setting.family(), |_| false));
        if let Some(last) = title.last_mut() {
            *last = last.clone().upright(";");
        }
        title.extend(describe(self.scheme, self.setting().family(), varied));
        title
    }

    fn notes(&self) -> Vec<Text> {
        let [before, after] = self.labels;
        vec![
            Text::from(format!("Before control: {before};")),
            Text::from(format!("under control: {after}.")),
            Text::from("Iterates are returns to ")
                .then(stop_place(self.setting().family(), self.scheme.stop().index()))
                .upright(","),
            "just after an impact.".into(),
        ]
    }
}

const AFTER: [&str; 2] = ["phase portrait under control", "time series under control"];

/// A scheme in words, in pieces that belong together, without the settings of which `varied` says so.
pub(super) fn describe(
    scheme: &Scheme,
    family: &Family,
    varied: impl Fn(ControlQuantity) -> bool,
) -> Vec<Text> {
    let (method, settings) = scheme.shown();
    let piece = |shown| match shown {
        Shown::Setting(quantity, value) => {
            (!varied(quantity)).then(|| control_symbol(quantity).upright(format!(" = {}", number(value))))
        }
        Shown::Diagonal(gains) => {
            let listed: Vec<String> = gains.iter().map(|&gain| number(gain)).collect();
            Some(Text::new().italic("G").upright(format!(" = diag({})", listed.join("; "))))
        }
        Shown::Coordinate(i) => Some(Text::from("on ").italic("x").subscript((i + 1).to_string())),
    };
    let mut pieces = vec![Text::from(method)];
    pieces.extend(settings.into_iter().filter_map(piece));
    if scheme.stop() != Stop::A {
        pieces.push(Text::from(format!("at stop {}", family.stops()[scheme.stop().index()].name)));
    }
    let last = pieces.len() - 1;
    pieces.iter_mut().take(last).for_each(|piece| *piece = piece.clone().upright(","));
    pieces
}
