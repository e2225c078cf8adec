//! The largest Lyapunov exponent from two nearby trajectories (Benettin).

use super::follow::Follower;
use super::plant::Plant;

/// The distance at which the companion follows.
const DISTANCE: f64 = 1e-7;

/// The largest exponent per forcing period, over `observe` periods after `transient` ones.
///
/// The companion is put back to the same distance after every period. The distance is small but finite, so
/// impacts of both trajectories must come in pairs: meant for motions without sticking and away from grazing.
pub fn largest(plant: Plant, start: [f64; 4], transient: usize, observe: usize) -> f64 {
    let mut main = Follower::<f64>::new(plant, start);
    for _ in 0..transient {
        main.next_period();
    }
    let mut direction = [0.5, -0.5, 0.5, 0.5];
    let settling = observe / 10;
    let mut sum = 0.0;
    for period in 0..settling + observe {
        let here = main.position();
        let mut companion = main.another(std::array::from_fn(|i| here[i] + DISTANCE * direction[i]));
        let (main, moved) = (main.next_period().strobe, companion.next_period().strobe);
        let difference: [f64; 4] = std::array::from_fn(|i| moved[i] - main[i]);
        let distance = difference.iter().map(|d| d * d).sum::<f64>().sqrt();
        direction = difference.map(|d| d / distance);
        if period >= settling {
            sum += (distance / DISTANCE).ln();
        }
    }
    sum / observe as f64
}
