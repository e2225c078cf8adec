//! The curves L1 to L7 of Fig. 5: whether they part the regions that the paper says they part.

use super::Claim;
use super::regions::Region;
use crate::curves::{Criticality, Curve, CurvePoint, Kind};
use crate::plane::RegionMap;

/// How far from a curve the regions on its two sides are looked for, in cells.
const BESIDE: f64 = 2.0;
/// The share of its length along which a curve has to part its regions: the plane is multistable, and a map shows one motion of
/// each place.
const PARTS: f64 = 0.2;

/// A curve of Fig. 5.
struct Line {
    name: &'static str,
    what: &'static str,
    kind: Kind,
    label: &'static str,
    symmetric: bool,
    criticality: Option<Criticality>,
    parts: [(&'static str, Region); 2],
}

impl Line {
    const fn new(
        name: &'static str,
        what: &'static str,
        kind: Kind,
        label: &'static str,
        symmetric: bool,
    ) -> Self {
        let none = ("", Region::Irregular);
        Line { name, what, kind, label, symmetric, criticality: None, parts: [none, none] }
    }

    const fn parting(self, from: (&'static str, Region), to: (&'static str, Region)) -> Self {
        Line { parts: [from, to], ..self }
    }

    const fn only(self, criticality: Criticality) -> Self {
        Line { criticality: Some(criticality), ..self }
    }

    fn has(&self, curve: &Curve) -> bool {
        curve.kind == self.kind
            && curve.motion.label() == self.label
            && curve.motion.symmetric == self.symmetric
    }

    fn has_point(&self, point: &CurvePoint) -> bool {
        point.bounding && self.criticality.is_none_or(|criticality| point.criticality == Some(criticality))
    }
}

/// Each curve is there if the continuation finds it and the map's cells on its sides are those of its regions.
pub(super) fn lines(map: &RegionMap, curves: &[Curve]) -> Vec<Claim> {
    let of = |name: &'static str| (name, Region::Of(name));
    let irregular = |name: &'static str| (name, Region::Irregular);
    let ns = Kind::NeimarkSacker;
    let all = [
        Line::new("L1", "supercritical Neimark–Sacker of 1-1-1 symmetric", ns, "1-1-1", true)
            .only(Criticality::Supercritical)
            .parting(of("R1"), irregular("R7")),
        Line::new("L2", "subcritical Neimark–Sacker of 1-1-1 symmetric", ns, "1-1-1", true)
            .only(Criticality::Subcritical)
            .parting(of("R1"), irregular("R7")),
        Line::new("L3", "pitchfork of 1-1-1 symmetric", Kind::Pitchfork, "1-1-1", true)
            .parting(of("R1"), of("R2")),
        Line::new("L4", "Neimark–Sacker of 1-1-1 unsymmetric", ns, "1-1-1", false)
            .parting(of("R2"), irregular("R3")),
        Line::new("L5", "1-2-2 symmetric appears out of chaos", Kind::Fold, "1-2-2", true)
            .parting(irregular("R3"), of("R4")),
        Line::new("L6", "pitchfork of 1-2-2 symmetric", Kind::Pitchfork, "1-2-2", true)
            .parting(of("R4"), of("R5")),
        Line::new("L7", "period doubling of 1-2-2 unsymmetric", Kind::PeriodDoubling, "1-2-2", false)
            .parting(of("R5"), ("R6", Region::Cascade)),
    ];
    all.iter().map(|line| claim(map, curves, line)).collect()
}

fn claim(map: &RegionMap, curves: &[Curve], line: &Line) -> Claim {
    let [(from, _), (to, _)] = line.parts;
    let mut found = Parting::default();
    for curve in curves.iter().filter(|curve| line.has(curve)) {
        for pair in curve.points.windows(2).filter(|pair| pair.iter().all(|point| line.has_point(point))) {
            found.look(map, line.parts.map(|(_, region)| region), &pair[0], &pair[1]);
        }
    }
    let share = found.share();
    let computed = share.map_or_else(
        || "not found".to_owned(),
        |share| {
            let range = |i: usize| format!("{:.3} to {:.3}", found.low[i], found.high[i]);
            format!(
                "ω {}, δ {}; parts {from} from {to} along {:.0} % of its length",
                range(0),
                range(1),
                100.0 * share
            )
        },
    );
    let holds = share.is_some_and(|share| share > PARTS);
    let printed = format!("{}, between {from} and {to}", line.what);
    let note =
        format!("from the map's cells {BESIDE} cells off on either side, held to {:.0} %", 100.0 * PARTS);
    Claim::new(5, format!("curve {}", line.name), printed, computed, holds).noted(note)
}

/// How much of a curve parts its regions.
#[derive(Debug)]
struct Parting {
    /// The length along which it does, and all of it that has cells on both sides; in cells.
    parted: f64,
    length: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Default for Parting {
    fn default() -> Self {
        Parting { parted: 0.0, length: 0.0, low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] }
    }
}

impl Parting {
    /// Looks at the cells beside the middle of a piece of a curve.
    fn look(&mut self, map: &RegionMap, regions: [Region; 2], a: &CurvePoint, b: &CurvePoint) {
        for (i, values) in [[a.x, b.x], [a.y, b.y]].iter().enumerate() {
            self.low[i] = values.iter().fold(self.low[i], |low, &value| low.min(value));
            self.high[i] = values.iter().fold(self.high[i], |high, &value| high.max(value));
        }
        let at = |point: &CurvePoint| [map.plane.x.place(point.x), map.plane.y.place(point.y)];
        let (a, b) = (at(a), at(b));
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]);
        let beside = |side: f64| {
            let [x, y] = [
                0.5 * (a[0] + b[0]) - side * BESIDE * along[1] / length,
                0.5 * (a[1] + b[1]) + side * BESIDE * along[0] / length,
            ]
            .map(f64::round);
            let inside = |value: f64, count: u32| (0.0..f64::from(count)).contains(&value);
            (inside(x, map.plane.x.count) && inside(y, map.plane.y.count)).then(|| map.at(x as u32, y as u32))
        };
        let (Some(left), Some(right)) = (beside(1.0), beside(-1.0)) else { return };
        let [from, to] = regions;
        self.length += length;
        if (from.has(left) && to.has(right)) || (from.has(right) && to.has(left)) {
            self.parted += length;
        }
    }

