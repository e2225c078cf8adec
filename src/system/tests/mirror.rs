//! The mirror of a plant.

use nalgebra::{DMatrix, DVector};

use super::super::{Plant, PlantStop};
use super::{plain, stop};

fn matrix(entries: &[f64]) -> DMatrix<f64> {
    DMatrix::from_row_slice(2, 2, entries)
}

/// Two equal masses, coupled, driven against each other, that hit each other and nothing else.
fn pair() -> Plant {
    Plant {
        stiffness: matrix(&[2.0, -1.0, -1.0, 2.0]),
        force_sin: DVector::from_row_slice(&[1.0, -1.0]),
        stops: vec![stop(&[1.0, -1.0], 0.5)],
        ..plain(2)
    }
}

#[test]
fn symmetric_stops_are_mirrored_by_the_change_of_sign() {
    for n in 1..=4 {
        let mirror = plain(n).mirror().unwrap();
        assert_eq!(mirror.matrix, -DMatrix::<f64>::identity(n, n));
        assert_eq!(mirror.stops, [1, 0]);
    }
}

#[test]
fn whatever_tells_the_two_sides_apart_leaves_no_mirror() {
    let one_sided = Plant { stops: vec![stop(&[1.0], 1.0)], ..plain(1) };
    let unequal_gaps = Plant { stops: vec![stop(&[1.0], 1.0), stop(&[-1.0], 1.0 + 1e-14)], ..plain(1) };
    let unequal_losses = Plant {
        stops: vec![stop(&[1.0], 1.0), PlantStop { restitution: 0.7, ..stop(&[-1.0], 1.0) }],
        ..plain(1)
    };
    let loaded = Plant { load: DVector::from_element(1, 1e-9), ..plain(1) };
    for plant in [one_sided, unequal_gaps, unequal_losses, loaded] {
        assert_eq!(plant.check(), Ok(()));
        assert_eq!(plant.mirror(), None, "{plant:?}");
    }
}

#[test]
fn a_few_ulps_and_the_length_of_a_direction_do_not_matter() {
    let gap = 0.1 + 0.2;
    let scaled = Plant { stops: vec![stop(&[1.0], 0.3), stop(&[-3.0], 3.0 * gap)], ..plain(1) };
    assert!(scaled.mirror().is_some());
}

/// −1 would turn the relative stop over; exchanging the masses keeps it. The constant load breaks −1 too.
#[test]
fn exchanged_coordinates_are_found() {
    let exchange = matrix(&[0.0, 1.0, 1.0, 0.0]);
    let driven = Plant { stops: vec![stop(&[1.0, 0.0], 0.5), stop(&[0.0, 1.0], 0.5)], ..pair() };
    let mirror = driven.mirror().unwrap();
    assert_eq!((mirror.matrix, mirror.stops), (exchange, vec![1, 0]));
    let loaded = Plant { load: DVector::from_element(2, 0.25), ..driven };
    assert!(loaded.mirror().is_some());
    let uneven = Plant { load: DVector::from_row_slice(&[0.25, 0.3]), ..loaded };
    assert_eq!(uneven.mirror(), None);
}

/// P e1 = −e2 maps e1 − e2 onto itself.
#[test]
fn a_relative_stop_is_its_own_image() {
    let together = Plant { force_sin: DVector::from_row_slice(&[1.0, 1.0]), ..pair() };
    let mirror = together.mirror().unwrap();
    assert_eq!((mirror.matrix, mirror.stops), (matrix(&[0.0, -1.0, -1.0, 0.0]), vec![0]));
    assert_eq!(pair().mirror(), None, "the exchange turns the stop over, −1 as well");
}

#[test]
fn single_coordinates_change_sign_where_the_others_stay() {
    let separate = Plant {
        force_sin: DVector::from_row_slice(&[0.0, 1.0]),
        load: DVector::from_row_slice(&[0.5, 0.0]),
        stops: vec![stop(&[1.0, 0.0], 1.0), stop(&[0.0, 1.0], 1.0), stop(&[0.0, -1.0], 1.0)],
        ..plain(2)
    };
    let mirror = separate.mirror().unwrap();
    assert_eq!((mirror.matrix, mirror.stops), (matrix(&[1.0, 0.0, 0.0, -1.0]), vec![0, 2, 1]));
}

#[test]
fn the_identity_is_no_mirror() {
    let unforced = Plant { force_sin: DVector::zeros(1), load: DVector::from_element(1, 1.0), ..plain(1) };
    assert_eq!(unforced.mirror(), None);
}

/// A mirror is what it says: of the plant's own matrices and loads, in every case above.
#[test]
fn mirrors_satisfy_their_definition() {
    let together = Plant { force_sin: DVector::from_row_slice(&[1.0, 1.0]), ..pair() };
    let opposed = Plant { stops: vec![stop(&[1.0, 0.0], 0.5), stop(&[0.0, 1.0], 0.5)], ..pair() };
    for plant in [plain(1), plain(3), together, opposed] {
        let mirror = plant.mirror().unwrap();
        let p = &mirror.matrix;
        assert_eq!(p * p, DMatrix::identity(plant.n, plant.n));
        for m in [&plant.mass, &plant.damping, &plant.stiffness] {
            assert_eq!(&(p * m * p), m);
        }
        assert_eq!(p * &plant.force_sin, -&plant.force_sin);
        assert_eq!(p * &plant.load, plant.load);
        for (stop, &image) in plant.stops.iter().zip(&mirror.stops) {
            assert_eq!(p * &stop.direction, plant.stops[image].direction);
        }
    }
}
