//! Directions in which the masses may drift.

use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use super::super::{BUILTIN, Family, Mooring, Plant};
use super::{plain, stop};

fn matrix<const N: usize>(rows: [[f64; N]; N]) -> DMatrix<f64> {
    DMatrix::from_fn(N, N, |i, j| rows[i][j])
}

/// Three masses in a row, on springs to each other that come to different sizes, a stop between the first two.
fn row() -> Plant {
    let springs = [0.1, 0.3];
    let joints = matrix([
        [springs[0], -springs[0], 0.0],
        [-springs[0], springs[0] + springs[1], -springs[1]],
        [0.0, -springs[1], springs[1]],
    ]);
    Plant {
        mass: DMatrix::from_diagonal(&DVector::from_row_slice(&[1.0, 0.7, 2.1])),
        damping: &joints * 0.3,
        stiffness: joints,
        force_cos: DVector::from_row_slice(&[0.2, 0.0, 0.0]),
        load: DVector::from_row_slice(&[1.0, -3.0, 2.0]),
        omega: 1.7,
        stops: vec![stop(&[1.0, -1.0, 0.0], 0.5)],
        ..plain(3)
    }
}

/// By how much P M⁻¹ K P, and so on, of two plants differ at most; P takes out the motion of all masses together.
fn off(plant: &Plant, other: &Plant) -> f64 {
    let one = DVector::from_element(plant.n, 1.0);
    let dual = one.transpose() * &plant.mass;
    let relative = DMatrix::identity(plant.n, plant.n) - &one * &dual / (&dual * &one)[(0, 0)];
    let inverse = plant.mass.clone().try_inverse().unwrap();
    let of = |plant: &Plant| {
        let square = |m: &DMatrix<f64>| &relative * &inverse * m * &relative;
        let line = |v: &DVector<f64>| &relative * &inverse * v;
        let mut parts: Vec<f64> =
            square(&plant.stiffness).iter().chain(&square(&plant.damping)).copied().collect();
        for load in [&plant.force_sin, &plant.force_cos, &plant.load] {
            parts.extend(line(load).iter());
        }
        parts
    };
    let away = of(plant).into_iter().zip(of(other)).map(|(own, other)| (own - other).abs());
    away.fold(0.0, f64::max)
}

#[test]
fn relative_motion_is_left_as_it_is() {
    let skew = |by: f64| Plant {
        stiffness: matrix([[2.0, -1.5, -0.5], [-1.0, 3.0, -2.0], [by, -1.0, 1.0 - by]]),
        mass: matrix([[1.0, 0.2, 0.0], [0.1, 0.8, 0.0], [0.0, 0.3, 1.1]]),
        ..row()
    };
    for plant in [row(), skew(0.7), skew(-2.0)] {
        let (held, mooring) = Mooring::of(&plant).unwrap();
        assert_eq!(mooring.exponents, [-TAU, -0.8 * TAU]);
        let off = off(&plant, &held);
        assert!(off < 1e-14, "{off:e}");
        assert_eq!(held.stops, plant.stops);
        // What is left of a push to all masses together falls as it is said to: it is no push to one of them.
        let (one, omega) = (DVector::from_element(3, 1.0), plant.omega);
        let push = &plant.mass * &one;
        let rates = [(&held.stiffness, 0.8 * omega * omega), (&held.damping, 1.8 * omega)];
        for (matrix, rate) in rates {
            assert!((matrix * &one - &push * rate).amax() < 1e-13, "{matrix}");
        }
        let loads = [&held.force_sin, &held.force_cos, &held.load];
        assert!(loads.into_iter().all(|load| load.sum().abs() < 1e-14));
        assert_eq!(Mooring::of(&held), None, "nothing is left to be held");
    }
    let held = Mooring::of(&row()).unwrap().0;
    for matrix in [&held.stiffness, &held.damping] {
        assert_eq!(*matrix, matrix.transpose());
    }
    assert_eq!(held.load, row().load, "it is balanced as it is");
    assert!(off(&row(), &Plant { stiffness: held.damping, ..row() }) > 0.1, "the check can fail");
}

/// (x, v)′ = G (x, v), and what forces it.
fn flow(plant: &Plant) -> (DMatrix<f64>, DMatrix<f64>) {
    let (n, inverse) = (plant.n, plant.mass.clone().try_inverse().unwrap());
    let (mut flow, mut loads) = (DMatrix::zeros(2 * n, 2 * n), DMatrix::zeros(2 * n, 3));
    flow.view_mut((0, n), (n, n)).fill_with_identity();
    flow.view_mut((n, 0), (n, n)).copy_from(&-(&inverse * &plant.stiffness));
    flow.view_mut((n, n), (n, n)).copy_from(&-(&inverse * &plant.damping));
    for (k, load) in [&plant.force_sin, &plant.force_cos, &plant.load].into_iter().enumerate() {
        loads.view_mut((n, k), (n, 1)).copy_from(&(&inverse * load));
    }
    (flow, loads)
}

