//! The families that come with the program: complete, and right.

use nalgebra::{DMatrix, DVector};

use super::super::{BUILTIN, Family, Plant, builtin};
use super::family::example;

fn family(name: &str) -> Family {
    Family::parse(builtin(name).unwrap(), name).unwrap_or_else(|error| panic!("{error}"))
}

fn plant(name: &str, changes: &[(&str, f64)]) -> Plant {
    let family = family(name);
    let mut values = family.defaults();
    for (name, value) in changes {
        values[family.find(name).unwrap().index()] = *value;
    }
    family.plant(&values).unwrap_or_else(|error| panic!("{error}"))
}

/// The squares of the undamped natural frequencies, ascending, of a plant with a diagonal mass matrix.
fn squared_frequencies(plant: &Plant) -> Vec<f64> {
    let root = plant.mass.map_diagonal(|m| 1.0 / m.sqrt());
    let root = DMatrix::from_diagonal(&root);
    let mut squares: Vec<f64> =
        (&root * &plant.stiffness * &root).symmetric_eigenvalues().iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares
}

fn close(found: &[f64], expected: &[f64]) -> bool {
    found.len() == expected.len() && found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6)
}

#[test]
fn every_family_is_complete() {
    for known in BUILTIN {
        let family = family(known.name);
        assert!(known.text.starts_with("# "), "{}: the derivation stands at the top", known.name);
        assert!(family.parameters.iter().all(|parameter| !parameter.about.is_empty()), "{}", known.name);
        assert!(family.plane.is_some(), "{}", known.name);
        let plant = family.plant(&family.defaults()).unwrap();
        assert!(plant.stops.iter().all(|stop| stop.gap >= 0.0), "{}: rest is between the stops", known.name);
    }
    assert_eq!(builtin("no-such"), None);
    let sources = BUILTIN.iter().filter(|known| family(known.name).source.is_some()).count();
    assert!(sources >= 6);
}

#[test]
fn every_default_plane_has_plants_at_its_corners() {
    for known in BUILTIN {
        let family = family(known.name);
        let plane = family.plane.as_ref().unwrap();
        let ends = |axis: &str| {
            let (name, range) = axis.split_once('=').unwrap();
            let ends: Vec<f64> = range.split(':').take(2).map(|end| end.parse().unwrap()).collect();
            (family.find(name).unwrap(), ends)
        };
        let ((x, across), (y, up)) = (ends(&plane.x), ends(&plane.y));
        for (&a, &b) in across.iter().flat_map(|a| up.iter().map(move |b| (a, b))) {
            let mut values = family.defaults();
            (values[x.index()], values[y.index()]) = (a, b);
            assert!(family.plant(&values).is_ok(), "{}", known.name);
        }
    }
}

#[test]
fn mirrors_are_where_they_should_be() {
    let minus = |n| -DMatrix::<f64>::identity(n, n);
    for (name, n) in [("luo-ma-lv", 2), ("impact-pair", 1), ("three-mass-chain", 3), ("impact-damper", 2)] {
        let mirror = plant(name, &[]).mirror().unwrap();
        assert_eq!((mirror.matrix, mirror.stops), (minus(n), vec![1, 0]), "{name}");
    }
    for name in ["shaw-holmes", "bouncing-ball", "two-sided", "colliding-pair"] {
        assert_eq!(plant(name, &[]).mirror(), None, "{name}");
    }
    assert!(plant("two-sided", &[("beta", 1.0)]).mirror().is_some());
}

