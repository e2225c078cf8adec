//! Cells drawn at random.

use impact_atlas::backend::Job;
use impact_atlas::model::{Parameters, StateVector, System};
use impact_atlas::system::{BUILTIN, Family, Plant, PlantStop};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Cells of the paper's oscillator with every regime among them: chaos, chatter, sticking, no impact.
pub fn paper(count: usize) -> Vec<Job> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0040);
    (0..count)
        .map(|_| {
            let parameters = Parameters {
                omega: rng.random_range(0.3..4.5),
                delta: rng.random_range(0.002..0.6),
                r: rng.random_range(0.3..1.0),
                zeta: rng.random_range(0.005..0.2),
                ..Parameters::default()
            };
            Job { system: System::new(parameters).unwrap(), start: [0.0; 4].into() }
        })
        .collect()
}

/// Cells of every built-in family, of one to three coordinates and one to four stops.
pub fn families(count: usize) -> Vec<Vec<Job>> {
    BUILTIN.iter().map(|builtin| family(&Family::parse(builtin.text, builtin.name).unwrap(), count)).collect()
}

fn family(family: &Family, count: usize) -> Vec<Job> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0041);
    let plane = family.plane.as_ref().expect("built-in families have a plane");
    let axis = |text: &str| {
        let (name, range) = text.split_once('=').unwrap();
        let numbers: Vec<f64> = range.split(':').map(|number| number.parse().unwrap()).collect();
        (family.parameter(name).unwrap(), numbers[0], numbers[1])
    };
    let axes = [axis(&plane.x), axis(&plane.y)];
    let cell = |_| {
        let mut values = family.defaults();
        for (id, first, last) in axes {
            values[id.index()] = rng.random_range(first..last);
        }
        family.plant(&values).ok().and_then(|plant| job(&plant))
    };
    (0..count).filter_map(cell).collect()
}

/// Four equal masses in a row, as many as coordinates are followed, joined by springs and dampers; the first is forced.
pub fn row_of_four(omega: f64, stops: Vec<PlantStop>) -> Plant {
    let row = |diagonal: f64, beside: f64| {
        DMatrix::from_fn(4, 4, |i: usize, j: usize| match i.abs_diff(j) {
            0 => diagonal,
            1 => beside,
            _ => 0.0,
        })
    };
    Plant {
        n: 4,
        mass: DMatrix::identity(4, 4),
        damping: row(0.2, -0.1),
        stiffness: row(2.0, -1.0),
        force_sin: DVector::from_row_slice(&[1.0, 0.0, 0.0, 0.0]),
        force_cos: DVector::zeros(4),
        load: DVector::zeros(4),
        omega,
        stops,
    }
}

/// Cells of such a row, between stops along one contact normal, and along two.
pub fn rows_of_four(count: usize) -> [Vec<Job>; 2] {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0042);
    let stop = |coordinate: usize, sign: f64, gap: f64| PlantStop {
        direction: DVector::from_fn(4, |i, _| if i == coordinate { sign } else { 0.0 }),
        gap,
        restitution: 0.8,
    };
    [[1, 1], [1, 2]].map(|[upper, lower]| {
        let cell = |_| {
            let [omega, above, below] =
                [(0.3, 2.5), (0.05, 0.6), (0.05, 0.6)].map(|(first, last)| rng.random_range(first..last));
            let stops = vec![stop(upper, 1.0, above), stop(lower, -1.0, below)];
            job(&row_of_four(omega, stops)).expect("a row of masses can be followed")
        };
        (0..count).map(cell).collect()
    })
}

/// From rest, with a push.
fn job(plant: &Plant) -> Option<Job> {
    let system = System::of_plant(plant.clone()).ok()?;
    let n = plant.n;
    let values: Vec<f64> = (0..2 * n).map(|i| if i < n { 0.0 } else { 0.1 - 0.15 * i as f64 }).collect();
    let inside = plant.stops.iter().all(|stop| stop.gap >= 0.0);
    inside.then(|| Job { system, start: StateVector::from_slice(&values).unwrap() })
}
