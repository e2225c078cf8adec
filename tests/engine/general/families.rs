//! The families that come with the program run without failure.

use impact_atlas::model::Real;
use impact_atlas::system::{BUILTIN, Family, Plant};

use crate::general::subject::follow;

/// Some cells of a family: the defaults, and values spread over the axes of its default plane.
fn plants(family: &Family) -> Vec<Plant> {
    let mut plants = vec![family.plant(&family.defaults()).unwrap()];
    let Some(plane) = &family.plane else { return plants };
    let axis = |text: &str| {
        let (name, range) = text.split_once('=').unwrap();
        let numbers: Vec<f64> = range.split(':').map(|number| number.parse().unwrap()).collect();
        (family.parameter(name).unwrap(), numbers[0], numbers[1])
    };
    let (x, y) = (axis(&plane.x), axis(&plane.y));
    for (s, t) in [(0.02, 0.03), (0.1, 0.9), (0.35, 0.3), (0.6, 0.7), (0.95, 0.1), (0.3, 0.0)] {
        let mut values = family.defaults();
        for ((id, first, last), share) in [(x, s), (y, t)] {
            values[id.index()] = first + share * (last - first);
        }
        plants.push(family.plant(&values).unwrap());
    }
    plants
}

/// A small push, within the stops: for each mass another.
fn push(plant: &Plant) -> Vec<f64> {
    let x = vec![0.0; plant.n];
    x.into_iter().chain((0..plant.n).map(|i| 0.1 - 0.15 * i as f64)).collect()
}

fn runs<T: Real>(penetration: f64) {
    for builtin in BUILTIN {
        let family = Family::parse(builtin.text, builtin.name).unwrap();
        for plant in plants(&family) {
            let inside = plant.stops.iter().all(|stop| stop.gap >= 0.0);
            if !inside {
                continue;
            }
            for start in [vec![0.0; 2 * plant.n], push(&plant)] {
                let periods = follow::<T>(&plant, &start, 300);
                let what = format!("{}: {plant:?} from {start:?}", builtin.name);
                assert_eq!(periods.len(), 300, "no headway after {} periods: {what}", periods.len());
                for period in &periods {
                    assert!(period.strobe.iter().all(|x| x.is_finite()), "not finite: {what}");
                    assert!(period.penetration < penetration, "{:e} beyond: {what}", period.penetration);
                }
            }
        }
    }
}

#[test]
fn built_in_families_run_in_f64() {
    runs::<f64>(1e-12);
}

#[test]
fn built_in_families_run_in_f32() {
    runs::<f32>(1e-5);
}
