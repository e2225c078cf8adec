//! Bifurcation diagrams: what is read on a section over a parameter, with the motions along the top, chatter and
//! sticking shaded, and the Lyapunov exponents below.

mod exponents;
mod motions;
mod windows;

use self::exponents::{Exponents, exponent_panels};
use self::motions::Motions;
use self::windows::Columns;
use super::colours::{CHATTERING, OTHER_BRANCH, STEADY_BLUE, STICKING};
use super::{places, symbols};
use crate::analysis::{CHATTER_RUN, Section};
use crate::diagram::{Branch, Diagram, Direction};
use crate::figure::{Colour, Figure, Frame, KeyEntry, Mark, Paint, Panel, Row, Sample, Scale, Strip, Text};
use crate::plane::{Quantity, Start};
use crate::system::Family;

/// Lengths in em.
const DOT: std::ops::RangeInclusive<f64> = 0.055..=0.16;
/// The sum of the dots of all columns side by side, as far as their sizes permit.
const DOTS_ABREAST: f64 = 35.0;
/// The dots of so few columns are larger.
const FEW: u32 = 20;
const SINGLE: f64 = 0.35;

/// Draws a diagram as a figure, over its Lyapunov exponents if it has them.
pub fn diagram_figure(diagram: &Diagram) -> Figure {
    let spec = &diagram.spec;
    let varied = |quantity| quantity == spec.x.quantity;
    let mut title = symbols::equations(&spec.parameters, varied);
    title.extend(beginning(diagram));
    let motions = Motions::of(diagram);
    let mut rows = vec![Row { panels: vec![section_panel(diagram, &motions)], weight: 1.0 }];
    let below = exponent_panels(diagram).into_iter();
    rows.extend(below.map(|panel| Row { panels: vec![panel], weight: 0.62 }));
    let mut key = motions.key();
    key.extend(marks_key(diagram));
    Figure { title, rows, key, notes: notes(diagram), width: 58.0 }
}

/// How the columns begin, in pieces that belong together.
fn beginning(diagram: &Diagram) -> Vec<Text> {
    let spec = &diagram.spec;
    let family = spec.parameters.family();
    let varied = |component| spec.x.quantity == Quantity::Start(component);
    let mirrored = || (0..spec.x.count).any(|column| spec.parameters_at(column).has_mirror());
    match diagram.branches.as_slice() {
        [Branch { direction: Direction::Each, .. }] => {
            let crate::diagram::Sweep::Each(start) = spec.sweep else { return Vec::new() };
            symbols::start(start, start == Start::Symmetric && mirrored(), family, varied)
        }
        branches => {
            let names: Vec<&str> = branches.iter().map(|branch| branch.direction.name()).collect();
            let mut pieces = vec![format!("state carried {},", names.join(" and ")).into()];
            let mirrored = spec.start == Start::Symmetric && mirrored();
            pieces.extend(symbols::start(spec.start, mirrored, family, varied));
            pieces
        }
    }
}

fn colour(direction: Direction) -> Colour {
    if direction == Direction::Up { OTHER_BRANCH } else { STEADY_BLUE }
}

