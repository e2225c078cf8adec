//! Several plots of one orbit as a figure, and what their marks stand for.

use super::Orbit;
use super::panel::OrbitPanel;
use super::zoom::Zoom;
use crate::analysis::Section;
use crate::figure::{Figure, KeyEntry, Mark, Paint, Panel, Row, Sample, Text};
use crate::plane::Start;
use crate::render::colours::{STICKING, STOP, STRIKING};
use crate::render::{places, symbols};
use crate::system::Family;

/// How many plots stand side by side.
const BESIDE: usize = 2;

/// A figure of several plots of one orbit, under the system's parameters and the start.
pub fn orbit_figure(orbit: &Orbit<'_>, start: Start, panels: &[OrbitPanel], zooms: &[Zoom]) -> Figure {
    let parameters = orbit.system.setting().expect("a system that is drawn is made of a setting");
    let mut title = symbols::equations(&parameters, |_| false);
    title.extend(symbols::start(start, parameters.has_mirror(), parameters.family(), |_| false));
    let mut plots: Vec<Panel> = panels.iter().map(|&panel| orbit.panel(panel, zooms)).collect();
    let family = parameters.family();
    let key = orbit_key(family, &plots);
    if plots.len() > 1 {
        for ((plot, panel), letter) in plots.iter_mut().zip(panels).zip('a'..) {
            plot.caption = Some(caption(*panel, letter, family));
        }
    } else {
        plots.iter_mut().zip(panels).for_each(|(plot, panel)| plot.caption = Some(words(*panel, family)));
    }
    let width = if plots.len() == 1 { 40.0 } else { 60.0 };
    Figure { title, rows: Row::of(plots, BESIDE, 1.0), key, notes: Vec::new(), width }
}

/// What the marks of such plots of a family's orbit stand for, as far as they are in view.
pub fn orbit_key(family: &'static Family, plots: &[Panel]) -> Vec<KeyEntry> {
    let shown = |wanted: &dyn Fn(&Mark) -> bool| {
        plots.iter().any(|plot| plot.marks.iter().any(|mark| wanted(mark) && mark.is_in(&plot.frame)))
    };
    let mut key = Vec::new();
    let is_stop = |mark: &Mark| {
        let (Mark::Upright { colour, .. } | Mark::Level { colour, .. } | Mark::Line { colour, .. }) = mark
        else {
            return false;
        };
        *colour == STOP
    };
    if shown(&is_stop) {
        key.push(KeyEntry { sample: Sample::Line(STOP), name: places::stops(family) });
    }
    if shown(&|mark| matches!(mark, Mark::Dots { colour: STRIKING, .. })) {
        key.push(KeyEntry { sample: Sample::Dot(STRIKING), name: "impact".into() });
    }
    if shown(&|mark| matches!(mark, Mark::Band { colour: STICKING, .. })) {
        key.push(KeyEntry { sample: Sample::Fill(Paint::plain(STICKING)), name: "sticking".into() });
    }
    key
}

fn caption(panel: OrbitPanel, letter: char, family: &'static Family) -> Text {
    Text::from(format!("({letter}) ")).then(words(panel, family))
}

/// What a plot is.
fn words(panel: OrbitPanel, family: &'static Family) -> Text {
    match panel {
        OrbitPanel::Portrait(_) => "phase portrait".into(),
        OrbitPanel::Time(_) => "time series".into(),
        OrbitPanel::Section(Section::Strobe, _) => "strobe section, forcing phase 0".into(),
        OrbitPanel::Section(Section::Impact(stop), _) => {
            Text::from("impact Poincaré section ").then(places::stop_place(family, stop.index()))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Reading;
    use crate::dynamics::record;
    use crate::model::{Parameters, System};

    #[test]
    fn the_key_lists_what_is_in_view() {
        let system = System::new(Parameters { omega: 0.25, delta: 0.545, ..Parameters::default() }).unwrap();
        let recording = record(&system, [0.0; 4], 100, 2, 100);
        let orbit = Orbit { system: &system, recording: &recording, sections: &recording };
        let names = |zooms: &[&str]| -> Vec<Text> {
            let zooms: Vec<Zoom> = zooms.iter().map(|zoom| zoom.parse().unwrap()).collect();
            let panel = orbit.panel(OrbitPanel::Time(Reading::X1), &zooms);
            orbit_key(Family::paper(), &[panel]).into_iter().map(|entry| entry.name).collect()
        };
        assert_eq!(names(&[]).len(), 3);
        assert_eq!(names(&["x1=-0.1:0.1"]), ["sticking".into()], "a band is as high as the plot");
        let rest = &recording.sticks[0];
        let from = |time: f64| (time - orbit.began()) / system.period();
        let (first, last) = (from(rest.from), from(rest.until));
        let inside = format!("t={}:{}", 0.9 * first + 0.1 * last, 0.1 * first + 0.9 * last);
        assert_eq!(names(&[&inside]).len(), 2, "no impact while it rests");
    }
}
