//! Bifurcation curves held to closed forms, to multipliers, to the simulation and to the map's own boundaries.

mod boundaries;
mod coverage;
mod families;
mod invariants;
mod places;
mod units;

use impact_atlas::analysis::Schedule;
use impact_atlas::backend::{Cpu, Unwatched};
use impact_atlas::curves::{Curve, Kind, bifurcation_curves};
use impact_atlas::model::Parameters;
use impact_atlas::plane::{Plane, RegionMap, Start};
use impact_atlas::sweep::sweep;

/// A map of a plane, started on the symmetric motion.
fn map(x: &str, y: &str, parameters: Parameters) -> RegionMap {
    let plane = Plane {
        x: x.parse().unwrap(),
        y: y.parse().unwrap(),
        parameters: parameters.into(),
        start: Start::Symmetric,
        task: Schedule { transient: 300, observe: 150, max_period: 8, fixed_periods: false },
    };
    sweep(&plane, &Cpu, &Unwatched).unwrap()
}

fn curves(map: &RegionMap) -> Vec<Curve> {
    bifurcation_curves(map, 2).unwrap().curves
}

/// The curves of one kind and motion.
fn of<'a>(curves: &'a [Curve], kind: Kind, label: &str, symmetric: bool) -> Vec<&'a Curve> {
    curves
        .iter()
        .filter(|c| c.kind == kind && c.motion.label() == label && c.motion.symmetric == symmetric)
        .collect()
}

/// Where a curve crosses a horizontal line.
fn crossings(curve: &Curve, y: f64) -> Vec<f64> {
    curve
        .points
        .windows(2)
        .filter(|pair| (pair[0].y - y) * (pair[1].y - y) <= 0.0 && pair[0].y != pair[1].y)
        .map(|pair| pair[0].x + (pair[1].x - pair[0].x) * (y - pair[0].y) / (pair[1].y - pair[0].y))
        .collect()
}

/// Where a curve crosses an upright line.
fn crossings_upright(curve: &Curve, x: f64) -> Vec<f64> {
    let mut turned = curve.clone();
    turned.points.iter_mut().for_each(|point| (point.x, point.y) = (point.y, point.x));
    crossings(&turned, x)
}
