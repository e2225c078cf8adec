//! Orbits of the paper's system: where they settle, and how they are drawn.

use serde::Serialize;

use crate::analysis::{Schedule, Verdict};
use crate::backend::{Cpu, Job, Unwatched, decide};
use crate::dynamics::{Recording, record};
use crate::figure::{Figure, Panel, Picture, Row, Size, Text, TooSmall};
use crate::model::{Parameters, System};
use crate::plane::Start;
use crate::render::{Orbit, OrbitPanel, Zoom, orbit_key};
use crate::system::Family;

/// Forcing periods for which a point is observed.
const OBSERVE: u32 = 500;
/// Points of an orbit in each forcing period.
const SAMPLES: u32 = 600;
/// The width of pictures in pixels.
pub(super) const WIDTH: u32 = 2000;

/// A point that the paper names.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct PaperPoint {
    pub omega: f64,
    pub delta: f64,
    pub start: Start,
    /// Forcing periods that are left out.
    pub transient: u32,
}

impl PaperPoint {
    /// From rest, after 2000 periods.
    pub const fn new(omega: f64, delta: f64) -> Self {
        PaperPoint { omega, delta, start: Start::Rest, transient: 2000 }
    }

    /// From the 1-1-1 motion, after so many periods.
    pub const fn symmetric(omega: f64, delta: f64, transient: u32) -> Self {
        PaperPoint { omega, delta, start: Start::Symmetric, transient }
    }

    /// Everything else has the paper's value.
    pub fn parameters(&self) -> Parameters {
        Parameters { omega: self.omega, delta: self.delta, ..Parameters::default() }
    }

    pub fn system(&self) -> System {
        System::new(self.parameters()).expect("the paper's points are within the physical range")
    }

    /// What the trajectory settles on.
    pub fn verdict(&self) -> Verdict {
        let system = self.system();
        let schedule =
            Schedule { transient: self.transient, observe: OBSERVE, max_period: 32, fixed_periods: false };
        let start = self.start.state(&system);
        decide(&Cpu, &[Job { system, start }], &schedule, &Unwatched).expect("nothing stops the CPU path")[0]
    }

    /// What it does after the transient, for so many periods.
    pub fn recorded(&self, periods: u32, samples: u32) -> Recording {
        let system = self.system();
        record(&system, self.start.state(&system), self.transient, periods, samples)
    }

    /// "ω = 3.7, δ = 0.1", for reports.
    pub fn words(&self) -> String {
        format!("ω = {}, δ = {}", self.omega, self.delta)
    }

    /// The same for pictures, after the letter of a part.
    pub fn caption(&self, letter: &str, what: &str) -> Text {
        let number = |value: f64| format!(" = {value}");
        Text::from(format!("({letter}) "))
            .italic("ω")
            .upright(number(self.omega))
            .upright(", ")
            .italic("δ")
            .upright(number(self.delta))
            .upright(format!(": {what}"))
    }
}

/// The motion in words: label, and symmetry where it could be either.
pub(super) fn words(verdict: &Verdict) -> String {
    if !verdict.regime.is_periodic() {
        return verdict.label();
    }
    let symmetry = match (verdict.p() == verdict.q(), verdict.symmetric) {
        (true, true) => " symmetric",
        (true, false) => " unsymmetric",
        (false, _) => "",
    };
    format!("{}{symmetry}", verdict.label())
}

/// One plot of a figure.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Plot {
    pub letter: &'static str,
    pub point: PaperPoint,
    pub panel: &'static str,
    pub zoom: Option<&'static str>,
    /// Forcing periods that are shown.
    pub periods: u32,
}

impl Plot {
    pub const fn new(letter: &'static str, point: PaperPoint, panel: &'static str, periods: u32) -> Self {
        Plot { letter, point, panel, zoom: None, periods }
    }

    pub const fn zoomed(self, zoom: &'static str) -> Self {
        Plot { zoom: Some(zoom), ..self }
    }
}

/// Draws plots, `beside` of them in a row.
pub(super) fn draw(plots: &[Plot], beside: usize, config: &str) -> Result<Picture, TooSmall> {
    let mut panels: Vec<Panel> = Vec::new();
    for plot in plots {
        let panel: OrbitPanel = plot.panel.parse().expect("the panels of the registry have names");
        let zooms: Vec<Zoom> = plot
            .zoom
            .iter()
            .map(|text| text.parse().expect("the zooms of the registry are ranges"))
            .collect();
        let system = plot.point.system();
        let samples = if panel.is_section() { 1 } else { SAMPLES };
        let recording = plot.point.recorded(plot.periods, samples);
        let orbit = Orbit { system: &system, recording: &recording, sections: &recording };
        let mut drawn = orbit.panel(panel, &zooms);
        drawn.caption = Some(plot.point.caption(plot.letter, &words(&plot.point.verdict())));
        drawn.weight = 1.0;
        panels.push(drawn);
    }
    let key = orbit_key(Family::paper(), &panels);
    let rows = Row::of(panels, beside, 1.0);
    let height = match beside {
        1 => 620,
        2 => 800,
        _ => 680,
    };
    let size = Size::new(WIDTH, 130 + height * rows.len() as u32).expect("a few rows make a size");
    let width = if beside > 2 { 70.0 } else { 58.0 };
    Figure { title: Vec::new(), rows, key, notes: Vec::new(), width }.draw(size, config)
}
