//! Impacts at two stops in the same instant: one after the other, in the order of the stops' lines.

use nalgebra::DVector;

use crate::general::subject::{follow, masses, stop};

/// A mass hits one that rests on a wall: the blow goes on to the wall at once, and comes back.
#[test]
fn a_blow_on_a_resting_mass_reaches_its_stop_at_the_same_instant() {
    let (first, second) = (1.0, 2.0);
    let (between, wall) = (0.6, 0.5);
    let mut plant = masses(&[first, second], 1.0);
    plant.load = DVector::from_row_slice(&[0.0, 1.0]);
    // x1 − x2 ≤ 0, x2 ≤ 0: the second mass is pressed on the wall.
    plant.stops = vec![stop(&[1.0, -1.0], 0.0, between), stop(&[0.0, 1.0], 0.0, wall)];
    let speed = 0.8;
    let periods = follow::<f64>(&plant, &[-1.0, 0.0, speed, 0.0], 1);
    // The first mass arrives after 1/0.8 = 1.25; then the impact law, the wall's, and the impact law again.
    let hit = |v: [f64; 2]| {
        let impulse = (1.0 + between) * (v[0] - v[1]) / (1.0 / first + 1.0 / second);
        [v[0] - impulse / first, v[1] + impulse / second]
    };
    let after = hit([speed, 0.0]);
    let after = [after[0], -wall * after[1]];
    // The first mass is thrown back faster than the second: they do not meet again before the strobe.
    let after = if after[0] > after[1] { hit(after) } else { after };
    let rest = std::f64::consts::TAU - 1.0 / speed;
    assert_eq!(periods[0].impacts[0], if after[0] < 0.0 { periods[0].impacts[0] } else { 0 });
    let x1 = after[0] * rest;
    let met_again = periods[0].impacts[0] > 2;
    assert!(!met_again, "{:?}", periods[0]);
    assert!((periods[0].strobe[0] - x1).abs() < 1e-12, "{:?}, not {x1}", periods[0]);
    assert!(periods[0].impacts[1] >= 1);
}

/// Two stops reached in one instant by a mass that slides into a corner: independent ones commute, and both are counted.
#[test]
fn a_corner_is_two_impacts() {
    let mut plant = masses(&[1.0, 1.0], 1.0);
    plant.stops = vec![stop(&[1.0, 0.0], 0.5, 0.8), stop(&[0.0, 1.0], 0.5, 0.6)];
    let periods = follow::<f64>(&plant, &[0.0, 0.0, 0.25, 0.25], 1);
    assert_eq!(periods[0].impacts, [1, 1, 0, 0]);
    let rest = std::f64::consts::TAU - 2.0;
    let exact = [0.5 - 0.2 * rest, 0.5 - 0.15 * rest, -0.2, -0.15];
    for (value, exact) in periods[0].strobe.iter().zip(exact) {
        assert!((value - exact).abs() < 1e-14, "{:?}", periods[0]);
    }
}

/// In a wedge the order matters: the line that the plant names first is struck first.
#[test]
fn in_a_wedge_the_first_line_is_struck_first() {
    let corner = |order: [usize; 2]| {
        let walls = [stop(&[1.0, 0.0], 0.0, 0.5), stop(&[0.6, 0.8], 0.0, 0.5)];
        let mut plant = masses(&[1.0, 1.0], 1.0);
        plant.stops = order.map(|i| walls[i].clone()).to_vec();
        // Straight into the corner at 0.
        follow::<f64>(&plant, &[-0.5, -0.5, 0.25, 0.25], 1).remove(0).strobe
    };
    let strike = |v: [f64; 2], d: [f64; 2]| {
        let speed = v[0] * d[0] + v[1] * d[1];
        if speed > 0.0 { [v[0] - 1.5 * speed * d[0], v[1] - 1.5 * speed * d[1]] } else { v }
    };
    let expected = |order: [usize; 2]| {
        let walls = [[1.0, 0.0], [0.6, 0.8]];
        let mut v = [0.25, 0.25];
        for _ in 0..20 {
            let hit = order.iter().find(|&&i| v[0] * walls[i][0] + v[1] * walls[i][1] > 0.0);
            let Some(&i) = hit else { break };
            v = strike(v, walls[i]);
        }
        v
    };
    for order in [[0, 1], [1, 0]] {
        let (found, v) = (corner(order), expected(order));
        assert!(
            (found[2] - v[0]).abs() < 1e-12 && (found[3] - v[1]).abs() < 1e-12,
            "{order:?}: {found:?}, not {v:?}"
        );
    }
    assert_ne!(expected([0, 1]), expected([1, 0]));
}
