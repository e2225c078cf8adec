//! What a plant is held to.

use nalgebra::{DMatrix, DVector};

use super::super::{Part, Plant, PlantError, PlantStop};
use super::{plain, stop};

fn with_stops(n: usize, stops: Vec<PlantStop>) -> Result<(), PlantError> {
    Plant { stops, ..plain(n) }.check()
}

fn with_mass(entries: &[f64]) -> Result<(), PlantError> {
    Plant { mass: DMatrix::from_row_slice(2, 2, entries), ..plain(2) }.check()
}

#[test]
fn plain_plants_pass() {
    for n in 1..=4 {
        assert_eq!(plain(n).check(), Ok(()));
    }
    assert_eq!(plain(1).period(), std::f64::consts::TAU);
}

#[test]
fn counts_and_shapes_are_held_to() {
    assert_eq!(plain(5).check(), Err(PlantError::Coordinates(5)));
    assert_eq!(with_stops(1, Vec::new()), Err(PlantError::Stops(0)));
    assert_eq!(with_stops(1, vec![stop(&[1.0], 1.0); 5]), Err(PlantError::Stops(5)));
    let wide = Plant { damping: DMatrix::zeros(2, 3), ..plain(2) };
    let error = wide.check().unwrap_err();
    assert_eq!(error, PlantError::Shape { part: Part::Damping, rows: 2, columns: 3, wanted: (2, 2) });
    assert_eq!(error.to_string(), "system.damping is 2 × 3, it must be 2 × 2");
    let short = Plant { load: DVector::zeros(1), ..plain(2) };
    assert!(matches!(short.check(), Err(PlantError::Shape { part: Part::Load, .. })));
    let long = with_stops(2, vec![stop(&[1.0, 0.0, 0.0], 1.0)]);
    assert!(matches!(long, Err(PlantError::Shape { part: Part::Direction(0), .. })));
}

#[test]
fn numbers_must_be_finite() {
    let plants = [
        (Part::Frequency, Plant { omega: f64::NAN, ..plain(1) }),
        (Part::Stiffness, Plant { stiffness: DMatrix::from_element(1, 1, f64::INFINITY), ..plain(1) }),
        (Part::ForceCos, Plant { force_cos: DVector::from_element(1, f64::NAN), ..plain(1) }),
        (Part::Gap(0), Plant { stops: vec![stop(&[1.0], f64::NAN)], ..plain(1) }),
    ];
    for (wrong, plant) in plants {
        assert!(
            matches!(plant.check(), Err(PlantError::NotFinite { part, .. }) if part == wrong),
            "{wrong:?}"
        );
    }
}

#[test]
fn frequency_and_restitution_have_their_ranges() {
    for omega in [0.0, -1.0] {
        assert_eq!(Plant { omega, ..plain(1) }.check(), Err(PlantError::Frequency(omega)));
    }
    for (restitution, passes) in [(0.0, true), (1.0, true), (-1e-12, false), (1.0 + 1e-12, false)] {
        let bouncy = PlantStop { restitution, ..stop(&[1.0], 1.0) };
        assert_eq!(with_stops(1, vec![bouncy]).is_ok(), passes, "{restitution}");
    }
}

#[test]
fn the_mass_matrix_must_be_invertible_in_any_units() {
    let refused = [[0.0; 4], [1.0, 2.0, 2.0, 4.0], [1.0, 1.0, 1.0, 1.0 + 1e-12], [1.0, 0.0, 0.0, 0.0]];
    for entries in refused {
        assert!(matches!(with_mass(&entries), Err(PlantError::SingularMass(_))), "{entries:?}");
    }
    for entries in [[1.0, 0.0, 0.0, 1e-20], [2.0, 1.0, 1.0, 2.0], [1e20, 0.0, 0.0, 1e-20]] {
        assert_eq!(with_mass(&entries), Ok(()), "{entries:?}");
    }
    assert_eq!(with_mass(&[1e-320, 0.0, 0.0, 1e-320]), Err(PlantError::LightMass));
}

#[test]
fn no_motion_has_an_energy_below_zero() {
    // The stop stands ahead of the first mass, which an impact does turn back.
    assert_eq!(with_mass(&[1.0, 0.0, 0.0, -2.0]), Err(PlantError::IndefiniteMass(-2.0)));
    let error = with_mass(&[1.0, 0.1 + 0.2, 0.3, -2.0]).unwrap_err();
    assert!(matches!(error, PlantError::IndefiniteMass(_)), "symmetric but for rounding: {error}");
    assert_eq!(error.parts(), [Part::Mass]);
    assert_eq!(with_mass(&[1.0, 0.5, 0.0, 2.0]), Ok(()), "one that is not symmetric has none");
}

