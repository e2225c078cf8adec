//! Plants and starts drawn over what can be described, the same on every run.

use impact_atlas::system::{Plant, PlantStop};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A plant with a start at forcing phase 0.
#[derive(Clone, Debug)]
pub struct Setup {
    pub plant: Plant,
    /// x1 … xn, v1 … vn.
    pub start: Vec<f64>,
}

/// How the stops stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layout {
    /// One stop for one mass.
    One,
    /// Two stops for one mass, at different distances.
    Two,
    /// One mass meets another.
    Relative,
    /// One mass meets another and a wall, or two.
    RelativeAndWall,
    /// A stop for each of two masses.
    Each,
    /// Any directions.
    Slanted,
}

/// So many setups from a seed.
pub fn setups(count: usize, seed: u64) -> Vec<Setup> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut setups = Vec::new();
    while setups.len() < count {
        setups.extend(setup(&mut rng));
    }
    setups
}

/// A plant of given coordinates; `None` where the drawn one is refused, or its start finds no place.
fn setup(rng: &mut ChaCha8Rng) -> Option<Setup> {
    let n = rng.random_range(1..=3);
    let layouts: &[Layout] = match n {
        1 => &[Layout::One, Layout::Two],
        _ => &[
            Layout::One,
            Layout::Two,
            Layout::Relative,
            Layout::RelativeAndWall,
            Layout::Each,
            Layout::Slanted,
        ],
    };
    let layout = layouts[rng.random_range(0..layouts.len())];
    let stops = stops(rng, n, layout);
    let plant = plant(rng, n, stops);
    plant.check().ok()?;
    let start = start(rng, &plant)?;
    Some(Setup { plant, start })
}

fn symmetric(rng: &mut ChaCha8Rng, n: usize, least: f64) -> DMatrix<f64> {
    let factor = DMatrix::from_fn(n, n, |i, j| if j > i { 0.0 } else { rng.random_range(-0.8..0.8) });
    &factor * factor.transpose() + DMatrix::identity(n, n) * least
}

/// Any matrices: diagonal or full, singular or not, symmetric or not.
pub fn plant(rng: &mut ChaCha8Rng, n: usize, stops: Vec<PlantStop>) -> Plant {
    let mass = if rng.random() {
        DMatrix::from_diagonal(&DVector::from_fn(n, |_, _| rng.random_range(0.3..2.0)))
    } else {
        symmetric(rng, n, 0.4)
    };
    let mut stiffness = symmetric(rng, n, 0.3);
    match rng.random_range(0..6) {
        0 => stiffness.row_mut(0).fill(0.0),
        1 => {
            let factor = DVector::from_fn(n, |_, _| rng.random_range(-1.0..1.0));
            stiffness = &factor * factor.transpose();
        }
        2 => {
            stiffness += DMatrix::from_fn(n, n, |i, j| if i == j { 0.0 } else { rng.random_range(-0.3..0.3) })
        }
        _ => {}
    }
    let mut damping = match rng.random_range(0..4) {
        0 => DMatrix::zeros(n, n),
        1 => &stiffness * 0.1,
        _ => symmetric(rng, n, 0.05) * rng.random_range(0.05..0.5),
    };
    if n > 1 && rng.random_range(0..5) == 0 {
        damping[(0, 1)] += 0.2;
        damping[(1, 0)] -= 0.2;
    }
    let loads = |rng: &mut ChaCha8Rng, share: u32| {
        let some = rng.random_range(0..4) < share;
        DVector::from_fn(n, |_, _| if some { rng.random_range(-1.0..1.0) } else { 0.0 })
    };
    Plant {
        n,
        mass,
        damping,
        stiffness,
        force_sin: loads(rng, 3),
        force_cos: loads(rng, 2),
        load: loads(rng, 2),
        omega: rng.random_range(-0.9_f64..1.2).exp(),
        stops,
    }
}

fn stops(rng: &mut ChaCha8Rng, n: usize, layout: Layout) -> Vec<PlantStop> {
    let unit = |i: usize, sign: f64| DVector::from_fn(n, |j, _| if i == j { sign } else { 0.0 });
    let between = |i: usize, j: usize| {
        DVector::from_fn(n, |k, _| {
            if k == i {
                1.0
            } else if k == j {
                -1.0
            } else {
                0.0
            }
        })
    };
    let mass = rng.random_range(0..n);
    let other = (mass + 1) % n;
    let directions = match layout {
        Layout::One => vec![unit(mass, if rng.random() { 1.0 } else { -1.0 })],
        Layout::Two => vec![unit(mass, 1.0), unit(mass, -1.0)],
        Layout::Relative => vec![between(mass, other)],
        Layout::RelativeAndWall => {
            let mut directions = vec![between(mass, other), unit(other, -1.0)];
            if rng.random() {
                directions.push(between(other, mass));
            }
            directions
        }
        Layout::Each => vec![unit(mass, 1.0), unit(other, -1.0), unit(mass, -1.0)],
        Layout::Slanted => {
            let mut slanted = || DVector::from_fn(n, |_, _| rng.random_range(-1.0..1.0));
            vec![slanted(), slanted()]
        }
    };
    let restitution = |rng: &mut ChaCha8Rng| match rng.random_range(0..12) {
        0 => 0.0,
        1 => 1.0,
        _ => rng.random_range(0.1..0.95),
    };
    directions
        .into_iter()
        .map(|direction| PlantStop {
            direction,
            gap: if rng.random_range(0..8) == 0 { 0.0 } else { rng.random_range(-0.1..0.8) },
            restitution: restitution(rng),
        })
        .collect()
}

/// At rest or moving, and inside all stops.
pub fn start(rng: &mut ChaCha8Rng, plant: &Plant) -> Option<Vec<f64>> {
    let n = plant.n;
    let still = rng.random_range(0..3) == 0;
    let mut x = DVector::from_fn(n, |_, _| if still { 0.0 } else { rng.random_range(-0.3..0.3) });
    let v = DVector::from_fn(n, |_, _| if still { 0.0 } else { rng.random_range(-0.8..0.8) });
    let room = 0.02;
    for _ in 0..200 {
        let beyond = |stop: &&PlantStop| stop.direction.dot(&x) > stop.gap - room;
        let Some(stop) = plant.stops.iter().find(beyond) else {
            return Some(x.iter().chain(v.iter()).copied().collect());
        };
        let over = stop.direction.dot(&x) - stop.gap + 1.5 * room;
        x -= &stop.direction * (over / stop.direction.norm_squared());
    }
    None
}
