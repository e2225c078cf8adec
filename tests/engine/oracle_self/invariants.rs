//! Laws of the system that every trajectory obeys.

use impact_atlas::model::Parameters;

use crate::common::oracle::{Follower, Plant, Stop};
use crate::oracle_self::paper;

/// Unforced, undamped and with r = 1, kinetic and elastic energy stay what they were.
#[test]
fn energy_is_conserved_without_loss_and_forcing() {
    let p =
        Parameters { omega: 0.7, delta: 0.3, zeta: 0.0, r: 1.0, mu_m: 0.35, mu_k: 0.6, ..paper(0.7, 0.3) };
    let energy = |[x1, x2, v1, v2]: [f64; 4]| {
        0.5 * (v1 * v1
            + p.mu_m / (1.0 - p.mu_m) * v2 * v2
            + (x1 - x2) * (x1 - x2)
            + p.mu_k / (1.0 - p.mu_k) * x2 * x2)
    };
    let start = [0.1, -0.4, 1.3, 0.6];
    let mut follower = Follower::<f64>::new(Plant::unforced(p), start);
    let mut impacts = 0;
    let mut drift = 0.0_f64;
    while impacts < 10_000 {
        let period = follower.next_period();
        impacts += period.impacts.len();
        drift = drift.max((energy(period.strobe) / energy(start) - 1.0).abs());
    }
    assert!(drift < 1e-12, "{drift:e}");
}

/// The system is its own mirror image half a forcing period later.
#[test]
fn the_mirrored_start_gives_the_mirrored_orbit() {
    for parameters in
        [paper(2.95, 0.1), paper(0.35, 0.15), Parameters { mu_c: 0.8, f20: 0.4, ..paper(1.65, 0.2) }]
    {
        let plant = Plant::new(parameters);
        let mut original = Follower::<f64>::new(plant, [0.03, 0.1, -0.4, 0.2]);
        original.advance(0.5 * original.period());
        let mut mirrored = Follower::<f64>::new(plant, original.position().map(|x| -x));
        original.advance(original.period());
        original.finish_period();
        for _ in 0..5 {
            mirrored.advance(0.5 * mirrored.period());
            for (a, b) in original.position().iter().zip(mirrored.position()) {
                assert!((a + b).abs() < 1e-11, "{parameters:?}");
            }
            mirrored.advance(mirrored.period());
            mirrored.finish_period();
            original.next_period();
        }
    }
}

/// The exact time of every impact, however the flight is cut into pieces.
#[test]
fn cutting_a_period_into_pieces_changes_nothing() {
    for parameters in
        [paper(3.5, 0.1), paper(0.3, 0.2), Parameters { zeta: 1.9, mu_m: 0.2, ..paper(0.5, 0.1) }]
    {
        let start = [-0.02, 0.3, 0.5, -0.1];
        let mut whole = Follower::<f64>::new(Plant::new(parameters), start);
        let mut pieces = Follower::<f64>::new(Plant::new(parameters), start);
        for _ in 0..4 {
            let expected = whole.next_period();
            for piece in 1..=997 {
                pieces.advance(pieces.period() * (f64::from(piece) / 997.0));
                assert!(pieces.gap() >= 0.0, "{}", pieces.gap());
            }
            let cut = pieces.finish_period();
            assert_eq!(cut.counts(), expected.counts());
            for (a, b) in cut.strobe.iter().zip(expected.strobe) {
                assert!((a - b).abs() < 1e-11, "{:?} {:?}", cut.strobe, expected.strobe);
            }
        }
    }
}

/// Energy at an impact: v1 is reversed and shrunk, the second mass goes on as it was.
#[test]
fn impacts_happen_at_the_stop_they_name_and_reverse_the_velocity() {
    let parameters = paper(2.83, 0.1);
    let start = [0.05, 0.0, 0.4, 0.0];
    let mut follower = Follower::<f64>::new(Plant::new(parameters), start);
    let period = follower.next_period();
    assert!(!period.impacts.is_empty());
    for impact in &period.impacts {
        let sign = if impact.stop == Stop::Plus { 1.0 } else { -1.0 };
        assert!(sign * impact.velocity_before > 0.0);
        assert_eq!(impact.velocity_after, -parameters.r * impact.velocity_before);
        let mut replay = Follower::<f64>::new(Plant::new(parameters), start);
        replay.advance(impact.time - 1e-7);
        let [x1, ..] = replay.position();
        assert!((x1 + 1e-7 * impact.velocity_before - sign * parameters.delta).abs() < 1e-12);
    }
}
