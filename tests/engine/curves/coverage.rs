//! Every motion that a map shows has a curve, or is listed.

use std::collections::BTreeMap;

use impact_atlas::analysis::Regime;
use impact_atlas::curves::{CurveMotion, Kind, PlaneCurves, Why, bifurcation_curves};
use impact_atlas::model::{Parameters, System};
use impact_atlas::plane::RegionMap;
use impact_atlas::theory::{Label, Search, labelled_motion};

use super::{map, of};

/// Cells of each motion, N, the larger and the smaller of p and q, symmetric, sticking: a motion and its mirror image
/// together.
fn tally(map: &RegionMap) -> BTreeMap<([u32; 3], bool, bool), usize> {
    let mut cells = BTreeMap::new();
    for v in map.verdicts.iter().filter(|v| v.regime.is_periodic()) {
        let counts = [v.n, v.p().max(v.q()), v.p().min(v.q())].map(u32::from);
        *cells.entry((counts, v.symmetric, v.regime == Regime::PeriodicSticking)).or_default() += 1;
    }
    cells
}

#[test]
fn every_motion_of_a_few_cells_is_bounded_or_listed() {
    let map = map("omega=1.3:3.1:70", "delta=0.05:0.3:48", Parameters::default());
    let PlaneCurves { curves, left_out } = bifurcation_curves(&map, 2).unwrap();
    let (mut bounded, mut listed) = (0, 0);
    for (([n, more, fewer], symmetric, sticks), cells) in tally(&map) {
        let is_it = |motion: &CurveMotion| {
            let [p, q] = motion.impacts[..] else { panic!("two stops") };
            (motion.n, p.max(q), p.min(q), motion.symmetric) == (n, more, fewer, symmetric)
        };
        let entry = left_out.iter().find(|l| is_it(&l.motion) && (l.why == Why::Sticks) == sticks);
        if let Some(entry) = entry {
            assert_eq!(entry.cells, cells, "{}", entry.name());
            listed += 1;
        } else {
            // What it loses itself in, or the simpler motion that it is born from.
            let own = curves.iter().any(|c| is_it(&c.motion));
            let simpler = curves.iter().any(|c| [Kind::Pitchfork, Kind::PeriodDoubling].contains(&c.kind));
            assert!(own || simpler, "{n}-{more}-{fewer}");
            bounded += usize::from(own);
        }
        let few = n <= 2 && cells >= 4 && more + fewer <= 40 && !sticks;
        assert!(!few || entry.is_none(), "{n}-{more}-{fewer} of {cells} cells: {:?}", entry.map(|e| e.why));
        assert!(n <= 2 || entry.is_some_and(|entry| entry.why == Why::LongPeriod), "{n}-{more}-{fewer}");
    }
    assert!(bounded >= 6 && listed >= 3, "{bounded} {listed}");
    assert!(left_out.is_sorted_by(|a, b| a.cells >= b.cells));

    // The motion that control aims at, from end to end.
    let named = curves.iter().any(|curve| curve.motion.label() == "1-2-1");
    let label = if named { Label::new(1, &[2, 1]) } else { Label::new(1, &[1, 2]) };
    let folds = of(&curves, Kind::Fold, &label.to_string(), false);
    let near = |x: f64, y: f64| {
        folds.iter().flat_map(|fold| &fold.points).any(|p| (p.x - x).hypot(p.y - y) < 0.02 && p.bounding)
    };
    assert!(near(2.94, 0.068) && near(1.47, 0.2215), "its losses at both ends");
    assert!(!near(1.47, 0.068) && !near(2.94, 0.2215), "the check can fail");
    let doublings = of(&curves, Kind::PeriodDoubling, &label.to_string(), false);
    let mut checked = 0;
    for point in doublings.iter().flat_map(|curve| curve.points.iter().step_by(9)) {
        let largest = |omega: f64| {
            let parameters = Parameters { omega, delta: point.y, ..Parameters::default() };
            let system = System::new(parameters).unwrap();
            let search = Search { start: vec![0.0; 4], transient: 200, observe: 1000 };
            let motion = labelled_motion(&system, label.clone(), &search).ok()?;
            Some(motion.multipliers(&system)?[0])
        };
        let (Some(at), Some(beside)) = (largest(point.x), largest(point.x * 1.003)) else { continue };
        // Another motion of the same label can be found first; none has −1 but by its period doubling.
        if (at + 1.0).norm() < 1e-5 {
            assert!((beside + 1.0).norm() > 1e-3, "{at} {beside} at {point:?}");
            checked += 1;
        }
    }
    assert!(checked >= 3, "{checked}");
}