fn section_panel(diagram: &Diagram, motions: &Motions) -> Panel {
    let spec = &diagram.spec;
    let columns = Columns::of(&spec.x);
    let values = spec.x.values();
    let readings =
        || diagram.branches.iter().flat_map(|b| &b.traces).flat_map(|trace| trace.readings.iter().copied());
    let frame = Frame {
        x: columns.scale(),
        y: Scale::around(readings(), 0.04),
        x_title: symbols::axis_title(spec.x.quantity),
        y_title: symbols::title_on(&spec.parameters, spec.probe.section, spec.probe.reading),
    };
    let mut marks = Vec::new();
    for branch in &diagram.branches {
        let [chatter, sticking] = columns.bands(&branch.traces);
        marks.extend(chatter.into_iter().map(|x| Mark::Band { x, colour: CHATTERING }));
        marks.extend(sticking.into_iter().map(|x| Mark::Band { x, colour: STICKING }));
    }
    let diameter = match spec.x.count {
        ..=FEW => SINGLE,
        count => (DOTS_ABREAST / f64::from(count)).clamp(*DOT.start(), *DOT.end()),
    };
    for branch in &diagram.branches {
        let traces = values.iter().zip(&branch.traces);
        let points = traces.flat_map(|(&x, trace)| trace.readings.iter().map(move |&y| [x, y])).collect();
        marks.push(Mark::Dots { points, diameter, colour: colour(branch.direction) });
    }
    let strip = |branch: &Branch| Strip {
        stretches: columns.stretches(&branch.traces, &motions.paints),
        labels: columns.labels(&branch.traces, diagram.has_mirror()),
        name: (diagram.branches.len() > 1).then(|| branch.direction.name().into()),
    };
    let strips = diagram.branches.iter().map(strip).collect();
    Panel { strips, ..Panel::new(frame, marks) }
}

/// What dots, lines and bands stand for.
fn marks_key(diagram: &Diagram) -> Vec<KeyEntry> {
    let mut key = Vec::new();
    if diagram.branches.len() > 1 {
        for branch in &diagram.branches {
            let over = if branch.direction == Direction::Up { ", drawn over down" } else { "" };
            let name = format!("{}{over}", branch.direction.name()).into();
            key.push(KeyEntry { sample: Sample::Dot(colour(branch.direction)), name });
        }
    }
    let bands: Vec<_> =
        diagram.branches.iter().map(|branch| Columns::of(&diagram.spec.x).bands(&branch.traces)).collect();
    let marked = |which: usize| bands.iter().any(|bands| !bands[which].is_empty());
    if marked(0) {
        key.push(KeyEntry { sample: Sample::Fill(Paint::plain(CHATTERING)), name: "chatter".into() });
    }
    if marked(1) {
        key.push(KeyEntry { sample: Sample::Fill(Paint::plain(STICKING)), name: "sticking".into() });
    }
    if diagram.branches.iter().any(|branch| branch.spectrum.is_some()) {
        let exponents = 2 * diagram.spec.parameters.family().n();
        for (number, &colour) in (1..).zip(&exponents::COLOURS[..exponents]) {
            let name = Text::new().italic("λ").subscript(number.to_string());
            key.push(KeyEntry { sample: Sample::Line(colour), name });
        }
    }
    key
}

/// The section in words.
fn where_read(section: Section, family: &'static Family) -> Text {
    match section {
        Section::Impact(stop) => {
            Text::from("at impacts at ").then(places::stop_place(family, stop.index())).upright(".")
        }
        Section::Strobe => "at forcing phase 0.".into(),
    }
}