/// Eq. (1) and (2) of the paper, its defaults, and its natural frequencies 0.618034 and 1.618034.
#[test]
fn the_oscillator_of_luo_ma_and_lv() {
    let family = family("luo-ma-lv");
    let table: Vec<(&str, &str, f64, String)> = family
        .parameters
        .iter()
        .map(|p| (p.name.as_str(), p.symbol.as_str(), p.default, p.range.to_string()))
        .collect();
    let within = |ends: &str| format!("between 0 and 1, ends {ends}");
    let expected = [
        ("omega", "ω", 3.7, "between 0 and 1000000, the lower end excluded".to_owned()),
        ("delta", "δ", 0.1, "0 or greater".to_owned()),
        ("zeta", "ζ", 0.1, "0 or greater".to_owned()),
        ("r", "r", 0.8, within("included")),
        ("mu_m", "μm", 0.5, within("excluded")),
        ("mu_k", "μk", 0.5, within("excluded")),
        ("mu_c", "μc", 0.5, within("excluded")),
        ("f20", "f20", 0.0, within("included")),
    ];
    assert_eq!(table, expected);
    assert_eq!(family.label_order(), [1, 0]);
    let named = [family.stop("A"), family.stop("Ā"), family.stop("B")];
    assert_eq!(named, [Some(0), Some(1), Some(1)]);
    let golden = squared_frequencies(&plant("luo-ma-lv", &[]));
    assert!(close(&golden, &[0.618034 * 0.618034, 1.618034 * 1.618034]), "{golden:?}");

    let changes = [("zeta", 0.3), ("mu_m", 0.2), ("mu_k", 0.75), ("mu_c", 0.6), ("f20", 0.25)];
    let plant = plant("luo-ma-lv", &changes);
    let matrix = |entries: &[f64]| DMatrix::from_row_slice(2, 2, entries);
    assert!((plant.mass - matrix(&[1.0, 0.0, 0.0, 0.25])).amax() < 1e-15);
    assert!((plant.damping - matrix(&[0.6, -0.6, -0.6, 1.5])).amax() < 1e-15);
    assert!((plant.stiffness - matrix(&[1.0, -1.0, -1.0, 4.0])).amax() < 1e-15);
    assert_eq!(plant.force_sin.as_slice(), [0.75, 0.25]);
    assert_eq!([plant.stops[0].direction[0], plant.stops[1].direction[0]], [1.0, -1.0]);
    assert_eq!([plant.stops[0].gap, plant.stops[1].gap, plant.omega], [0.1, 0.1, 3.7]);
}

#[test]
fn the_documentation_shows_the_oscillator_of_shaw_and_holmes() {
    let shown = Family::parse(example(), "example").unwrap();
    assert_eq!(shown.plant(&shown.defaults()).unwrap(), plant("shaw-holmes", &[]));
}

/// The ball leaves the table where Γ sin t exceeds 1, gravity; the stop holds it from below.
#[test]
fn the_ball_falls_on_its_table() {
    let ball = plant("bouncing-ball", &[("Gamma", 2.5)]);
    assert_eq!((ball.force_sin[0], ball.force_cos[0], ball.load[0]), (2.5, 0.0, -1.0));
    assert_eq!((ball.omega, ball.mass[0], ball.damping[0], ball.stiffness[0]), (1.0, 1.0, 0.0, 0.0));
    assert_eq!((ball.stops.len(), ball.stops[0].direction[0], ball.stops[0].gap), (1, -1.0, 0.0));
}

/// A chain of equal masses and springs between two grounds has ω² = 2 − √2, 2, 2 + √2.
#[test]
fn the_chain_has_its_natural_frequencies() {
    let chain = plant("three-mass-chain", &[]);
    let root = 2.0_f64.sqrt();
    assert!(close(&squared_frequencies(&chain), &[2.0 - root, 2.0, 2.0 + root]));
    assert!((&chain.damping - 2.0 * 0.05 * &chain.stiffness).amax() < 1e-15);
    assert!(chain.stops.iter().all(|stop| stop.direction[0] == 0.0 && stop.direction[2] == 0.0));
}

/// An impact between two masses changes the momentum of the two by Σd, which must vanish; the damper's mass is free.
#[test]
fn relative_stops_conserve_momentum() {
    for name in ["colliding-pair", "impact-damper"] {
        let plant = plant(name, &[]);
        assert!(plant.stops.iter().all(|stop| stop.direction.sum() == 0.0), "{name}");
    }
    let damper = plant("impact-damper", &[("mu", 0.25)]);
    let free = DVector::from_row_slice(&[0.0, 1.0]);
    assert_eq!((&damper.stiffness * &free).amax() + (&damper.damping * &free).amax(), 0.0);
    assert_eq!(damper.mass[(1, 1)], 0.25);
    let pair = plant("colliding-pair", &[("mu", 0.5), ("kappa", 2.0)]);
    assert!(close(&squared_frequencies(&pair), &[1.0, 4.0]));
}

#[test]
fn distances_of_the_stops() {
    let gaps = |name: &str, changes: &[(&str, f64)]| -> Vec<f64> {
        plant(name, changes).stops.iter().map(|stop| stop.gap * stop.direction[0].signum()).collect()
    };
    assert_eq!(gaps("two-sided", &[("delta", 0.25), ("beta", 3.0)]), [0.25, -0.75]);
    assert_eq!(gaps("impact-pair", &[("nu", 2.5)]), [2.5, -2.5]);
    assert_eq!(gaps("shaw-holmes", &[("sigma", -0.5)]), [-0.5]);
}
