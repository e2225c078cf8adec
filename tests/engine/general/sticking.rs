//! Masses that rest on several stops at once, and leave them in their order.

use nalgebra::{DMatrix, DVector};

use crate::common::general::Follower;
use crate::common::general::conditioning::deviation;
use crate::general::subject::{follow, masses, stop};

/// Two masses pressed on stops of their own by loads, pulled off by a slow force that the weaker load gives way to first.
#[test]
fn two_masses_on_their_own_stops_leave_them_when_their_loads_give_way() {
    let mut plant = masses(&[1.0, 0.7], 0.5);
    plant.damping = DMatrix::from_row_slice(2, 2, &[0.6, 0.0, 0.0, 0.6]);
    plant.load = DVector::from_row_slice(&[0.5, -0.8]);
    plant.force_sin = DVector::from_row_slice(&[-1.0, 1.0]);
    plant.stops = vec![stop(&[1.0, 0.0], 0.2, 0.3), stop(&[0.0, -1.0], 0.1, 0.3)];
    // At rest on both: 0.5 − sin φ presses on the first, 0.8 − sin φ on the second.
    let periods = follow::<f64>(&plant, &[0.2, -0.1, 0.0, 0.0], 3);
    let [first, second] = [0.5_f64.asin() / 0.5, 0.8_f64.asin() / 0.5];
    for period in &periods {
        assert_eq!(period.held, [0, 1], "both rest again at the strobe: {period:?}");
        let left = |stop: usize| period.releases.iter().find(|(s, _)| *s == stop).unwrap().1;
        assert!((left(0) - first).abs() < 1e-6 && (left(1) - second).abs() < 1e-6, "{period:?}");
    }
}

/// The first mass is pressed on the second, and that on a wall: the wall is pressed by both loads together. The pull on the
/// second mass grows until the wall lets go; both move on in contact.
#[test]
fn a_mass_on_a_mass_on_a_wall() {
    let (first, second) = (1.0, 2.0);
    let mut plant = masses(&[first, second], 0.5);
    plant.damping = DMatrix::from_row_slice(2, 2, &[0.5, 0.0, 0.0, 0.5]);
    plant.load = DVector::from_row_slice(&[0.4, 0.2]);
    plant.force_sin = DVector::from_row_slice(&[0.0, -1.0]);
    // x1 − x2 ≤ 0.1, x2 ≤ 0.3.
    plant.stops = vec![stop(&[1.0, -1.0], 0.1, 0.5), stop(&[0.0, 1.0], 0.3, 0.5)];
    let periods = follow::<f64>(&plant, &[0.4, 0.3, 0.0, 0.0], 4);
    let wall = 0.6_f64.asin() / 0.5;
    let (stop, time) = periods[0].releases[0];
    assert!(stop == 1 && (time - wall).abs() < 1e-6, "{:?}", periods[0].releases);
    // Together from there on: one body of mass 3 with the damping of both.
    let together = follow::<f64>(&merged(&plant), &[0.3, 0.0], 1);
    let exact = &together[0].releases[0];
    // Either is as sharp as a release is: to h √ε, a time in which nothing happens that rounding would not hide.
    assert!((exact.1 - time).abs() < 1e-7, "{exact:?}, {time}");
    let mut oracle = Follower::new(plant.clone(), &[0.4, 0.3, 0.0, 0.0]);
    for period in &periods {
        let exact = oracle.next_period();
        let off = deviation(&period.strobe, &exact.strobe);
        assert!(off < 1e-9 && period.held == exact.held, "off by {off:e}: {period:?}\n{exact:?}");
    }
}

/// Both masses of the plant above as one.
fn merged(plant: &impact_atlas::system::Plant) -> impact_atlas::system::Plant {
    let mut one = masses(&[plant.mass.trace()], plant.omega);
    one.damping[(0, 0)] = plant.damping.trace();
    one.load[0] = plant.load.sum();
    one.force_sin[0] = plant.force_sin.sum();
    one.stops = vec![stop(&[1.0], 0.3, 0.5)];
    one
}

/// A free mass that a damper carries along comes to rest on another: chatter at a relative stop, with the reaction felt by
/// both. The closed rebounds must leave the state that all of them lead to.
#[test]
fn chatter_between_two_masses_is_closed_like_its_rebounds() {
    let mut compared = 0;
    for omega in [0.25, 0.4, 0.55] {
        for restitution in [0.2, 0.5, 0.75] {
            for mass in [0.2, 1.0, 3.0] {
                let mut plant = masses(&[1.0, mass], omega);
                plant.damping = DMatrix::from_row_slice(2, 2, &[0.5, -0.2, -0.2, 0.3]);
                plant.stiffness = DMatrix::from_row_slice(2, 2, &[1.5, -0.3, -0.3, 0.8]);
                plant.load = DVector::from_row_slice(&[0.3, -0.3]);
                plant.force_cos = DVector::from_row_slice(&[0.6, 0.0]);
                plant.stops = vec![stop(&[1.0, -1.0], 0.05, restitution)];
                let start = [0.0, 0.1, 0.0, -0.2];
                let mut oracle = Follower::new(plant.clone(), &start);
                for period in follow::<f64>(&plant, &start, 12) {
                    let exact = oracle.next_period();
                    let off = deviation(&period.strobe, &exact.strobe);
                    assert!(off < 1e-9, "off by {off:e}: {plant:?}");
                    assert_eq!(period.held, exact.held, "{plant:?}");
                    compared += usize::from(exact.chatters);
                }
            }
        }
    }
    assert!(compared >= 50, "{compared} periods with chatter");
}

/// The contact of masses that move on together does not drift apart over thousands of periods.
#[test]
fn masses_that_move_together_stay_together() {
    let mut plant = masses(&[1.0, 0.37], 1.3);
    plant.damping = DMatrix::from_row_slice(2, 2, &[0.3, 0.0, 0.0, 0.11]);
    plant.stiffness = DMatrix::from_row_slice(2, 2, &[1.1, 0.0, 0.0, 0.7]);
    plant.load = DVector::from_row_slice(&[3.0, -3.0]);
    plant.force_sin = DVector::from_row_slice(&[0.7, 0.2]);
    plant.stops = vec![stop(&[1.0, -1.0], 0.1, 0.5)];
    let gap = |periods: Vec<crate::general::subject::Period>| {
        let last = periods.last().unwrap();
        assert_eq!(last.held, [0]);
        (last.strobe[0] - last.strobe[1] - 0.1).abs()
    };
    let start = [0.1, 0.0, 0.0, 0.0];
    assert!(gap(follow::<f64>(&plant, &start, 3000)) < 1e-15);
    assert!(gap(follow::<f32>(&plant, &start, 3000)) < 5e-7);
}
