//! Cells that share their flow: what differs among them are gaps and restitutions alone.

use std::collections::HashMap;

use rayon::prelude::*;

use super::equations::closed;
use super::flight::Flight;
use super::system::System;

/// The constants of many cells, those of each distinct flow computed once.
#[derive(Debug)]
pub struct Flights<const N: usize> {
    /// One flight of each distinct flow.
    distinct: Vec<Flight<f64, N>>,
    /// Which of them belongs to each cell.
    of_cell: Vec<usize>,
}

impl<const N: usize> Flights<N> {
    /// Prepares cells of N coordinates.
    pub fn of(systems: &[&System]) -> Self {
        let flows: Vec<Vec<u64>> = systems.par_iter().map(|system| flow(system)).collect();
        let mut first: HashMap<&[u64], usize> = HashMap::new();
        let mut cells: Vec<&System> = Vec::new();
        let mut of_cell = Vec::with_capacity(systems.len());
        for (flow, system) in flows.iter().zip(systems) {
            let distinct = *first.entry(flow).or_insert_with(|| {
                cells.push(system);
                cells.len() - 1
            });
            of_cell.push(distinct);
        }
        let distinct = cells.par_iter().map(|system| Flight::new(system)).collect();
        Flights { distinct, of_cell }
    }

    /// The constants of one of the cells, the same as [`Flight::new`] has them.
    pub fn get(&self, cell: usize, system: &System) -> Flight<f64, N> {
        self.distinct[self.of_cell[cell]].with_stops_of(system)
    }

    /// How many distinct flows there are.
    pub fn distinct(&self) -> usize {
        self.distinct.len()
    }
}

impl<const N: usize> Flight<f64, N> {
    /// The constants of another cell with the same flow.
    #[must_use]
    pub(super) fn with_stops_of(&self, system: &System) -> Self {
        let mut flight = *self;
        let stops = &system.plant().stops;
        for (k, normal) in flight.normals.iter_mut().enumerate().take(self.count) {
            let ends = [0, 1].map(|side| {
                (self.normals[k].gap[side] < super::FAR).then(|| usize::from(self.normals[k].stop[side]))
            });
            // The direction of a line is that of the first stop on it.
            let Some(first) = ends.into_iter().flatten().min() else { continue };
            for (side, stop) in ends.into_iter().enumerate() {
                let Some(stop) = stop else { continue };
                let (given, along) = (&stops[stop], &stops[first].direction);
                let scale =
                    if stop == first { 1.0 } else { given.direction.dot(along) / along.norm_squared() };
                normal.gap[side] = given.gap / scale.abs();
                normal.restitution[side] = given.restitution;
            }
            if ends.iter().all(Option::is_some) {
                normal.gap[1] = closed(normal.gap);
            }
        }
        flight
    }
}

/// The bits of everything that the constants of a cell depend on but gaps and restitutions; of those, which are alike.
pub(super) fn flow(system: &System) -> Vec<u64> {
    let plant = system.plant();
    let mut bits = vec![plant.n as u64, u64::from(system.steps()), plant.stops.len() as u64];
    let numbers = [&plant.mass, &plant.damping, &plant.stiffness].into_iter().flat_map(|m| m.iter());
    let loads = [&plant.force_sin, &plant.force_cos, &plant.load].into_iter().flat_map(|v| v.iter());
    let normals = plant.stops.iter().flat_map(|stop| stop.direction.iter());
    bits.extend(
        [plant.omega, system.rate()].iter().chain(numbers).chain(loads).chain(normals).map(|x| x.to_bits()),
    );
    // Whether there is a mirror depends on which stops have the same gap and restitution.
    if plant.stops.len() > 1 {
        bits.extend(system.mirrored_stops());
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    fn system(omega: f64, delta: f64, r: f64) -> System {
        System::new(Parameters { omega, delta, r, ..Parameters::default() }).unwrap()
    }

    #[test]
    fn shared_flows_give_the_constants_of_each_cell() {
        let mut systems = Vec::new();
        for omega in [1.3, 2.7] {
            for (delta, r) in [(0.1, 0.8), (0.37, 0.8), (0.02, 0.5), (0.0, 0.9)] {
                systems.push(system(omega, delta, r));
            }
        }
        let cells: Vec<&System> = systems.iter().collect();
        let flights = Flights::<2>::of(&cells);
        assert_eq!(flights.distinct(), 2);
        for (i, system) in systems.iter().enumerate() {
            assert_eq!(flights.get(i, system), Flight::new(system), "{system:?}");
            // The test can fail: the constants of another cell differ.
            let other = &systems[(i + 1) % systems.len()];
            assert_ne!(flights.get(i, system), Flight::new(other));
        }
    }
}
