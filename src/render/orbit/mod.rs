//! Orbits: phase portraits with the stops, time series with impacts and sticking, projected sections.

mod curve;
mod figure;
mod panel;
mod panel_error;
mod reader;
mod variable;
mod zoom;

pub use figure::{orbit_figure, orbit_key};
pub use panel::OrbitPanel;
pub use panel_error::PanelError;
pub use variable::Variable;
pub use zoom::Zoom;

use self::curve::{Curve, Place};
use self::reader::Reader;
use super::colours::{STEADY_BLUE, STICKING, STOP, STRIKING};
use super::symbols;
use crate::analysis::{Reading, Section};
use crate::dynamics::{ImpactEvent, Recording};
use crate::figure::{AxisTitle, Frame, INK, Mark, Panel, Scale, Text};
use crate::model::{Setting, System};

/// The widths of lines and dots, in em.
const CURVE: f64 = 0.08;
const STOP_LINE: f64 = 0.14;
const IMPACT: f64 = 0.42;
const FEW: f64 = 0.42;
const SOME: f64 = 0.2;
const MANY: f64 = 0.1;
/// The space around what is shown, as a share of it.
const AROUND: f64 = 0.06;

/// A recorded orbit.
#[derive(Clone, Copy, Debug)]
pub struct Orbit<'a> {
    /// The system.
    pub system: &'a System,
    /// What portraits and time series show.
    pub recording: &'a Recording,
    /// What sections show: impacts, and one sample per forcing period at phase 0.
    pub sections: &'a Recording,
}