    /// The share of its length along which the curve parts its regions; none if there is nothing to look at.
    fn share(&self) -> Option<f64> {
        (self.length > 0.0).then(|| self.parted / self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::backend::{Cpu, Unwatched};
    use crate::curves::bifurcation_curves;
    use crate::plane::{Plane, Start};
    use crate::reproduce::Outcome;
    use crate::sweep::sweep;

    #[test]
    fn a_curve_elsewhere_does_not_part_its_regions() {
        let schedule = Schedule { transient: 200, observe: 100, max_period: 8, fixed_periods: false };
        let plane =
            Plane::of_paper("omega=3.3:4.1:40", "delta=0.08:0.14:20", Start::Symmetric, schedule).unwrap();
        let map = sweep(&plane, &Cpu, &Unwatched).unwrap();
        let mut curves = bifurcation_curves(&map, 1).unwrap().curves;
        let verdict = |curves: &[Curve]| {
            let claims = lines(&map, curves);
            claims.iter().find(|claim| claim.claim == "curve L3").unwrap().verdict
        };
        assert_eq!(verdict(&curves), Outcome::Agrees);
        for point in curves.iter_mut().flat_map(|curve| &mut curve.points) {
            point.y -= 0.02;
        }
        assert_eq!(verdict(&curves), Outcome::Differs, "six cells off");
        assert_eq!(verdict(&[]), Outcome::Differs, "no curve");
    }
}
