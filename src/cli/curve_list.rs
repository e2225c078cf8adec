//! Bifurcation curves in words and as JSON.

use impact_atlas::analysis::Regime;
use impact_atlas::curves::{Criticality, Curve, CurvePoint, End, Kind, LeftOut, Why};
use impact_atlas::paper::{Named, named};
use impact_atlas::plane::Plane;
use serde::Serialize;
use strum::VariantArray;

use super::note;

/// Motions whose N was not asked for are named from so many cells on.
const NAMED: usize = 4;

/// Motions that are named for each reason at most.
const MOST_NAMED: usize = 12;

/// What is said about a curve in JSON.
#[derive(Debug, Serialize)]
pub struct CurveSummary {
    /// From 1; the curve in the table, where it has no name.
    number: usize,
    name: Option<String>,
    kind: Kind,
    motion: String,
    symmetric: bool,
    /// The stop that is grazed, where the stops have no mirror images.
    #[serde(skip_serializing_if = "Option::is_none")]
    stop: Option<&'static str>,
    /// Whether the motion's systems have a mirror.
    #[serde(skip)]
    mirror: bool,
    points: usize,
    ends: [End; 2],
    /// The shares of its points; all zero for folds and grazing.
    criticality: Shares,
    /// The share of its points where the motion is stable on one side.
    bounding: f64,
    special_points: Vec<SpecialPoint>,
}

#[derive(Debug, Serialize)]
struct Shares {
    supercritical: f64,
    subcritical: f64,
}

#[derive(Debug, Serialize)]
struct SpecialPoint {
    point: &'static str,
    x: f64,
    y: f64,
}

/// What is said about all curves of a plane.
pub fn summaries(curves: &[Curve], plane: &Plane) -> Vec<CurveSummary> {
    let names = named(curves, plane);
    let of = |index: usize| names.iter().filter(move |stretch| stretch.curve == index);
    curves
        .iter()
        .enumerate()
        .map(|(index, curve)| CurveSummary::new(index, curve, of(index), plane))
        .collect()
}

impl CurveSummary {
    fn new<'a>(
        index: usize,
        curve: &Curve,
        stretches: impl Iterator<Item = &'a Named>,
        plane: &Plane,
    ) -> Self {
        let mirror = curve.motion.image.is_some();
        let stops = plane.parameters.family().stops();
        let grazed = curve.touches.filter(|_| !mirror && stops.len() > 1);
        let mut names: Vec<&str> = stretches.filter_map(|stretch| stretch.name.as_deref()).collect();
        names.sort_unstable();
        names.dedup();
        let share = |wanted: &dyn Fn(&CurvePoint) -> bool| {
            curve.points.iter().filter(|point| wanted(point)).count() as f64 / curve.points.len() as f64
        };
        let special = |point: &CurvePoint| {
            point.special.map(|special| SpecialPoint { point: special.name(), x: point.x, y: point.y })
        };
        CurveSummary {
            number: index + 1,
            name: (!names.is_empty()).then(|| names.join("/")),
            kind: curve.kind,
            motion: curve.motion.label(),
            symmetric: curve.motion.symmetric,
            stop: grazed.map(|stop| stops[stop.index()].name.as_str()),
            mirror,
            points: curve.points.len(),
            ends: curve.ends,
            criticality: Shares {
                supercritical: share(&|point| point.criticality == Some(Criticality::Supercritical)),
                subcritical: share(&|point| point.criticality == Some(Criticality::Subcritical)),
            },
            bounding: share(&|point| point.bounding),
            special_points: curve.points.iter().filter_map(special).collect(),
        }
    }

    fn text(&self) -> String {
        let symmetric = match (self.motion.as_str(), self.mirror, self.symmetric) {
            (motion, ..) if motion == Regime::NoImpact.name() => "",
            (_, false, _) => "",
            (_, true, true) => " symmetric",
            (_, true, false) => " unsymmetric",
        };
        let at = self.stop.map(|stop| format!(" at stop {stop}")).unwrap_or_default();
        let title = format!("{} of {}{symmetric}{at}", self.kind.name(), self.motion);
        let criticality = match (self.criticality.supercritical, self.criticality.subcritical) {
            (0.0, 0.0) => String::new(),
            (share, 0.0) if share > 0.0 => ", supercritical".to_owned(),
            (0.0, _) => ", subcritical".to_owned(),
            (share, _) => format!(", {:.0} % supercritical", 100.0 * share),
        };
        let name = self.name.as_deref().unwrap_or("");
        let mut lines =
            vec![format!("{:>3}  {name:<6} {title:<42} {:>5} points{criticality}", self.number, self.points)];
        lines.push(format!("{:13}from: {}; to: {}", "", self.ends[0].name(), self.ends[1].name()));
        lines.extend(
            self.special_points.iter().map(|s| format!("{:13}{} at {:.6}, {:.6}", "", s.point, s.x, s.y)),
        );
        lines.join("\n")
    }
}