/// The projection makes of what is held the places of the masses relative to each other, with the velocities that they have without:
/// z, which moves as the plant says, but for what the projection takes out of places.
#[test]
fn the_projection_is_followed_by_the_motion_of_the_plant() {
    let dragged = |drag: [f64; 3]| {
        let mut plant = row();
        (0..3).for_each(|i| plant.damping[(i, i)] += drag[i]);
        plant
    };
    let mut with_a_loose_mass = dragged([0.3, 0.0, 0.0]);
    with_a_loose_mass.stiffness = matrix([[0.1, -0.1, 0.0], [-0.1, 0.1, 0.0], [0.0, 0.0, 0.0]]);
    with_a_loose_mass.damping = matrix([[0.5, -0.2, 0.0], [-0.2, 0.2, 0.0], [0.0, 0.0, 0.0]]);
    let cases = [
        (row(), 2),
        (dragged([0.2, 0.0, 0.5]), 1),
        (dragged([0.1, 0.07, 0.21]), 1),
        (with_a_loose_mass, 3),
        (Plant { stiffness: DMatrix::zeros(3, 3), ..dragged([0.1, 0.2, 0.3]) }, 2),
    ];
    for (plant, count) in cases {
        let (held, Mooring { exponents, relative }) = Mooring::of(&plant).unwrap();
        assert_eq!(exponents.len(), count, "{plant:?}");
        let ((own, own_loads), (other, other_loads)) = (flow(&plant), flow(&held));
        assert!((&relative * &relative - &relative).amax() < 1e-14);
        let mut of_plant = relative.clone();
        of_plant.view_mut((3, 0), (3, 3)).fill(0.0);
        let off = (of_plant * &own * &relative - &relative * &other).amax();
        assert!(off < 1e-14, "{off:e}: {plant:?}");
        let loads = (&relative * (own_loads - &other_loads)).amax();
        assert!(loads < 1e-14 && (&relative * other_loads).amax() > 0.1, "{loads:e}: {plant:?}");
        assert!((&own - &other).amax() > 0.1, "it is held");
        // What is taken out decays as it is said to.
        let rates: Vec<f64> = exponents.iter().map(|exponent| exponent * plant.omega / TAU).collect();
        let decaying = rates.iter().fold(DMatrix::identity(6, 6) - &relative, |product, rate| {
            (&other - DMatrix::identity(6, 6) * *rate) * product
        });
        assert!(decaying.amax() < 1e-12, "{rates:?}: {decaying}");
        for stop in &plant.stops {
            let direction = DVector::from_iterator(6, stop.direction.iter().chain(&[0.0; 3]).copied());
            assert!((relative.transpose() * &direction - direction).amax() < 1e-14);
        }
    }
}

#[test]
fn whatever_resists_all_motions_leaves_none() {
    for builtin in BUILTIN {
        let family = Family::parse(builtin.text, builtin.name).unwrap();
        let plant = family.plant(&family.defaults()).unwrap();
        assert_eq!(Mooring::of(&plant), None, "{}", builtin.name);
    }
    let changed = |change: fn(&mut Plant)| {
        let mut plant = row();
        change(&mut plant);
        plant
    };
    let tied = [
        changed(|plant| plant.stiffness[(2, 2)] += 1e-9),
        changed(|plant| plant.stops.push(stop(&[0.0, 0.0, 1.0], 1.0))),
        changed(|plant| plant.stops = vec![stop(&[1.0, -0.9, 0.0], 0.5)]),
    ];
    for plant in tied {
        assert_eq!(Mooring::of(&plant), None, "{plant:?}");
    }
    let exponents = |plant: &Plant| Mooring::of(plant).unwrap().1.exponents.len();
    assert_eq!(
        exponents(&changed(|plant| plant.damping[(0, 0)] += 1e-9)),
        1,
        "a damper leaves its place alone"
    );
    // A mass that nothing touches is a motion more.
    let mut loose =
        changed(|plant| (plant.stiffness, plant.damping) = (DMatrix::zeros(3, 3), DMatrix::zeros(3, 3)));
    assert_eq!(exponents(&loose), 4);
    loose.stops[0] = stop(&[1.0, 0.0, 0.0], 0.5);
    assert_eq!(exponents(&loose), 4);
    assert_eq!(Mooring::of(&plain(1)), None);
}

#[test]
fn a_mirror_is_one_of_the_plant_that_is_held() {
    let pair = Plant {
        stiffness: matrix([[1.1, -1.1], [-1.1, 1.1]]),
        force_sin: DVector::from_row_slice(&[1.0, 0.3]),
        stops: vec![stop(&[1.0, -1.0], 0.5), stop(&[-1.0, 1.0], 0.5)],
        ..plain(2)
    };
    let mirror = |plant: &Plant| Mooring::of(plant).unwrap().0.mirror();
    assert_eq!(mirror(&pair), pair.mirror());
    assert!(pair.mirror().is_some());
    let dragged = Plant { damping: matrix([[0.3, -0.2], [-0.2, 0.2]]), ..pair.clone() };
    assert_eq!(mirror(&dragged), pair.mirror());
    let falling = Plant { load: DVector::from_row_slice(&[-1.0, -1.0]), ..pair.clone() };
    assert_eq!((falling.mirror(), mirror(&falling)), (None, pair.mirror()));
}
