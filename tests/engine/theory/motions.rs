//! Periodic motions and their multipliers.

use impact_atlas::dynamics::{Stop, record};
use impact_atlas::model::System;
use impact_atlas::theory::{
    Label, PeriodicMotion, Search, SectionVector, flip_coefficient, labelled_motion,
    neimark_sacker_coefficient, symmetric_motions,
};

use super::{assert_close, at};
use crate::common::scaled::scaled;

fn physical(omega: f64, delta: f64) -> PeriodicMotion {
    let solutions = symmetric_motions(&at(omega, delta)).expect("the motion exists");
    solutions.into_iter().find(|solution| solution.at_phase_zero.is_ok()).expect("one is physical").motion
}

#[test]
fn the_fixed_point_has_the_printed_digits() {
    let motion = physical(3.7, 0.1);
    assert_close(&motion.section(), &[-0.345457, -0.006341, 0.021160, 1.802134], 1e-6);
    assert!(motion.residual < 1e-12, "{}", motion.residual);
    assert_eq!((motion.label().as_str(), motion.is_symmetric()), ("1-1-1", true));
}

/// The multiplier −1 of the half map, by bisection.
#[test]
fn the_pitchfork_is_where_the_paper_has_it() {
    let stable = |omega: f64| physical(omega, 0.1).is_stable(&at(omega, 0.1)).unwrap();
    let (mut low, mut high) = (3.5, 3.8);
    assert!(!stable(low) && stable(high));
    while high - low > 1e-9 {
        let middle = 0.5 * (low + high);
        if stable(middle) { high = middle } else { low = middle }
    }
    assert!((high - 3.6907).abs() < 5e-5, "{high}");
    let (system, motion) = (at(high, 0.1), physical(high, 0.1));
    let leading = motion.half_multipliers(&system).unwrap()[0];
    assert!((leading.re + 1.0).abs() < 1e-6 && leading.im == 0.0, "{leading}");
    // Stable unsymmetric motions take over below: the pitchfork is supercritical.
    assert!(flip_coefficient(&system, &motion).unwrap() > 0.0);
}

#[test]
fn the_neimark_sacker_bifurcation_lies_in_its_window() {
    let radius = |omega: f64| physical(omega, 0.6).multipliers(&at(omega, 0.6)).unwrap()[0];
    let (below, above) = (radius(2.57), radius(2.582));
    assert!(below.norm() > 1.0 && above.norm() < 1.0, "{below} {above}");
    assert!(below.im > 0.0 && above.im > 0.0, "a complex pair crosses");
    let motion = physical(2.576, 0.6);
    let half = motion.half_multipliers(&at(2.576, 0.6)).unwrap()[0];
    let coefficient = neimark_sacker_coefficient(&at(2.576, 0.6), &motion, half.arg()).unwrap();
    assert!(coefficient < 0.0, "the paper shows a stable invariant circle at 2.57: {coefficient}");
}

#[test]
fn the_unstable_motion_inside_chaos_has_its_multipliers() {
    let system = at(2.83, 0.1);
    let search = Search { start: vec![0.0; 4], transient: 200, observe: 2000 };
    let motion = labelled_motion(&system, Label::new(1, &[2, 1]), &search).unwrap();
    let multipliers = motion.multipliers(&system).unwrap();
    let real: Vec<f64> = multipliers.iter().map(|value| value.re).collect();
    assert!(multipliers.iter().all(|value| value.im == 0.0));
    assert_close(&real, &[-1.4954, -0.6637, -0.5644, -0.1235], 5e-5);
    assert_close(&motion.section(), &[-0.41959403, -0.02899702, 0.02903494, 1.80721094], 1e-8);
    assert_eq!(motion.is_stable(&system), Some(false));
}

#[test]
fn it_is_found_in_any_unit_of_length() {
    for unit in [2f64.powi(-20), 2f64.powi(14)] {
        let system = System::of_plant(scaled(at(2.83, 0.1).plant(), unit)).unwrap();
        let search = Search { start: vec![0.0; 4], transient: 200, observe: 2000 };
        let motion = labelled_motion(&system, Label::new(1, &[2, 1]), &search).unwrap();
        assert_eq!(motion.label(), "1-2-1");
        // It may be another of that label; but a motion it is.
        let own = |section: &SectionVector| {
            SectionVector::from_fn(section.len(), |i, _| if i < 3 { section[i] / unit } else { section[i] })
        };
        let sections: Vec<SectionVector> = motion.sections.iter().map(own).collect();
        let there = PeriodicMotion::refine(&at(2.83, 0.1), &motion.pattern, &sections).unwrap();
        assert_close(there.sections[0].as_slice(), sections[0].as_slice(), 1e-9);
    }
}

/// A curve bounds 2-2-4 there, but every orbit from there leads elsewhere: it is followed from where it is stable.
#[test]
fn a_motion_that_no_orbit_comes_near_is_followed_from_its_neighbours() {
    let system = at(1.2338, 0.6711);
    let search = Search { start: vec![0.0; 4], transient: 1000, observe: 500 };
    for label in [Label::new(2, &[2, 4]), Label::new(2, &[4, 2])] {
        let motion = labelled_motion(&system, label.clone(), &search).unwrap();
        let start: [f64; 4] = motion.at_phase_zero(&system).try_into().unwrap();
        let flown = record(&system, start, 0, 2, 1);
        let at_a = flown.impacts.iter().filter(|impact| impact.stop == Stop::A).count() as u32;
        assert_eq!(
            (flown.impacts.len() as u32 - at_a, at_a),
            (label.impacts[0], label.impacts[1]),
            "{label}"
        );
        let back = record(&system, start, 2, 1, 1).samples[0];
        assert_close(&back.state, &start, 1e-8);
        // The start itself is enough, without a transient.
        let own = Search { start: start.to_vec(), transient: 0, observe: 1 };
        let again = labelled_motion(&system, label, &own).unwrap().sections[0].clone();
        let met = |section: &SectionVector| (section - &again).rows(0, 3).amax() < 1e-9;
        assert_eq!(motion.sections.iter().filter(|&section| met(section)).count(), 1, "{again}");
    }
}

#[test]
fn a_motion_that_is_not_there_is_not_found() {
    let search = Search { start: vec![0.0; 4], transient: 50, observe: 200 };
    let error = labelled_motion(&at(3.7, 0.1), Label::new(1, &[7, 2]), &search).unwrap_err();
    assert!(error.to_string().contains("1-7-2"), "{error}");
}

#[test]
fn solutions_that_are_not_physical_say_why() {
    let reasons: Vec<String> = symmetric_motions(&at(3.7, 0.1))
        .unwrap()
        .iter()
        .map(|solution| {
            solution.at_phase_zero.as_ref().map_or_else(ToString::to_string, |_| "physical".to_owned())
        })
        .collect();
    assert!(reasons.contains(&"physical".to_owned()), "{reasons:?}");
    let none = symmetric_motions(&at(0.05, 5.0)).unwrap_err().to_string();
    assert!(none.contains("5"), "{none}");
}
