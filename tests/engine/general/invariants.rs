//! What no impact may change.

use impact_atlas::system::Plant;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::common::general::draw::setups;
use crate::general::subject::{follow, masses, stop};

fn energy(plant: &Plant, state: &[f64]) -> f64 {
    let x = DVector::from_row_slice(&state[..plant.n]);
    let v = DVector::from_row_slice(&state[plant.n..]);
    0.5 * (v.dot(&(&plant.mass * &v)) + x.dot(&(&plant.stiffness * &x))) - plant.load.dot(&x)
}

/// A drawn plant without forcing, damping and loss, its matrices symmetric; the constant load stays.
fn conservative(mut plant: Plant) -> Plant {
    plant.damping.fill(0.0);
    plant.force_sin.fill(0.0);
    plant.force_cos.fill(0.0);
    plant.stiffness = (&plant.stiffness + plant.stiffness.transpose()) * 0.5;
    plant.stops.iter_mut().for_each(|stop| stop.restitution = 1.0);
    plant
}

#[test]
fn energy_is_conserved_without_forcing_damping_and_loss() {
    let drifts: Vec<(f64, u32, String)> = setups(200, 0xE4E7)
        .into_par_iter()
        .filter(|setup| setup.start.iter().any(|x| *x != 0.0))
        .map(|setup| {
            let plant = conservative(setup.plant);
            let begin = energy(&plant, &setup.start);
            let periods = follow::<f64>(&plant, &setup.start, 10);
            let impacts = periods.iter().flat_map(|p| p.impacts).sum();
            let drift = |p: &crate::general::subject::Period| {
                let sizes: f64 = p.strobe.iter().map(|x| x * x).sum();
                (energy(&plant, &p.strobe) - begin).abs() / (1.0 + sizes)
            };
            let worst = periods.iter().map(drift).fold(0.0, f64::max);
            (worst, impacts, format!("{plant:?} from {:?}", setup.start))
        })
        .collect();
    let impacts: u32 = drifts.iter().map(|(_, impacts, _)| impacts).sum();
    let (worst, _, which) = drifts.iter().max_by(|a, b| a.0.total_cmp(&b.0)).unwrap();
    println!("{} plants, {impacts} impacts, largest drift {worst:e}", drifts.len());
    assert!(impacts > 1000);
    assert!(*worst < 1e-11, "{worst:e}: {which}");
}

#[test]
fn energy_falls_where_impacts_lose_it() {
    let mut lost = 0;
    for setup in setups(40, 0xE4E7) {
        let mut plant = conservative(setup.plant);
        plant.stops.iter_mut().for_each(|stop| stop.restitution = 0.7);
        let begin = energy(&plant, &setup.start);
        let periods = follow::<f64>(&plant, &setup.start, 5);
        let impacts: u32 = periods.iter().flat_map(|p| p.impacts).sum();
        let change = energy(&plant, &periods[4].strobe) - begin;
        assert!(change < 1e-10, "energy grows by {change:e}: {plant:?}");
        lost += u32::from(impacts > 0 && change < -1e-6);
    }
    assert!(lost > 10);
}

/// Two masses joined by a spring and a damper and free to drift: what they do to each other keeps their momentum.
#[test]
fn momentum_is_kept_where_nothing_is_fixed_to_the_ground() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for _ in 0..40 {
        let (first, second) = (rng.random_range(0.3..2.0), rng.random_range(0.3..2.0));
        let (spring, damper) = (rng.random_range(0.0..3.0), rng.random_range(0.0..0.5));
        let joint = |k: f64| DMatrix::from_row_slice(2, 2, &[k, -k, -k, k]);
        let r = rng.random_range(0.0..1.0);
        let mut plant = masses(&[first, second], rng.random_range(0.5..2.0));
        (plant.stiffness, plant.damping) = (joint(spring), joint(damper));
        let push = rng.random_range(-1.0..1.0);
        plant.force_sin = DVector::from_row_slice(&[push, -push]);
        plant.load = DVector::from_row_slice(&[0.4, -0.4]);
        plant.stops = vec![stop(&[1.0, -1.0], 0.1, r), stop(&[-1.0, 1.0], 0.8, r)];
        let start = [0.0, 0.1, rng.random_range(0.2..1.0), rng.random_range(-1.0..-0.2)];
        let momentum = |state: &[f64]| first * state[2] + second * state[3];
        let periods = follow::<f64>(&plant, &start, 20);
        let impacts: u32 = periods.iter().flat_map(|p| p.impacts).sum();
        assert!(
            periods.len() == 20 && impacts > 0,
            "{impacts} impacts in {} periods: {plant:?}",
            periods.len()
        );
        for period in periods {
            let off = (momentum(&period.strobe) - momentum(&start)).abs();
            assert!(off < 1e-12, "momentum off by {off:e}: {plant:?} from {start:?}");
        }
    }
}
