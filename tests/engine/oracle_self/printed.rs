//! Numbers and labels that the paper prints, or that were confirmed outside this project.

use rayon::prelude::*;

use crate::common::oracle::settle::{Count, Motion, settle};
use crate::common::oracle::{Follower, Plant, Stop, lyapunov};
use crate::oracle_self::{REST, paper};

/// The 1-1-1 symmetric motion at ω = 3.7, δ = 0.1: (x1'+, x2, x2', τ) just after the impact at A.
#[test]
fn the_printed_fixed_point_is_met_at_every_impact() {
    let parameters = paper(3.7, 0.1);
    let mut follower = Follower::<f64>::new(Plant::new(parameters), REST);
    for _ in 0..2000 {
        follower.next_period();
    }
    let period = follower.next_period();
    assert_eq!(period.counts(), [1, 1]);
    let impact = period.impacts.iter().find(|impact| impact.stop == Stop::Plus).unwrap();
    let section = [impact.velocity_after, impact.x2, impact.v2, parameters.omega * impact.time];
    let printed = [-0.345457, -0.006341, 0.021160, 1.802134];
    for (ours, theirs) in section.iter().zip(printed) {
        assert!((ours - theirs).abs() < 1e-6, "{section:?}");
    }
}

fn finite(n: u32, p: u32, q: u32, symmetric: bool) -> Motion {
    Motion { n, p: Count::Finite(p), q: Count::Finite(q), symmetric, sticks: false }
}

#[test]
fn the_labels_of_the_papers_points_are_found() {
    let chatter = Motion { n: 1, p: Count::Infinite, q: Count::Infinite, symmetric: true, sticks: true };
    let points = [
        (3.7, 0.1, finite(1, 1, 1, true)),
        (3.5, 0.1, finite(1, 1, 1, false)),
        (2.95, 0.1, finite(2, 2, 2, false)),
        (1.72, 0.1, finite(1, 2, 2, true)),
        (1.65, 0.1, finite(1, 2, 2, false)),
        (1.63, 0.1, finite(2, 4, 4, false)),
        (1.628, 0.1, finite(2, 4, 4, false)),
        (1.626, 0.1, finite(4, 8, 8, false)),
        (0.35, 0.545, finite(1, 5, 5, true)),
        (0.30, 0.545, finite(1, 10, 10, true)),
        (0.25, 0.545, chatter),
    ];
    points.into_par_iter().for_each(|(omega, delta, expected)| {
        let settled = settle(Follower::new(Plant::new(paper(omega, delta)), REST), 6000);
        assert_eq!(settled.map(|s| s.motion), Some(expected), "ω = {omega}, δ = {delta}");
    });
}

#[test]
fn fifteen_impacts_a_period_without_complete_chatter_at_low_frequency() {
    let mut follower = Follower::<f64>::new(Plant::new(paper(0.57, 0.1)), REST);
    for _ in 0..300 {
        follower.next_period();
    }
    let period = follower.next_period();
    assert_eq!(period.counts(), [15, 15]);
    assert_eq!(period.chatters, [0, 0]);
    assert!(period.sticks.is_empty());
}

/// Impacts at stop A per forcing period, after a transient.
fn returns_per_period(omega: f64) -> f64 {
    let mut follower = Follower::<f64>::new(Plant::new(paper(omega, 0.1)), REST);
    let mut returns = || f64::from(follower.next_period().counts()[1]);
    let transient: f64 = (0..500).map(|_| returns()).sum();
    assert!(transient > 0.0);
    (0..4000).map(|_| returns()).sum::<f64>() / 4000.0
}

/// The exponents of the paper page are per return to stop A.
#[test]
fn chaos_and_order_are_told_apart_by_the_largest_exponent() {
    let largest = |omega| {
        let per_period = lyapunov::largest(Plant::new(paper(omega, 0.1)), REST, 500, 4000);
        per_period / returns_per_period(omega)
    };
    let chaotic = largest(2.83);
    assert!((0.16..0.20).contains(&chaotic), "{chaotic}");
    let quasi_periodic = largest(3.03);
    assert!(quasi_periodic.abs() < 2e-3, "{quasi_periodic}");
    assert!(largest(3.7) < -0.005);
}
