//! Where the curves are, and what they are.

use std::sync::atomic::{AtomicUsize, Ordering};

use impact_atlas::curves::{
    Criticality, CurvePoint, CurvesError, End, Kind, Special, bifurcation_curves, bifurcation_curves_until,
};
use impact_atlas::dynamics::{Stop, record};
use impact_atlas::model::{Parameters, System};
use impact_atlas::theory::{symmetric_motions, symmetric_start};

use super::{crossings, curves, map, of};

/// The half map's multipliers of the physical symmetric motion.
fn half_multipliers(omega: f64, delta: f64) -> Vec<(f64, f64)> {
    half_multipliers_where_physical(omega, delta).expect("a physical motion")
}

fn half_multipliers_where_physical(omega: f64, delta: f64) -> Option<Vec<(f64, f64)>> {
    let system = System::new(Parameters { omega, delta, ..Parameters::default() }).unwrap();
    let solutions = symmetric_motions(&system).ok()?;
    let motion = &solutions.iter().find(|s| s.at_phase_zero.is_ok())?.motion;
    Some(motion.half_multipliers(&system)?.iter().map(|m| (m.re, m.im)).collect())
}

#[test]
fn the_pitchfork_of_the_symmetric_motion_is_where_the_paper_has_it() {
    let found = curves(&map("omega=2.9:4.2:40", "delta=0.06:0.2:30", Parameters::default()));
    let pitchfork = of(&found, Kind::Pitchfork, "1-1-1", true);
    assert_eq!(pitchfork.len(), 1, "it is found from both sides, and kept once");
    let [omega] = crossings(pitchfork[0], 0.1)[..] else { panic!("one crossing") };
    assert!((omega - 3.6907).abs() < 5e-5, "{omega}");
    assert!(pitchfork[0].points.iter().all(|p| p.criticality == Some(Criticality::Supercritical)));
    assert_eq!(pitchfork[0].ends, [End::LeavesPlane; 2]);
    for point in pitchfork[0].points.iter().step_by(7) {
        let off = half_multipliers(point.x, point.y)
            .iter()
            .map(|(re, im)| (re + 1.0).hypot(*im))
            .fold(9.0, f64::min);
        assert!(off < 1e-6, "a multiplier is −1: {off:.1e}");
        let beside = half_multipliers(point.x * 1.001, point.y);
        assert!(beside.iter().all(|(re, im)| (re + 1.0).hypot(*im) > 1e-6), "the check can fail");
    }
    // The paper's L4, between two 1:2 resonances on the period doubling of the unsymmetric motion.
    let torus = of(&found, Kind::NeimarkSacker, "1-1-1", false);
    assert_eq!(torus.len(), 1);
    assert_eq!(torus[0].ends, [End::Resonance12; 2]);
}

#[test]
fn the_neimark_sacker_curve_goes_around_its_turning_points() {
    let found = curves(&map("omega=1.3:2.8:50", "delta=0.5:0.7:30", Parameters::default()));
    let torus = of(&found, Kind::NeimarkSacker, "1-1-1", true);
    assert_eq!(torus.len(), 1);
    let at_printed = crossings(torus[0], 0.6);
    assert!(at_printed.iter().any(|omega| (2.57..2.582).contains(omega)), "{at_printed:?}");
    assert!(at_printed.len() > 2, "δ is no function of ω, nor ω of δ: {at_printed:?}");
    for point in torus[0].points.iter().step_by(5) {
        let moduli = half_multipliers(point.x, point.y).into_iter().map(|(re, im)| re.hypot(im));
        let off = moduli.map(|modulus| (modulus - 1.0).abs()).fold(9.0, f64::min);
        assert!(off < 1e-6, "a pair lies on the unit circle: {off:.1e}");
    }
    // The paper says 0.5352 for the lowest point; it is 0.5422, and the fold comes down to 0.5482.
    let lowest =
        |points: &mut dyn Iterator<Item = (f64, f64)>| points.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap();
    let (omega, delta) = lowest(&mut torus[0].points.iter().map(|p| (p.x, p.y)));
    assert!((omega - 2.508).abs() < 0.01 && (delta - 0.5422).abs() < 1e-4, "{omega} {delta}");
    let folds = of(&found, Kind::Fold, "1-1-1", true);
    let (omega, delta) = lowest(&mut folds.iter().flat_map(|fold| &fold.points).map(|p| (p.x, p.y)));
    assert!((omega - 1.464).abs() < 0.01 && (delta - 0.5482).abs() < 1e-4, "{omega} {delta}");
    let criticality: Vec<_> = torus[0].points.iter().filter_map(|p| p.criticality).collect();
    for kind in [Criticality::Supercritical, Criticality::Subcritical] {
        assert!(criticality.contains(&kind), "the paper's L1 and L2");
    }
    let specials: Vec<Special> = torus[0].points.iter().filter_map(|p| p.special).collect();
    assert!(specials.contains(&Special::Chenciner), "where L1 turns into L2: {specials:?}");
    // It begins where the pair meets at +1, on the fold.
    assert!(torus[0].ends.contains(&End::Resonance11));
    let resonance = |special: &Option<Special>| *special == Some(Special::Resonance11);
    assert!(folds.iter().any(|fold| fold.points.iter().any(|p| resonance(&p.special))));
}

