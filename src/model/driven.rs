//! A second harmonic force, beside the forcing: one coordinate more.

use super::system::System;
use super::system_error::SystemError;
use super::vector::MOST;
use crate::system::{Mirror, Plant, PlantStop};

impl System {
    /// The system with a force u = B sin θ, θ' = γω, `ratio` = γ ≥ 0, on one coordinate, in steps that are short enough for it;
    /// everything is non-dimensional.
    ///
    /// The force is the last coordinate, u″ = −(γω)² u, which no other one disturbs: so flight stays exact, and a deviation of
    /// the force is one of the state. Its amplitude and phase are what its state (B sin θ, γω B cos θ) says. The system is only to
    /// be flown: its setting, stops and mirror are those of the system without the force.
    ///
    /// # Errors
    /// [`SystemError::TooStiff`] where one forcing period would hold too many steps.
    ///
    /// # Panics
    /// If there is no such coordinate, or a force is a coordinate already.
    pub fn driven(&self, coordinate: usize, ratio: f64) -> Result<Self, SystemError> {
        let plant = self.plant();
        let n = plant.n;
        assert!(coordinate < n && n <= MOST, "coordinate {coordinate} of {n}");
        let square = |matrix: &nalgebra::DMatrix<f64>| matrix.clone().resize(n + 1, n + 1, 0.0);
        let vector = |vector: &nalgebra::DVector<f64>| vector.clone().resize_vertically(n + 1, 0.0);
        let [mut mass, damping, mut stiffness] = [&plant.mass, &plant.damping, &plant.stiffness].map(square);
        mass[(n, n)] = 1.0;
        stiffness[(n, n)] = (ratio * plant.omega).powi(2);
        stiffness[(coordinate, n)] = -1.0;
        let extended = |stop: &PlantStop| PlantStop { direction: vector(&stop.direction), ..*stop };
        let driven = self.with_sound_plant(Plant {
            n: n + 1,
            mass,
            damping,
            stiffness,
            force_sin: vector(&plant.force_sin),
            force_cos: vector(&plant.force_cos),
            load: vector(&plant.load),
            omega: plant.omega,
            stops: plant.stops.iter().map(extended).collect(),
        })?;
        // What is of order one without the force is with it.
        driven.of_flow().forced(|| self.forced());
        driven.of_flow().mirror(|| {
            self.mirror().map(|Mirror { matrix, stops }| {
                let mut matrix = square(matrix);
                matrix[(n, n)] = 1.0;
                Mirror { matrix, stops: stops.clone() }
            })
        });
        Ok(driven)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Flight, Parameters};

    #[test]
    fn a_force_takes_steps_that_are_short_enough_for_it() {
        let system = System::new(Parameters::default()).unwrap();
        let slow = system.driven(0, 0.5).unwrap();
        let fast = system.driven(0, 40.0).unwrap();
        assert_eq!(slow.plant().n, 3);
        assert!(slow.rate() < 1.2 * system.rate(), "{} {}", slow.rate(), system.rate());
        let frequency = 40.0 * system.plant().omega;
        assert!((1.0..1.1).contains(&(fast.rate() / frequency)), "{}", fast.rate());
        assert!(system.driven(0, 1e9).is_err());
        assert!(system.driven(0, f64::NAN).is_err());
    }

    #[test]
    fn contacts_are_those_without_the_force() {
        let system = System::new(Parameters::default()).unwrap();
        let flight = Flight::<f64, 2>::new(&system);
        let driven = Flight::<f64, 3>::new(&system.driven(1, 0.5).unwrap());
        for (own, driven) in flight.normals().iter().zip(driven.normals()) {
            assert_eq!(driven.direction, [own.direction[0], own.direction[1], 0.0]);
            assert_eq!(driven.response, [own.response[0], own.response[1], 0.0]);
            assert_eq!((driven.gap, driven.restitution, driven.stop), (own.gap, own.restitution, own.stop));
        }
        assert_eq!(driven.count, flight.count);
        let sign = |i: usize, j: usize| if i == j && i < 2 { -1.0 } else { f64::from(u8::from(i == j)) };
        let mirror = std::array::from_fn(|j| std::array::from_fn(|i| sign(i, j)));
        assert_eq!(driven.mirror, Some(mirror), "of the masses alone");
    }
}