fn notes(diagram: &Diagram) -> Vec<Text> {
    let schedule = diagram.spec.schedule;
    let family = diagram.spec.parameters.family();
    let mut notes: Vec<Text> = vec![
        format!("After {} forcing periods, {} are shown", schedule.transient, schedule.observe).into(),
        where_read(diagram.spec.probe.section, family),
    ];
    notes.extend(places::label_definition(family, false));
    let last = notes.len() - 1;
    notes[last] = notes[last].clone().upright(".");
    let bands = diagram.branches.iter().map(|branch| Columns::of(&diagram.spec.x).bands(&branch.traces));
    if bands.into_iter().any(|[chatter, _]| !chatter.is_empty()) {
        notes.push(format!("Chatter: {CHATTER_RUN} or more impacts in a row at one stop,").into());
        notes.push("each slower than the one before.".into());
    }
    if diagram.left_out() > 0 {
        let capacity = diagram.spec.capacity;
        notes.push(format!("Of each column the first {capacity} points are shown.").into());
    }
    notes.extend(Exponents::of(diagram).notes(&diagram.spec));
    notes
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::analysis::Verdict;
    use crate::analysis::{Probe, Reading, Regime, Trace};
    use crate::diagram::{DiagramSpec, ExponentUnit, Sweep};
    use crate::figure::Size;
    use crate::figure::faults;
    use crate::model::Parameters;
    use crate::plane::Provenance;

    /// A diagram with every kind of column; readings of `spread` about `level`.
    pub(super) fn diagram(x: &str, sweep: Sweep, level: f64, spread: f64) -> Diagram {
        let spec = DiagramSpec {
            x: x.parse().unwrap(),
            parameters: Parameters { zeta: 1.0 / 3.0, mu_k: 2.0 / 3.0, ..Parameters::default() }.into(),
            sweep,
            start: Start::State([1.0 / 30.0, -2.0 / 3.0, 0.0, 1e-7].into()),
            probe: Probe::new(Section::B, Reading::VAfter).unwrap(),
            schedule: DiagramSpec::schedule(1000, 300, 32),
            capacity: 4,
            spectrum: Some(ExponentUnit::Iterate),
        };
        let count = spec.x.count;
        let trace = |i: u32| {
            let regime = Regime::ALL[Regime::ALL.len() * i as usize / count as usize];
            let readings = (0..4).map(|k| level + spread * f64::from((i * k) % 7)).collect();
            Trace {
                verdict: Verdict::of_motion(regime, [1, 2, 2], true),
                readings,
                left_out: i % 3,
                rebounds: i % 11,
            }
        };
        let exponents = |i: u32| {
            vec![
                0.1,
                -0.2,
                f64::from(i % 5) - 9.0,
                if i.is_multiple_of(2) { f64::NEG_INFINITY } else { f64::NAN },
            ]
        };
        let branch = |&direction: &Direction| Branch {
            direction,
            traces: (0..count).map(trace).collect(),
            spectrum: Some((0..count).map(exponents).collect()),
        };
        let branches = spec.sweep.branches().iter().map(branch).collect();
        let provenance = Provenance { version: "1".into(), backend: "cpu".into(), adapter: "none".into() };
        Diagram { spec, provenance, branches }
    }

    #[test]
    fn diagrams_of_every_kind_are_drawn_whole() {
        let each = Sweep::Each(Start::State([1.0 / 30.0, -2.0 / 3.0, 0.0, 1e-7].into()));
        for (x, sweep, level, spread) in [
            ("omega=5:0.2:400", Sweep::Both, 0.1, 0.07),
            ("mu_m=0.1:0.9:40", Sweep::Down, -1000.0, 1e-5),
            ("v1=-1e-7:3e-7:9", each, 0.0, 1e-9),
            ("omega=3.7:3.7:1", each, 0.3, 0.0),
        ] {
            let diagram = diagram(x, sweep, level, spread);
            for size in [(2000, 1560), (1200, 1000), (3000, 1800)] {
                let size = Size::new(size.0, size.1).unwrap();
                let picture = diagram_figure(&diagram).draw(size, &diagram.config()).unwrap();
                assert_eq!(faults(&picture, size), [""; 0], "{x}, {size:?}");
                let before = diagram_figure(&Diagram::blank(&diagram.spec));
                assert!(before.draw(size, "{}").is_ok(), "{x}, {size:?}");
                assert!(before.draw(Size::new(200, 100).unwrap(), "{}").is_err(), "{x}");
                let mut expected = vec!["λ", "forcing periods", "1-2-2 symmetric<", "chaotic<"];
                if diagram.spec.x.count == 1 {
                    expected.truncate(2);
                }
                if diagram.spec.x.count > 8 {
                    expected.extend([
                        "Chatter: 5 or more",
                        "first 4 points",
                        "Exponents of −∞",
                        "No exponents per iterate",
                    ]);
                }
                let missing = expected.into_iter().find(|words| !picture.svg().contains(words));
                assert_eq!(missing, None, "{x}");
            }
        }
    }
}