/// Without impact x1 has the amplitude |X(ω)| of two coupled oscillators, which can be written down.
#[test]
fn the_motion_without_impact_grazes_at_its_amplitude() {
    let found = curves(&map("omega=0.9:3:30", "delta=0.1:0.9:30", Parameters::default()));
    let grazing = of(&found, Kind::Grazing, "no impact", true);
    assert!(!grazing.is_empty());
    for point in grazing.iter().flat_map(|curve| &curve.points) {
        let (w, zeta) = (point.x, 0.1);
        // (1 − ω² + 2ζiω) X1 − (1 + 2ζiω) X2 = 1 and −(1 + 2ζiω) X1 + (2 − ω² + 4ζiω) X2 = 0.
        let complex = nalgebra::Complex::new;
        let coupling = complex(1.0, 2.0 * zeta * w);
        let second = complex(2.0 - w * w, 4.0 * zeta * w);
        let x1 = second / ((coupling - w * w) * second - coupling * coupling);
        assert!((x1.norm() - point.y).abs() < 1e-7, "{} {}", x1.norm(), point.y);
    }
}

#[test]
fn other_parameters_have_curves_too() {
    let parameters = Parameters { omega: 3.3, delta: 0.1, ..Parameters::default() };
    let found = curves(&map("r=0.4:0.95:30", "zeta=0.02:0.3:30", parameters));
    let smooth = found.iter().filter(|curve| curve.kind != Kind::Grazing).count();
    assert!(smooth > 0, "{found:?}");
    for curve in &found {
        assert!(curve.points.iter().all(|p| (0.4..=0.95).contains(&p.x) && (0.02..=0.3).contains(&p.y)));
    }
}

#[test]
fn the_same_map_gives_the_same_curves() {
    let map = map("omega=1.4:2:16", "delta=0.05:0.15:12", Parameters::default());
    let (first, second) = (curves(&map), curves(&map));
    assert!(!first.is_empty());
    assert_eq!(first, second);
}

#[test]
fn curves_that_nobody_wants_any_more_are_given_up_soon() {
    let map = map("omega=1.4:2:16", "delta=0.05:0.15:12", Parameters::default());
    let asked = AtomicUsize::new(0);
    let given_up_after = |most: usize| {
        asked.store(0, Ordering::Relaxed);
        let found =
            bifurcation_curves_until(&map, 2, &|| asked.fetch_add(1, Ordering::Relaxed) >= most).map(drop);
        (found, asked.load(Ordering::Relaxed))
    };
    let (whole, all) = given_up_after(usize::MAX);
    assert!(whole.is_ok() && all > 2000, "{whole:?} {all}");
    for most in [0, all / 100, all / 2] {
        let (found, asked) = given_up_after(most);
        assert_eq!(found, Err(CurvesError::Cancelled));
        // What was begun is left at its next step; what was not is not begun.
        assert!(asked < most + all / 4, "{asked} of {all} after {most}");
    }
}

#[test]
fn planes_that_have_no_curves_are_refused() {
    let start = bifurcation_curves(&map("omega=3:4:4", "r=0.8:0.8:1", Parameters::default()), 2);
    assert_eq!(start, Err(CurvesError::SingleValue("r")));
}

/// Just beyond the curve a supercritical loss leaves the trajectory near the motion, a subcritical one throws it far away.
#[test]
fn soft_and_hard_losses_of_stability_are_told_apart() {
    let found = curves(&map("omega=1.3:2.8:50", "delta=0.5:0.7:30", Parameters::default()));
    let torus = of(&found, Kind::NeimarkSacker, "1-1-1", true)[0];
    let strays = |point: &CurvePoint| {
        let is_unstable = |delta: &f64| {
            half_multipliers_where_physical(point.x, *delta)
                .is_some_and(|values| values.iter().any(|(re, im)| re.hypot(*im) > 1.0))
        };
        let unstable = [3e-4, -3e-4].map(|step| point.y + step).into_iter().find(is_unstable)?;
        let system =
            System::new(Parameters { omega: point.x, delta: unstable, ..Parameters::default() }).unwrap();
        let start = symmetric_start(&system)?;
        let impacts = record(&system, start, 20_000, 200, 0).impacts;
        let x2 = impacts.iter().filter(|impact| impact.stop == Stop::A).map(|impact| impact.state[1]);
        let (low, high) = x2.fold((f64::MAX, f64::MIN), |(low, high), x2| (low.min(x2), high.max(x2)));
        Some(if low > high { f64::INFINITY } else { high - low })
    };
    let (mut soft, mut hard) = (0, 0);
    for point in torus.points.iter().filter(|point| point.special.is_none()).step_by(9) {
        // Close to where the one turns into the other both are in between.
        if (point.x - 1.587).abs() < 0.06 {
            continue;
        }
        let Some(away) = strays(point) else { continue };
        match point.criticality {
            Some(Criticality::Supercritical) => {
                assert!(away < 0.3, "soft at {}, {}: {away}", point.x, point.y);
                soft += 1;
            }
            Some(Criticality::Subcritical) => {
                assert!(away > 0.3, "hard at {}, {}: {away}", point.x, point.y);
                hard += 1;
            }
            None => {}
        }
    }
    assert!(soft > 5 && hard > 1, "{soft} {hard}");
}
