//! The figures of one cell, drawn as `orbit` draws them.

use serde_json::json;

use crate::analysis::{Reading, Regime, Section, Verdict};
use crate::dynamics::{self, Recording};
use crate::explore::task::Task;
use crate::figure::Size;
use crate::model::System;
use crate::plane::Start;
use crate::render::{Orbit, OrbitPanel, orbit_figure};

/// Samples of a curve in each forcing period.
const SAMPLES: u32 = 200;
/// Forcing periods of what does not repeat.
const APERIODIC: u32 = 24;
/// Forcing periods of what repeats, at most.
const MOST: u32 = 64;
/// Forcing periods of a section.
const SECTION: u32 = 2000;

/// Sends the phase portrait and the time series of the motion that a cell has settled on.
pub fn portrait(system: &System, verdict: &Verdict, width: u32, task: &Task) {
    let Some(family) = system.family() else { return };
    let periods = match verdict.n {
        0 if verdict.regime == Regime::NoImpact => 1,
        0 => APERIODIC,
        n => u32::from(n).min(MOST),
    };
    let recording = dynamics::record(system, verdict.state, 0, periods, SAMPLES);
    draw(system, &recording, verdict, &[OrbitPanel::portrait(family)], "portrait", width, task);
    draw(system, &recording, verdict, &[OrbitPanel::time_series(family)], "series", width, task);
}

/// Sends the Poincaré section of a motion that does not repeat.
pub fn section(system: &System, verdict: &Verdict, width: u32, task: &Task) {
    let repeats = verdict.regime.is_periodic() || verdict.regime == Regime::NoImpact;
    if repeats {
        return;
    }
    let recording = dynamics::record(system, verdict.state, 0, SECTION, 1);
    let panels = [OrbitPanel::Section(Section::A, [Reading::Tau, Reading::VAfter])];
    draw(system, &recording, verdict, &panels, "section", width, task);
}

fn draw(
    system: &System,
    recording: &Recording,
    verdict: &Verdict,
    panels: &[OrbitPanel],
    kind: &str,
    width: u32,
    task: &Task,
) {
    if let Some(why) = recording.given_up {
        return task.answer(kind, json!({ "none": why.to_string() }));
    }
    let orbit = Orbit { system, recording, sections: recording };
    let mut figure = orbit_figure(&orbit, Start::State(verdict.state), panels, &[]);
    // The panel's own heading says where it is.
    figure.title.clear();
    let width = width.clamp(280, 2000);
    let low = Size::new(width, width * 5 / 8).ok().filter(|_| kind == "series");
    let size = low.map_or_else(|| figure.natural_size(width), |low| figure.at_least(low));
    match figure.draw(size, "{}") {
        Ok(picture) => task.answer(kind, json!({ "svg": picture.svg() })),
        Err(error) => task.answer(kind, json!({ "none": error.to_string() })),
    }
}
