//! What holds of every curve on any plane, borders of physical ranges included.

use std::sync::LazyLock;

use impact_atlas::curves::{Curve, End, Special};
use impact_atlas::model::Parameters;
use impact_atlas::plane::RegionMap;

use super::{curves, map};

/// Small planes of all sorts, and their curves.
static PLANES: LazyLock<Vec<(RegionMap, Vec<Curve>)>> = LazyLock::new(|| {
    let paper = Parameters::default();
    let maps = vec![
        map("omega=1:3:32", "delta=0.05:0.7:24", paper),
        map("omega=2:5:32", "zeta=0:0.3:20", paper),
        map("r=0:1:24", "delta=0.05:0.3:20", Parameters { omega: 2.5, ..paper }),
        map("omega=2:4:24", "f20=0:1:16", paper),
        map("mu_m=0.05:0.95:24", "mu_k=0.05:0.95:20", paper),
    ];
    let with_curves = |map: RegionMap| {
        let found = curves(&map);
        (map, found)
    };
    maps.into_iter().map(with_curves).collect()
});

/// The points of a curve as shares of the plane's sides.
fn places(map: &RegionMap, curve: &Curve) -> Vec<[f64; 2]> {
    let share =
        |axis: &impact_atlas::plane::Axis, value: f64| (value - axis.first) / (axis.last - axis.first);
    curve.points.iter().map(|point| [share(&map.plane.x, point.x), share(&map.plane.y, point.y)]).collect()
}

fn step(a: &[f64; 2], b: &[f64; 2]) -> [f64; 2] {
    [b[0] - a[0], b[1] - a[1]]
}

#[test]
fn curves_are_sound_on_any_plane() {
    let (mut seen, mut closed) = (0, 0);
    for (map, found) in PLANES.iter() {
        assert!(!found.is_empty(), "{} {}", map.plane.x, map.plane.y);
        for curve in found {
            let context =
                || format!("{:?} of {:?} on {} {}", curve.kind, curve.motion, map.plane.x, map.plane.y);
            let places = places(map, curve);
            assert!(
                places.iter().flatten().all(|share| (-1e-9..=1.0 + 1e-9).contains(share)),
                "{}",
                context()
            );
            // It closes at both ends or at none, and then comes back to its first point.
            let closes = curve.ends.map(|end| end == End::Closes);
            assert_eq!(closes[0], closes[1], "{}", context());
            if closes[0] {
                assert_eq!(places.first(), places.last(), "{}", context());
                closed += 1;
            }
            for ends in [(0, curve.points.first()), (1, curve.points.last())] {
                let (which, Some(point)) = ends else { continue };
                let named = match curve.ends[which] {
                    End::Resonance11 => point.special == Some(Special::Resonance11),
                    End::Resonance12 => point.special == Some(Special::Resonance12),
                    End::Grazes | End::ImpactVanishes => point.special == Some(Special::Grazing),
                    _ => true,
                };
                assert!(named, "{} ends with {:?} at {point:?}", context(), curve.ends[which]);
                let edge = |share: f64| share.min(1.0 - share);
                let at_border = |[x, y]: [f64; 2]| edge(x).min(edge(y)) < 1e-5;
                let place = if which == 0 { places[0] } else { places[places.len() - 1] };
                assert!(
                    curve.ends[which] != End::Stalled || !at_border(place),
                    "{} stalls at the border",
                    context()
                );
            }
            // No leap, and no turning back but at a cusp or beside one.
            for (k, triple) in places.windows(3).enumerate() {
                let ([ax, ay], [bx, by]) = (step(&triple[0], &triple[1]), step(&triple[1], &triple[2]));
                let (a, b) = (ax.hypot(ay), bx.hypot(by));
                assert!(a < 0.02 && b < 0.02, "{} leaps", context());
                let turns = a > 1e-4 && b > 1e-4 && (ax * bx + ay * by) < -0.5 * a * b;
                let around = &curve.points[k.saturating_sub(2)..(k + 5).min(curve.points.len())];
                let cusp = around.iter().any(|point| point.special == Some(Special::Cusp));
                assert!(!turns || cusp, "{} turns back at {:?}", context(), curve.points[k + 1]);
            }
            seen += 1;
        }
    }
    assert!(seen > 30, "{seen} curves, {closed} closed");
}

/// Where a curve begins or ceases to bound a stable motion something else is critical too, and has a name.
#[test]
fn stability_changes_at_named_points() {
    let mut changes = 0;
    for (_, found) in &PLANES[..2] {
        // Without impact nothing is critical but at ζ = 0.
        for curve in found.iter().filter(|curve| curve.motion.count() > 0) {
            for (k, pair) in curve.points.windows(2).enumerate() {
                if pair[0].bounding == pair[1].bounding {
                    continue;
                }
                let around = &curve.points[k.saturating_sub(2)..(k + 4).min(curve.points.len())];
                let named = around.iter().any(|point| point.special.is_some());
                assert!(named, "{:?} of {:?} at {:?}", curve.kind, curve.motion, pair[0]);
                changes += 1;
            }
        }
    }
    assert!(changes > 5, "{changes}");
}
