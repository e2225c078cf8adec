//! The arithmetic under the oracle: double-doubles, exponentials, roots; f64 against 32 digits.

use impact_atlas::model::Parameters;
use rayon::prelude::*;

use crate::common::oracle::crossing::Polynomial;
use crate::common::oracle::{Dd, Follower, Plant, Real};
use crate::oracle_self::{REST, paper};

#[test]
fn double_doubles_carry_thirty_digits() {
    let third = Dd::from(1.0) / Dd::from(3.0);
    let rest = third + third + third - Dd::from(1.0);
    assert!(rest.f64().abs() < 1e-31, "{rest:?}");
    let tiny = Dd::from(1e-20);
    assert_eq!(((Dd::from(1.0) + tiny) - Dd::from(1.0)).f64(), 1e-20);
    let product = (Dd::from(1.0) + tiny) * (Dd::from(1.0) - tiny);
    assert!((product - Dd::from(1.0)).f64().abs() < 1e-31);
    assert!(Dd::from(1.0) + tiny > Dd::from(1.0) && Dd::from(-2.0) < Dd::from(1.0));
}

/// The forcing turns by 2π in a period, so the tabulated exponential must bring it back.
#[test]
fn a_period_of_the_exponential_is_a_whole_turn() {
    for omega in [0.2, 3.7, 6.0] {
        let turn = phasor_after_a_period::<Dd>(omega);
        assert!(turn[0].abs() < 1e-28 && turn[1].abs() < 1e-28, "{turn:?}");
        let turn = phasor_after_a_period::<f64>(omega);
        assert!(turn[0].abs() < 4e-15 && turn[1].abs() < 4e-15, "{turn:?}");
    }
}

/// The phasor's distance from (0, 1) after a whole period.
fn phasor_after_a_period<R: Real>(omega: f64) -> [f64; 2] {
    let plant = Plant::new(paper(omega, 0.1));
    let flow = crate::common::oracle::flow::Flow::<R>::new(&plant.free(), plant.period());
    let mut start = [R::of(0.0); 7];
    start[5] = R::of(1.0);
    let end = flow.at(&start, R::rounded(plant.period()));
    [end[4].f64(), (end[5] - R::of(1.0)).f64()]
}

/// (t − a)² + lift: a double touch between two samples, by a hair or by none.
#[test]
fn a_double_touch_inside_a_step_is_found_and_a_near_miss_is_not() {
    let touch = |lift: f64| Polynomial { coefficients: vec![0.09 + lift, -0.6, 1.0], curvature: 2.0 };
    for depth in [1e-4, 1e-8, 1e-12, 1e-14] {
        let root = touch(-depth).first_root(0.0, 1.0).expect("the dip below zero is found");
        assert!((root - (0.3 - depth.sqrt())).abs() < 1e-16 / depth.sqrt(), "{root} at depth {depth:e}");
        assert_eq!(touch(depth).first_root(0.0, 1.0), None, "near miss by {depth:e}");
    }
}

/// The first of several roots, and a root at the very end.
#[test]
fn the_first_root_is_taken() {
    let polynomial = Polynomial { coefficients: vec![0.006, -0.11, 0.6, -1.0], curvature: 10.0 };
    assert!((polynomial.first_root(0.0, 1.0).unwrap() - 0.1).abs() < 1e-12);
    assert!((polynomial.first_root(0.15, 1.0).unwrap() - 0.15).abs() < 1e-12);
    let falling = Polynomial { coefficients: vec![1.0, -1.0], curvature: 0.0 };
    assert_eq!(falling.first_root(0.0, 1.0), Some(1.0));
    assert_eq!(falling.first_root(0.0, 0.999), None);
}

/// f64 against 32 digits, on impacts, chatter, sticking, overdamped and undamped systems.
#[test]
fn f64_agrees_with_thirty_two_digits() {
    let general = Parameters { mu_m: 0.3, mu_k: 0.6, mu_c: 0.2, f20: 0.35, ..paper(1.3, 0.2) };
    let systems = [
        (paper(3.7, 0.1), 1e-14),
        (paper(0.25, 0.545), 1e-14),
        (paper(0.4, 0.2), 1e-14),
        (general, 1e-14),
        (Parameters { zeta: 1.8, ..general }, 1e-14),
        (Parameters { r: 0.0, ..paper(0.3, 0.1) }, 1e-14),
        // Undamped and perfectly elastic: errors grow from impact to impact.
        (Parameters { zeta: 0.0, r: 1.0, ..general }, 1e-10),
    ];
    systems.into_par_iter().for_each(|(parameters, tolerance)| {
        let plant = Plant::new(parameters);
        let mut rounded = Follower::<f64>::new(plant, REST);
        let mut exact = Follower::<Dd>::new(plant, REST);
        for _ in 0..6 {
            let (ours, truth) = (rounded.next_period(), exact.next_period());
            assert_eq!(ours.counts(), truth.counts(), "{parameters:?}");
            assert_eq!(ours.sticks.len(), truth.sticks.len(), "{parameters:?}");
            for (a, b) in ours.strobe.iter().zip(truth.strobe) {
                assert!((a - b).abs() < tolerance, "{parameters:?} {:?} {:?}", ours.strobe, truth.strobe);
            }
        }
    });
}

/// A rebound is called dead at 1e-9; at 1e-12 the state is the same.
#[test]
fn the_end_of_a_chatter_does_not_depend_on_the_threshold() {
    let plant = Plant::new(paper(0.3, 0.2));
    let mut usual = Follower::<f64>::new(plant, REST);
    let mut longer = Follower::<f64>::new(plant, REST).with_dead_rebound(1e-12);
    let mut chatters = 0;
    for _ in 0..10 {
        let (a, b) = (usual.next_period(), longer.next_period());
        assert_eq!(a.chatters, b.chatters);
        assert!(b.impacts.len() >= a.impacts.len() + 20 * (a.chatters[0] + a.chatters[1]) as usize);
        chatters += a.chatters[0] + a.chatters[1];
        for (x, y) in a.strobe.iter().zip(b.strobe) {
            assert!((x - y).abs() < 1e-14);
        }
    }
    assert!(chatters >= 10, "{chatters}");
}