impl Orbit<'_> {
    /// When the recording begins.
    fn began(&self) -> f64 {
        self.recording.samples.first().map_or(0.0, |sample| sample.time)
    }

    /// The plot of a kind, zoomed in wherever a zoom's quantity is on an axis.
    pub fn panel(&self, panel: OrbitPanel, zooms: &[Zoom]) -> Panel {
        let [x, y] = panel.axes();
        let zoomed = |mut frame: Frame| {
            for zoom in zooms {
                let scale = Scale::new(zoom.low, zoom.high);
                if zoom.variable == x {
                    frame.x = scale;
                }
                if zoom.variable == y {
                    frame.y = scale;
                }
            }
            frame
        };
        let reader = Reader::new(self.system);
        match panel {
            OrbitPanel::Portrait(axes) => self.portrait(&reader, axes, zoomed),
            OrbitPanel::Time(of) => self.time_series(&reader, of, zoomed),
            OrbitPanel::Section(section, axes) => self.section(&reader, section, axes, zoomed),
        }
    }

    /// The curve in a plot: the frame that shows all of it, zoomed, and its points, close to each other in that frame.
    fn line(
        &self,
        reader: &Reader,
        [x, y]: [Variable; 2],
        zoomed: impl Fn(Frame) -> Frame,
        place: impl Fn(&Place) -> [f64; 2],
    ) -> (Frame, Vec<[f64; 2]>) {
        let curve = Curve::of(self.recording, reader);
        let points: Vec<[f64; 2]> = curve.places().iter().map(&place).collect();
        let mut frame = self.frame(reader, [x, y], Section::Strobe, &points);
        if let (Variable::Time, [first, .., last]) = (x, &points[..])
            && first[0] < last[0]
        {
            frame.x = Scale::new(first[0], last[0]);
        }
        let frame = zoomed(frame);
        let within = |at: &Place| {
            let [x, y] = place(at);
            [frame.x.fraction(x), frame.y.fraction(y)]
        };
        let points = curve.refined(within).iter().map(&place).collect();
        (frame, points)
    }

    fn portrait(&self, reader: &Reader, axes: [Reading; 2], zoomed: impl Fn(Frame) -> Frame) -> Panel {
        let place = |p: &Place| axes.map(|reading| reader.of_state(&p.state, reading));
        let (frame, points) = self.line(reader, axes.map(Variable::Reading), zoomed, place);
        let mut marks = Vec::new();
        for stop in reader.stops() {
            let [x, y] = axes.map(|reading| reader.level(stop, reading));
            if let Some(x) = x {
                marks.push(Mark::Upright { x, width: STOP_LINE, colour: STOP });
            } else if let Some(y) = y {
                marks.push(Mark::Level { y, width: STOP_LINE, colour: STOP });
            } else if let Some(at) = reader.slanted(stop, axes) {
                let points = frame.x.ends().map(|x| [x, at(x)]).to_vec();
                marks.push(Mark::Line { points, width: STOP_LINE, colour: STOP });
            }
        }
        marks.push(Mark::Line { points, width: CURVE, colour: INK });
        panel(frame, marks, 1.0)
    }

    fn time_series(&self, reader: &Reader, of: Reading, zoomed: impl Fn(Frame) -> Frame) -> Panel {
        let period = self.system.period();
        let began = self.began();
        let periods = |time: f64| (time - began) / period;
        let place = |p: &Place| [periods(p.time), reader.of_state(&p.state, of)];
        let (frame, points) = self.line(reader, [Variable::Time, Variable::Reading(of)], zoomed, place);
        let mut marks: Vec<Mark> = (self.recording.sticks.iter())
            .map(|stick| Mark::Band { x: [periods(stick.from), periods(stick.until)], colour: STICKING })
            .collect();
        let levels = reader.stops().filter_map(|stop| reader.level(stop, of));
        marks.extend(levels.map(|y| Mark::Level { y, width: STOP_LINE, colour: STOP }));
        marks.push(Mark::Line { points, width: CURVE, colour: INK });
        if reader.stops().any(|stop| reader.shows(stop, of)) {
            let at = |impact: &ImpactEvent| [periods(impact.time), reader.of_impact(impact, of)];
            let shown = self.recording.impacts.iter().filter(|impact| reader.shows(impact.stop, of));
            let points: Vec<[f64; 2]> = shown.map(at).collect();
            let diameter = if points.len() > 24 { 0.5 * IMPACT } else { IMPACT };
            marks.push(Mark::Dots { points, diameter, colour: STRIKING });
        }
        panel(frame, marks, 1.35)
    }

    fn section(
        &self,
        reader: &Reader,
        section: Section,
        axes: [Reading; 2],
        zoomed: impl Fn(Frame) -> Frame,
    ) -> Panel {
        let points: Vec<[f64; 2]> = match section {
            Section::Strobe => (self.sections.samples.iter())
                .map(|sample| axes.map(|reading| reader.of_state(&sample.state, reading)))
                .collect(),
            Section::Impact(stop) => {
                let at = |impact: &ImpactEvent| axes.map(|reading| reader.of_impact(impact, reading));
                self.sections.impacts.iter().filter(|impact| impact.stop == stop).map(at).collect()
            }
        };
        let frame = zoomed(self.frame(reader, axes.map(Variable::Reading), section, &points));
        let diameter = match distinct(&points, &frame) {
            0..=40 => FEW,
            41..=400 => SOME,
            _ => MANY,
        };
        panel(frame, vec![Mark::Dots { points, diameter, colour: STEADY_BLUE }], 1.0)
    }

    /// A frame around points, and around the stops that are met at a value of a displacement on an axis.
    fn frame(&self, reader: &Reader, [x, y]: [Variable; 2], section: Section, points: &[[f64; 2]]) -> Frame {
        let stops = |variable| -> Vec<f64> {
            match variable {
                Variable::Reading(reading) => {
                    reader.stops().filter_map(|stop| reader.level(stop, reading)).collect()
                }
                Variable::Time => Vec::new(),
            }
        };
        let scale = |i: usize, variable| {
            Scale::around(points.iter().map(|point| point[i]).chain(stops(variable)), AROUND)
        };
        let setting = self.system.setting().expect("a system that is drawn is made of a setting");
        let title = |variable| title(&setting, section, variable);
        Frame { x: scale(0, x), y: scale(1, y), x_title: title(x), y_title: title(y) }
    }
}