#[test]
fn an_impact_must_turn_its_stop_back() {
    assert_eq!(with_stops(2, vec![stop(&[0.0, 0.0], 1.0)]), Err(PlantError::NoDirection(0)));
    let negative = Plant { mass: -DMatrix::<f64>::identity(2, 2), ..plain(2) };
    assert!(matches!(negative.check(), Err(PlantError::NoImpulse { stop: 0, value: -1.0 })));
    let exchange = Plant { mass: DMatrix::from_row_slice(2, 2, &[0.0, 1.0, 1.0, 0.0]), ..plain(2) };
    assert!(matches!(exchange.check(), Err(PlantError::NoImpulse { stop: 0, value: 0.0 })));
}

#[test]
fn a_stop_is_within_reach() {
    for (direction, gap, passes) in [
        ([1.0, 0.0], 1e17, true),
        ([1.0, 0.0], -1e17, true),
        ([1.0, 0.0], 1e30, false),
        ([1.0, 0.0], -1e300, false),
        // A tenth of a direction is ten times as far.
        ([1e-3, 0.0], 1e14, true),
        ([1e-3, 0.0], 1e17, false),
    ] {
        let found = with_stops(2, vec![stop(&direction, gap)]);
        assert_eq!(found, if passes { Ok(()) } else { Err(PlantError::TooFar { stop: 0, value: gap }) });
    }
    let error = with_stops(1, vec![stop(&[1.0], 1e30)]).unwrap_err().to_string();
    assert!(error.contains("stop 1 is 1e30") && error.contains("leave out"), "{error}");
}

#[test]
fn a_direction_is_neither_too_short_nor_too_long() {
    for (length, passes) in
        [(1e9, true), (1e-9, true), (1e10, false), (1e-10, false), (1e200, false), (1e-200, false)]
    {
        let found = with_stops(2, vec![stop(&[0.6 * length, -0.8 * length], length)]);
        assert_eq!(found.is_ok(), passes, "{length:e}: {found:?}");
    }
    let error = with_stops(1, vec![stop(&[1e-10], 0.0)]).unwrap_err();
    assert_eq!(error, PlantError::DirectionLength { stop: 0, length: 1e-10 });
    assert!(error.to_string().contains("between 1e-9 and 1e9"), "{error}");
}

#[test]
fn opposed_stops_must_leave_room() {
    let pair = |gap, other| with_stops(1, vec![stop(&[1.0], gap), stop(&[-2.0], other)]);
    assert_eq!(pair(1.0, 1.0), Ok(()));
    assert_eq!(pair(-1.0, 2.0), Ok(()), "closed stops clamp");
    assert_eq!(pair(0.1, -0.2), Ok(()), "closed stops clamp, rounding aside");
    assert_eq!(pair(-1.0, 1.5), Err(PlantError::NoRoom { first: 0, second: 1, overlap: 0.25 }));
    let error = pair(-1.0, 1.0).unwrap_err();
    assert_eq!(error.parts()[..2], [Part::Gap(1), Part::Gap(0)]);
    assert!(error.to_string().contains("overlap by 0.5"), "{error}");
}

#[test]
fn one_side_of_a_line_holds_one_stop() {
    let third = 1.0 / 3.0;
    for other in [[1.0, 1.0], [5.0, 5.0], [third, 1.0 - 2.0 * third]] {
        let both = with_stops(2, vec![stop(&[1.0, 1.0], 1.0), stop(&other, 2.0)]);
        assert_eq!(both, Err(PlantError::SameSide { first: 0, second: 1 }), "{other:?}");
    }
    assert_eq!(with_stops(2, vec![stop(&[1.0, 1.0], 1.0), stop(&[1.0, 1.001], 2.0)]), Ok(()));
}

#[test]
fn dependent_directions_are_refused_and_parallel_ones_allowed() {
    let relative = [stop(&[1.0, 0.0], 1.0), stop(&[0.0, 1.0], 1.0), stop(&[1.0, -1.0], 1.0)];
    let error = with_stops(2, relative.to_vec()).unwrap_err();
    assert_eq!(error, PlantError::Dependent(2));
    assert_eq!(error.parts(), [Part::Direction(2), Part::Direction(1), Part::Direction(0)]);
    assert_eq!(with_stops(2, relative[1..].to_vec()), Ok(()));
    let box_of_four = [[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]].map(|d| stop(&d, 1.0));
    assert_eq!(with_stops(2, box_of_four.to_vec()), Ok(()));
    let chain = [[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [1.0, 0.0, -1.0]].map(|d| stop(&d, 1.0));
    assert_eq!(with_stops(3, chain.to_vec()), Err(PlantError::Dependent(2)));
}
