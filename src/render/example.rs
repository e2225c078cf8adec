//! A plane to draw in tests: many motions, thin regions, long names.

use crate::analysis::{INFINITELY_MANY, Regime, Schedule, Verdict};
use crate::curves::{Criticality, Curve, CurveMotion, CurvePoint, End, Kind, Special};
use crate::plane::{Plane, Provenance, RegionMap, Start, Window};

/// A plane over the forcing frequency and the clearance with the given verdicts.
pub(super) fn of(columns: u32, rows: u32, cell: impl Fn(u32, u32) -> Verdict) -> RegionMap {
    let schedule = Schedule { transient: 500, observe: 500, max_period: 64, fixed_periods: false };
    let (x, y) = (format!("omega=0.2:5:{columns}"), format!("delta=0.02:0.8:{rows}"));
    let plane = Plane::of_paper(&x, &y, Start::Symmetric, schedule).unwrap();
    let verdicts = Window::whole(&plane).places().map(|(column, row)| cell(column, row)).collect();
    RegionMap::new(plane, Provenance::default(), verdicts)
}

/// A plane that looks a little like the one of the paper.
pub(super) fn map(columns: u32, rows: u32) -> RegionMap {
    of(columns, rows, |column, row| {
        let x = f64::from(column) / f64::from(columns - 1);
        let y = f64::from(row) / f64::from(rows - 1);
        motion(x, y, column * 31 + row * 17)
    })
}

/// Curves over a plane of any extent: one that turns from sub- to supercritical, two that bound and one that does not.
pub(super) fn curves(map: &RegionMap) -> Vec<Curve> {
    let curve = |kind, counts: [u32; 3], bounding, height: fn(f64) -> f64| {
        let [n, p, q] = counts;
        let point = |i: u32| {
            let share = f64::from(i) / 100.0;
            let (x, y) = (&map.plane.x, &map.plane.y);
            let critical = match kind {
                Kind::Fold | Kind::Grazing => None,
                Kind::NeimarkSacker if i < 50 => Some(Criticality::Subcritical),
                _ => Some(Criticality::Supercritical),
            };
            CurvePoint {
                x: x.first + share * (x.last - x.first),
                y: y.first + height(share) * (y.last - y.first),
                criticality: critical,
                bounding,
                special: (i == 50 && kind == Kind::NeimarkSacker).then_some(Special::Chenciner),
            }
        };
        Curve {
            kind,
            motion: CurveMotion { n, impacts: vec![p, q], image: Some(vec![q, p]), symmetric: true },
            touches: None,
            points: (0..=100).map(point).collect(),
            ends: [End::LeavesPlane; 2],
        }
    };
    vec![
        curve(Kind::NeimarkSacker, [1, 1, 1], true, |x| 0.6 + 0.3 * (x - 0.5).powi(2)),
        curve(Kind::Pitchfork, [1, 1, 1], true, |x| 0.2 + 0.2 * x),
        curve(Kind::Fold, [1, 1, 1], true, |x| 0.9 - 0.1 * x),
        curve(Kind::Grazing, [1, 3, 3], false, |x| 0.5 - 0.1 * x),
    ]
}

fn motion(x: f64, y: f64, cell: u32) -> Verdict {
    let periodic = |counts, symmetric| Verdict::of_motion(Regime::Periodic, counts, symmetric);
    let other = |regime| Verdict::of_motion(regime, [0; 3], false);
    let sticking = |counts, symmetric| Verdict::of_motion(Regime::PeriodicSticking, counts, symmetric);
    let infinite = INFINITELY_MANY;
    let wave = y + 0.05 * (9.0 * x).sin();
    let radius = (x - 0.3).hypot(1.4 * (y - 0.45));
    if x < 0.004 && y < 0.004 {
        return other(Regime::Failed);
    }
    if wave > 0.93 - 0.3 * x * x {
        return other(Regime::NoImpact);
    }
    if x < 0.1 - 0.04 * y {
        return sticking([1, infinite, infinite], y < 0.5);
    }
    if x < 0.16 - 0.05 * y {
        return other(Regime::AperiodicSticking);
    }
    if radius < 0.14 {
        let ring = (radius / 0.014) as u16;
        return match ring {
            0..4 => other(Regime::Chaotic),
            4 => periodic([4, 8, 8], false),
            5 => periodic([2, 4, 4], false),
            6..8 => periodic([1, 2, 2], false),
            _ => periodic([1, 2, 2], true),
        };
    }
    if (radius - 0.2).abs() < 0.004 {
        return periodic([3, 5, 5], true);
    }
    if x + 0.2 * wave < 0.5 {
        let tongue = (40.0 * (x + 0.6 * wave * wave)) as u16;
        return match tongue % 5 {
            0 => periodic([1, 3, 3], cell.is_multiple_of(2)),
            1 => periodic([1, 4, 4], true),
            2 => periodic([3, tongue, tongue + 1], false),
            3 => periodic([2, tongue, tongue], false),
            _ => other(Regime::Chaotic),
        };
    }
    if x < 0.62 + 0.1 * wave {
        return match cell % 7 {
            0..3 => periodic([1, 1, 2], false),
            3..6 => periodic([1, 2, 1], false),
            _ => other(Regime::Unresolved),
        };
    }
    if wave < 0.25 {
        return match (60.0 * (x - 0.6)) as u16 {
            step @ 0..5 => periodic([5 + step, 6 + step, 6 + step], false),
            5..8 => periodic([3, 3, 3], true),
            8..11 => periodic([2, 2, 2], false),
            _ => periodic([1, 1, 1], false),
        };
    }
    if x < 0.7 { other(Regime::QuasiPeriodic) } else { periodic([1, 1, 1], true) }
}
