//! The panel of Lyapunov exponents, and what it leaves out.

use super::windows::Columns;
use crate::diagram::{Branch, Diagram, DiagramSpec, ExponentUnit};
use crate::figure::{AxisTitle, Colour, Frame, INK, MUTED, Mark, Panel, Scale, Text};
use crate::model::vector::MOST;
use crate::render::{places, symbols};

/// Lengths in em.
const LINE: f64 = 0.08;
const LEVEL: f64 = 0.06;
/// The dot of an exponent without neighbours, where there are few columns, and how many those are.
const SINGLE: f64 = 0.3;
const MANY: usize = 40;
/// The share of the lowest exponents that the panel of exponents may leave out, if they would take more room than this
/// share of what the others take.
const LEFT_OUT: f64 = 0.02;
const ROOM: f64 = 0.5;

/// The colours of the exponents, largest first.
pub(super) const COLOURS: [Colour; 2 * MOST] = [
    INK,
    image::Rgb([0x27, 0x6d, 0xad]),
    image::Rgb([0x0d, 0x7a, 0x63]),
    MUTED,
    image::Rgb([0xc4, 0x55, 0x00]),
    image::Rgb([0x8c, 0x79, 0xc7]),
    image::Rgb([0xa3, 0x94, 0x13]),
    image::Rgb([0xca, 0x90, 0xc5]),
];

/// The exponents of every column, largest first: a panel for every branch, all to one scale.
pub(super) fn exponent_panels(diagram: &Diagram) -> Vec<Panel> {
    let frame = frame(diagram);
    let several = diagram.branches.len() > 1;
    let panel = |branch: &Branch| {
        let spectrum = branch.spectrum.as_ref()?;
        let caption = several.then(|| format!("state carried {}", branch.direction.name()).into());
        let marks = marks(&diagram.spec.x.values(), spectrum);
        Some(Panel { caption, ..Panel::new(frame.clone(), marks) })
    };
    diagram.branches.iter().filter_map(panel).collect()
}

/// Lines through the exponents, and dots where one has no neighbour.
fn marks(values: &[f64], spectrum: &[Vec<f64>]) -> Vec<Mark> {
    let mut marks = vec![Mark::Level { y: 0.0, width: LEVEL, colour: MUTED }];
    let diameter = if values.len() > MANY { 1.5 * LINE } else { SINGLE };
    let count = spectrum.iter().map(Vec::len).max().unwrap_or(0);
    for (which, &colour) in COLOURS.iter().enumerate().take(count).rev() {
        // An exponent of −∞ interrupts its line.
        let exponent = |exponents: &[f64]| {
            let value = exponents[which];
            if value.is_finite() { value } else { f64::NAN }
        };
        let points: Vec<[f64; 2]> =
            values.iter().zip(spectrum).map(|(&x, exponents)| [x, exponent(exponents)]).collect();
        let there = |i: usize| points.get(i).is_some_and(|point| point[1].is_finite());
        let alone = |&i: &usize| there(i) && !there(i + 1) && !(i > 0 && there(i - 1));
        let dots = (0..points.len()).filter(alone).map(|i| points[i]).collect();
        marks.push(Mark::Dots { points: dots, diameter, colour });
        marks.push(Mark::Line { points, width: LINE, colour });
    }
    marks
}

/// The axes that all panels share.
fn frame(diagram: &Diagram) -> Frame {
    let spec = &diagram.spec;
    let shown = Exponents::of(diagram).shown;
    let unit = spec.spectrum.unwrap_or(ExponentUnit::Period);
    let short = match unit {
        ExponentUnit::Period => Text::new().italic("λ").upright(" per ").italic("T"),
        ExponentUnit::Iterate | ExponentUnit::Time => {
            Text::new().italic("λ").upright(format!(" per {}", unit.name()))
        }
    };
    Frame {
        x: Columns::of(&spec.x).scale(),
        y: Scale::around(shown.iter().copied().chain([0.0]), 0.06),
        x_title: symbols::axis_title(spec.x.quantity),
        y_title: AxisTitle { long: format!("Lyapunov exponents per {}", unit.name()).into(), short },
    }
}

/// What the panel of exponents shows of them.
pub(super) struct Exponents {
    /// The finite ones that are shown, in rising order.
    shown: Vec<f64>,
    /// Whether lower ones are left out.
    cut: bool,
    /// Whether some are −∞.
    lost: bool,
    /// Whether some columns have none.
    none: bool,
}