fn title(setting: &Setting, section: Section, variable: Variable) -> AxisTitle {
    match variable {
        Variable::Time => {
            AxisTitle::new("time in forcing periods", Text::new().italic("t").upright("/").italic("T"))
        }
        Variable::Reading(reading) => symbols::title_on(setting, section, reading),
    }
}

fn panel(frame: Frame, marks: Vec<Mark>, weight: f64) -> Panel {
    Panel { weight, ..Panel::new(frame, marks) }
}

/// How many dots can be told apart.
fn distinct(points: &[[f64; 2]], frame: &Frame) -> usize {
    let cell = |value: f64| (value * 400.0) as i32;
    let mut cells: Vec<[i32; 2]> =
        points.iter().map(|[x, y]| [cell(frame.x.fraction(*x)), cell(frame.y.fraction(*y))]).collect();
    cells.sort_unstable();
    cells.dedup();
    cells.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::record;
    use crate::figure::faults;
    use crate::model::Parameters;
    use crate::plane::Start;

    #[test]
    fn orbits_of_every_kind_are_drawn_whole() {
        let names = ["portrait", "time", "portrait2", "section", "section-b:x2,v2", "strobe", "time:v1"];
        let panels: Vec<OrbitPanel> = names.iter().map(|name| name.parse().unwrap()).collect();
        let start = Start::State([1.0 / 30.0, -1.0 / 7.0, 1e-9, 0.0].into());
        // Periodic, chaotic, sticking, without impact, clamped.
        for (omega, delta) in [(3.7, 0.1), (2.83, 0.1), (0.25, 0.545), (3.0, 5.0), (3.0, 0.0)] {
            let system = System::new(Parameters { omega, delta, ..Parameters::default() }).unwrap();
            let recording = record(&system, [0.0; 4], 100, 2, 100);
            let sections = record(&system, [0.0; 4], 100, 60, 1);
            let orbit = Orbit { system: &system, recording: &recording, sections: &sections };
            for count in [1, 2, 4, 7] {
                let zooms: Vec<Zoom> =
                    if count == 2 { vec!["t=0.25:0.75".parse().unwrap()] } else { Vec::new() };
                let figure = orbit_figure(&orbit, start, &panels[..count], &zooms);
                let size = figure.natural_size(1200);
                let picture = figure.draw(size, "{}").unwrap();
                assert_eq!(faults(&picture, size), [""; 0], "ω = {omega}, δ = {delta}, {count} plots");
                assert_eq!(picture.svg().contains("sticking"), omega == 0.25 && count > 1);
            }
        }
    }

    #[test]
    fn points_of_a_section_are_the_impacts() {
        let system = System::new(Parameters::default()).unwrap();
        let recording = record(&system, [0.0; 4], 2000, 5, 1);
        let orbit = Orbit { system: &system, recording: &recording, sections: &recording };
        let points = |panel: &str| match &orbit.panel(panel.parse().unwrap(), &[]).marks[..] {
            [Mark::Dots { points, .. }] => points.clone(),
            marks => panic!("{marks:?}"),
        };
        let at_a = points("section:tau,v_after");
        assert_eq!(at_a.len(), 5);
        assert!(at_a.iter().all(|[tau, v]| (tau - 1.802134).abs() < 1e-6 && (v + 0.345457).abs() < 1e-6));
        // The motion is symmetric: at Ā it is the mirror image, half a cycle later.
        let at_b = points("section-b:x2,v_before");
        assert!(at_b.iter().all(|[x2, v]| (x2 - 0.006341).abs() < 1e-6 && (v + 0.345457 / 0.8).abs() < 1e-6));
        assert_eq!(points("strobe").len(), 6);
    }
}