/// The curves in words, a line each and one for every special point.
pub fn text(summaries: &[CurveSummary], plane: &Plane) -> String {
    let count = match summaries.len() {
        0 => "no bifurcation curve".to_owned(),
        1 => "1 bifurcation curve".to_owned(),
        count => format!("{count} bifurcation curves"),
    };
    let (x, y) = (plane.x.quantity.name(), plane.y.quantity.name());
    let mut lines = vec![format!("{count}; special points at {x}, {y}")];
    lines.extend(summaries.iter().map(CurveSummary::text));
    lines.join("\n")
}

/// The motions without a curve, a line for every reason; none if there are none.
///
/// The largest are named; of the motions whose N was not asked for, those of very few cells are counted alone.
pub fn left_out(motions: &[LeftOut]) -> Option<String> {
    let line = |why: Why| {
        let of: Vec<&LeftOut> = motions.iter().filter(|motion| motion.why == why).collect();
        let named = |motion: &LeftOut| why != Why::LongPeriod || motion.cells >= NAMED;
        let cells = |count: usize| if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") };
        let told = of.iter().take(MOST_NAMED).take_while(|motion| named(motion)).count();
        let mut parts: Vec<String> =
            of[..told].iter().map(|motion| format!("{} ({})", motion.name(), cells(motion.cells))).collect();
        let others = &of[told..];
        if !others.is_empty() {
            let all = cells(others.iter().map(|motion| motion.cells).sum());
            parts.push(format!(
                "{} others ({all} in all, each with its label in the data of `map`)",
                others.len()
            ));
        }
        (!of.is_empty()).then(|| format!("no curve, {}: {}", why.words(), parts.join(", ")))
    };
    let lines: Vec<String> = Why::VARIANTS.iter().copied().filter_map(line).collect();
    (!lines.is_empty()).then(|| lines.join("\n"))
}

/// Says on standard error which motions have no curve.
pub fn note_left_out(motions: &[LeftOut]) {
    if let Some(text) = left_out(motions) {
        note(&text);
    }
}

#[cfg(test)]
mod tests {
    use impact_atlas::curves::CurveMotion;

    use super::*;

    #[test]
    fn the_largest_motions_without_a_curve_are_named_and_the_others_counted() {
        let motion = |cells: usize, why: Why| {
            let motion = CurveMotion { n: 3, impacts: vec![cells as u32, 1], image: None, symmetric: false };
            LeftOut { motion, cells, why }
        };
        let few: Vec<LeftOut> = (1..=40).rev().map(|cells| motion(cells, Why::Few)).collect();
        let text = left_out(&few).unwrap();
        assert_eq!(text.lines().count(), 1);
        assert!(text.contains("3-29-1 (29 cells), 28 others (406 cells in all"), "{text}");
        assert!(text.contains("3-40-1 (40 cells)") && !text.contains("3-28-1"), "{text}");
        let all = left_out(&few[..MOST_NAMED]).unwrap();
        assert!(all.ends_with("3-29-1 (29 cells)"), "{all}");
        let long = left_out(&[motion(4, Why::LongPeriod), motion(3, Why::LongPeriod)]).unwrap();
        assert!(long.contains("3-4-1 (4 cells), 1 others (3 cells in all"), "{long}");
        assert_eq!(left_out(&[]), None);
    }
}
