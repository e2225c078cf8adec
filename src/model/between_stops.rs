//! States that lie beyond stops, moved between them.

use std::ops::DerefMut;

use arrayvec::ArrayVec;
use nalgebra::{DMatrix, DVector};

use super::equations::are_parallel;
use super::system::System;
use crate::system::Plant;

impl System {
    /// A state (x1 … xn, v1 … vn) whose displacements lie beyond stops, moved onto these along their directions, of all of them at once;
    /// one that lies between the stops as it is.
    #[must_use]
    pub fn between_stops<S: DerefMut<Target = [f64]>>(&self, mut state: S) -> S {
        let stops: ArrayVec<(&DVector<f64>, f64), { Plant::MOST_STOPS }> =
            self.stops().map(|(direction, stop)| (direction, stop.gap)).collect();
        let mut held: ArrayVec<(&DVector<f64>, f64), { Plant::MOST_STOPS }> = ArrayVec::new();
        loop {
            let beyond = |&(direction, gap): &(&DVector<f64>, f64)| along(direction, &state) - gap;
            // On a line that it lies on already it stays, and nothing moves it beyond the stop at the other end.
            let lies = |direction: &DVector<f64>| {
                held.iter().any(|(own, _)| are_parallel(own.as_slice(), direction.as_slice()))
            };
            let more: ArrayVec<_, { Plant::MOST_STOPS }> =
                stops.iter().copied().filter(|stop| beyond(stop) > 0.0 && !lies(stop.0)).collect();
            if more.is_empty() {
                return state;
            }
            held.extend(more);
            let excess = DVector::from_iterator(held.len(), held.iter().map(beyond));
            let products = DMatrix::from_fn(held.len(), held.len(), |i, j| held[i].0.dot(held[j].0));
            // Directions are independent, where they are not parallel.
            let Some(pushes) = products.lu().solve(&excess) else { return state };
            for ((direction, _), push) in held.iter().zip(pushes.iter()) {
                for (value, d) in state.iter_mut().zip(direction.iter()) {
                    *value -= push * d;
                }
            }
        }
    }
}

/// d·x.
fn along(direction: &DVector<f64>, state: &[f64]) -> f64 {
    direction.iter().zip(state).map(|(d, x)| d * x).sum()
}

#[cfg(test)]
mod tests {
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::model::Parameters;
    use crate::system::PlantStop;

    /// Three masses in a row that meet each other, and a wall.
    fn row() -> System {
        let stop = |direction: [f64; 3], gap| PlantStop {
            direction: DVector::from_row_slice(&direction),
            gap,
            restitution: 0.7,
        };
        let plant = Plant {
            n: 3,
            mass: DMatrix::identity(3, 3),
            damping: DMatrix::zeros(3, 3),
            stiffness: DMatrix::identity(3, 3),
            force_sin: DVector::zeros(3),
            force_cos: DVector::zeros(3),
            load: DVector::zeros(3),
            omega: 1.0,
            stops: vec![
                stop([1.0, -1.0, 0.0], 0.0),
                stop([0.0, 1.0, -1.0], 0.1),
                stop([0.0, 0.0, 2.0], 0.4),
                stop([-1.0, 1.0, 0.0], 0.3),
            ],
        };
        System::of_plant(plant).unwrap()
    }

    #[test]
    fn a_state_lies_within_every_stop_then() {
        let (system, mut random) = (row(), ChaCha8Rng::seed_from_u64(4));
        let beyond = |state: &[f64]| {
            system.stops().map(|(d, stop)| along(d, state) - stop.gap).fold(f64::NEG_INFINITY, f64::max)
        };
        let (mut moved, mut once) = (0, 0);
        for _ in 0..2000 {
            let state: Vec<f64> = (0..6).map(|_| random.random_range(-2.0..2.0)).collect();
            let placed = system.between_stops(state.clone());
            assert!(beyond(&placed) <= 1e-12, "{state:?} became {placed:?}");
            assert_eq!(placed[3..], state[3..]);
            assert_eq!(placed == state, beyond(&state) <= 0.0);
            moved += u32::from(placed != state);
            // One stop after the other, as each is met, is not enough.
            let mut one_by_one = state.clone();
            for (d, stop) in system.stops() {
                let excess = (along(d, &one_by_one) - stop.gap).max(0.0) / d.norm_squared();
                one_by_one.iter_mut().zip(d.iter()).for_each(|(x, d)| *x -= excess * d);
            }
            once += u32::from(beyond(&one_by_one) > 1e-9);
        }
        assert!(moved > 500 && once > 100, "{moved} of 2000 were moved, {once} would lie beyond still");
    }

    #[test]
    fn a_single_mass_is_put_onto_its_stop() {
        let system = System::new(Parameters { delta: 0.25, ..Parameters::default() }).unwrap();
        for (x, placed) in [(0.75, 0.25), (-0.75, -0.25), (0.2, 0.2)] {
            assert_eq!(system.between_stops(vec![x, 0.7, -3.0, 0.5]), [placed, 0.7, -3.0, 0.5]);
        }
    }
}