impl Exponents {
    pub fn of(diagram: &Diagram) -> Self {
        let all =
            || diagram.branches.iter().filter_map(|branch| branch.spectrum.as_ref()).flatten().flatten();
        let mut shown: Vec<f64> = all().copied().filter(|value| value.is_finite()).collect();
        shown.sort_by(f64::total_cmp);
        let rest = (LEFT_OUT * shown.len() as f64) as usize;
        let cut = match shown[..] {
            [lowest, .., highest] => shown[rest] - lowest > ROOM * (highest.max(0.0) - shown[rest]),
            _ => false,
        };
        if cut {
            shown.drain(..rest);
        }
        let lost = all().any(|&value| value == f64::NEG_INFINITY);
        Exponents { shown, cut, lost, none: all().any(|value| value.is_nan()) }
    }

    /// What the panel does not show, and why.
    pub fn notes(&self, spec: &DiagramSpec) -> Vec<Text> {
        let mut notes: Vec<Text> = Vec::new();
        if self.cut {
            notes.push("The lowest exponents are below the panel.".into());
        }
        if self.lost {
            notes.push("Exponents of −∞ are not drawn.".into());
        }
        if self.none && spec.spectrum == Some(ExponentUnit::Iterate) {
            notes.push("No exponents per iterate without impacts".into());
            let stop = ExponentUnit::counted_at(spec.probe.section).index();
            let at = Text::from("at ").then(places::stop_place(spec.parameters.family(), stop));
            notes.push(at.upright(", or with infinitely many."));
        }
        notes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagram::Sweep;
    use crate::render::diagram::tests::diagram;

    #[test]
    fn an_exponent_without_neighbours_is_a_dot() {
        let dots = |spectrum: &[Vec<f64>]| -> usize {
            let values: Vec<f64> = (0..spectrum.len()).map(|i| i as f64).collect();
            let count = |mark: &Mark| if let Mark::Dots { points, .. } = mark { points.len() } else { 0 };
            marks(&values, spectrum).iter().map(count).sum()
        };
        let (there, lost) = (|| vec![0.1, 0.0, -1.0, -2.0], || vec![f64::NEG_INFINITY; 4]);
        assert_eq!((dots(&[there()]), dots(&[there(), there()]), dots(&[lost()])), (4, 0, 0));
        assert_eq!(dots(&[there(), lost(), there(), there(), lost(), there()]), 8);
        assert_eq!((dots(&[vec![0.1, -1.0]]), dots(&[vec![0.5; 8]])), (2, 8), "as many as there are");
    }

    #[test]
    fn every_branch_has_a_panel_of_its_own() {
        let mut both = diagram("omega=5:0.2:100", Sweep::Both, 0.1, 0.07);
        both.branches[1].spectrum = Some(vec![vec![0.5, -0.5, -1.0, -1.5]; 100]);
        let panels = exponent_panels(&both);
        assert_eq!(panels.len(), 2);
        assert!(panels[0].caption != panels[1].caption && panels[0].marks != panels[1].marks);
        assert_eq!(panels[0].frame.y, panels[1].frame.y);
        let down = exponent_panels(&diagram("omega=5:0.2:100", Sweep::Down, 0.1, 0.07));
        assert_eq!((down.len(), &down[0].caption), (1, &None));
    }

    #[test]
    fn only_exponents_far_below_are_left_out() {
        let with = |lowest: f64| {
            let mut diagram = diagram("omega=5:0.2:100", Sweep::Down, 0.1, 0.07);
            let mut spectrum = vec![vec![0.5, -0.5, -1.0, -1.5]; 100];
            spectrum[7][3] = lowest;
            diagram.branches[0].spectrum = Some(spectrum);
            Exponents::of(&diagram)
        };
        let (near, far) = (with(-2.0), with(-20.0));
        assert_eq!((near.cut, near.shown[0]), (false, -2.0));
        assert_eq!((far.cut, far.shown[0]), (true, -1.5));
        let spec = DiagramSpec { spectrum: None, ..diagram("omega=5:0.2:100", Sweep::Down, 0.1, 0.07).spec };
        assert_eq!((near.notes(&spec).len(), far.notes(&spec).len()), (0, 1));
    }
}
