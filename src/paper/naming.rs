//! Names of curves: the paper's on its plane, numbers elsewhere.

use std::collections::HashMap;
use std::ops::Range;

use super::names::{curve_name, is_plane_of_paper};
use crate::curves::{Criticality, Curve};
use crate::plane::{Axis, Plane};

/// A stretch of a curve that has one name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Named {
    /// Which of the curves.
    pub curve: usize,
    /// Its points; the next stretch of the curve begins with the next one.
    pub points: Range<usize>,
    /// The paper's name, L1 to L7; those of its kind that are shorter have primes: L3, L3', L3''.
    pub name: Option<String>,
}

impl Named {
    /// What tells it from all others in a file: the paper's name, or the number of the curve, from 1.
    pub fn identifier(&self) -> String {
        self.name.clone().unwrap_or_else(|| (self.curve + 1).to_string())
    }
}

/// The curves of a plane in stretches of one name; in the order of the curves and of their points.
///
/// The paper's names are given by motion, kind and criticality, on its plane alone.
pub fn named(curves: &[Curve], plane: &Plane) -> Vec<Named> {
    let paper = is_plane_of_paper(plane);
    let mut stretches = Vec::new();
    for (index, curve) in curves.iter().enumerate() {
        let names: Vec<Option<&str>> = criticalities(curve)
            .map(|criticality| curve_name(curve, criticality).filter(|_| paper))
            .collect();
        let mut first = 0;
        for run in names.chunk_by(|a, b| a == b) {
            let points = first..first + run.len();
            first = points.end;
            stretches.push((Named { curve: index, points, name: None }, run[0]));
        }
    }
    let mut longest: Vec<(f64, usize)> = stretches
        .iter()
        .enumerate()
        .map(|(i, (stretch, _))| (length(&curves[stretch.curve], stretch.points.clone(), plane), i))
        .collect();
    longest.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut given: HashMap<&str, usize> = HashMap::new();
    for (_, i) in longest {
        let (stretch, name) = &mut stretches[i];
        stretch.name = name.map(|name| {
            let before = given.entry(name).or_default();
            *before += 1;
            format!("{name}{}", "'".repeat(*before - 1))
        });
    }
    stretches.into_iter().map(|(stretch, _)| stretch).collect()
}

/// The criticality of every point; that of a neighbour where a point has none of its own.
fn criticalities(curve: &Curve) -> impl Iterator<Item = Option<Criticality>> {
    let known = || curve.points.iter().map(|point| point.criticality);
    let first = known().flatten().next();
    known().scan(first, |last, own| {
        *last = own.or(*last);
        Some(*last)
    })
}

/// The length of a stretch, in sides of the plane.
fn length(curve: &Curve, points: Range<usize>, plane: &Plane) -> f64 {
    let step = |axis: &Axis, from: f64, to: f64| axis.share(to) - axis.share(from);
    curve.points[points]
        .windows(2)
        .map(|pair| step(&plane.x, pair[0].x, pair[1].x).hypot(step(&plane.y, pair[0].y, pair[1].y)))
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::curves::{CurveMotion, CurvePoint, End, Kind};
    use crate::model::Parameters;
    use crate::plane::Start;

    fn plane(x: &str, parameters: Parameters) -> Plane {
        let schedule = Schedule { transient: 1, observe: 1, max_period: 1, fixed_periods: false };
        let plane = Plane::of_paper(x, "delta=0.1:0.5:5", Start::Symmetric, schedule).unwrap();
        Plane { parameters: parameters.into(), ..plane }
    }

    /// A level curve; subcritical up to `turn`.
    fn curve(kind: Kind, counts: [u32; 3], symmetric: bool, omegas: &[f64], turn: f64) -> Curve {
        let [n, p, q] = counts;
        let point = |&x: &f64| CurvePoint {
            x,
            y: 0.2,
            criticality: Some(if x < turn { Criticality::Subcritical } else { Criticality::Supercritical }),
            bounding: true,
            special: None,
        };
        Curve {
            kind,
            motion: CurveMotion { n, impacts: vec![p, q], image: Some(vec![q, p]), symmetric },
            touches: None,
            points: omegas.iter().map(point).collect(),
            ends: [End::LeavesPlane; 2],
        }
    }

    fn identifiers(curves: &[Curve], plane: &Plane) -> Vec<(usize, Range<usize>, String)> {
        named(curves, plane).into_iter().map(|s| (s.curve, s.points.clone(), s.identifier())).collect()
    }

    #[test]
    fn names_follow_motion_kind_and_criticality() {
        let curves = [
            curve(Kind::NeimarkSacker, [1, 1, 1], true, &[1.0, 1.1, 1.2, 1.3, 1.4], 1.15),
            curve(Kind::Pitchfork, [1, 1, 1], true, &[2.0, 2.2], 0.0),
            curve(Kind::Pitchfork, [1, 1, 1], true, &[1.0, 2.2], 0.0),
            curve(Kind::Fold, [1, 1, 1], true, &[1.0, 2.2], 0.0),
            curve(Kind::NeimarkSacker, [1, 1, 1], false, &[1.0, 2.2], 0.0),
        ];
        let expected = [
            (0, 0..2, "L2"),
            (0, 2..5, "L1"),
            (1, 0..2, "L3'"),
            (2, 0..2, "L3"),
            (3, 0..2, "4"),
            (4, 0..2, "L4"),
        ];
        let expected = expected.map(|(curve, points, name)| (curve, points, name.to_owned()));
        assert_eq!(identifiers(&curves, &plane("omega=0.5:3:5", Parameters::default())), expected);
    }

    #[test]
    fn other_planes_have_numbers_alone() {
        let curves = [curve(Kind::NeimarkSacker, [1, 1, 1], true, &[1.0, 1.1, 1.2], 1.05)];
        let numbered = [(0, 0..3, "1".to_owned())];
        let other = Parameters { r: 0.7, ..Parameters::default() };
        assert_eq!(identifiers(&curves, &plane("omega=0.5:3:5", other)), numbered);
        assert_eq!(identifiers(&curves, &plane("zeta=0.05:0.3:5", Parameters::default())), numbered);
        assert_eq!(identifiers(&curves, &plane("omega=0.5:3:5", Parameters::default())).len(), 2);
    }
}
