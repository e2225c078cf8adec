//! A forced linear motion touches a stop at its amplitude, and not a hair further off.

use nalgebra::{Complex, DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::common::general::draw::plant;
use crate::general::subject::{follow, stop};

#[test]
fn forced_motion_grazes_where_the_gap_is_its_amplitude() {
    let mut rng = ChaCha8Rng::seed_from_u64(17);
    let mut seen = 0;
    while seen < 60 {
        let n = rng.random_range(1..=3);
        let direction: Vec<f64> = (0..n).map(|_| rng.random_range(-1.0..1.0)).collect();
        let mut plant = plant(&mut rng, n, vec![stop(&direction, 1e3, 0.8)]);
        let complex = |m: &DMatrix<f64>| m.map(|value| Complex::new(value, 0.0));
        let i = Complex::new(0.0, 1.0);
        let dynamic = complex(&plant.stiffness) + complex(&plant.damping) * (i * plant.omega)
            - complex(&plant.mass) * Complex::new(plant.omega * plant.omega, 0.0);
        // cos φ and sin φ are the real parts of e^{iφ} and −i e^{iφ}.
        let load = DVector::from_fn(n, |j, _| Complex::new(plant.force_cos[j], -plant.force_sin[j]));
        let Some(swing) = dynamic.lu().solve(&load) else { continue };
        let Some(mean) = plant.stiffness.clone().lu().solve(&plant.load) else { continue };
        let condition = mean.amax() + swing.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if condition.is_nan() || condition >= 20.0 {
            continue;
        }
        let d = DVector::from_row_slice(&direction);
        let along: Complex<f64> = direction.iter().zip(swing.iter()).map(|(d, z)| z * *d).sum();
        if along.norm() < 0.05 {
            continue;
        }
        let x = &mean + swing.map(|z| z.re);
        let v = swing.map(|z| -plant.omega * z.im);
        let start: Vec<f64> = x.iter().chain(v.iter()).copied().collect();
        let farthest = d.dot(&mean) + along.norm();
        for (off, touches) in [(1e-9, false), (-1e-9, true)] {
            plant.stops[0].gap = farthest + off * (1.0 + farthest.abs());
            if d.dot(&x) > plant.stops[0].gap {
                continue;
            }
            let impacts = follow::<f64>(&plant, &start, 1)[0].impacts[0];
            assert_eq!(
                impacts > 0,
                touches,
                "{impacts} impacts with the gap off by {off:e}: {plant:?} {start:?}"
            );
        }
        seen += 1;
    }
}
