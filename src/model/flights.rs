//! The constants of many cells at once.

use rayon::prelude::*;

use super::by_flow::ByFlow;
use super::flight::Flight;
use super::real::Real;
use super::system::System;

/// The constants of many cells in a precision, those of each distinct flow computed once.
#[derive(Debug)]
pub struct Flights<T, const N: usize> {
    /// One flight of each distinct flow; none where hardly a cell has its flow in common with another: there they would be many and
    /// large, and each is computed when it is asked for.
    distinct: Vec<Flight<T, N>>,
    /// Which of them belongs to each cell.
    of_cell: Vec<u32>,
}

impl<T: Real, const N: usize> Flights<T, N> {
    /// Prepares cells of N coordinates.
    pub fn of(ByFlow { distinct, of_cell }: ByFlow<'_>) -> Self {
        let are_shared = 2 * distinct.len() <= of_cell.len();
        let computed = |systems: Vec<&System>| systems.into_par_iter().map(alone).collect();
        Flights { distinct: if are_shared { computed(distinct) } else { Vec::new() }, of_cell }
    }

    /// The constants of one of the cells, the same as [`Flight::new`] has them, rounded.
    pub fn get(&self, cell: usize, system: &System) -> Flight<T, N> {
        let known = self.distinct.get(self.of_cell[cell] as usize);
        known.map_or_else(|| alone(system), |flight| flight.with_stops_of(system))
    }

    /// Puts the constants of one of the cells, as [`Flights::get`] has them, in the place of those of another, `from`.
    pub fn put(&self, cell: usize, system: &System, from: usize, into: &mut Flight<T, N>) {
        if self.of_cell[cell] != self.of_cell[from] {
            let known = self.distinct.get(self.of_cell[cell] as usize);
            *into = known.copied().unwrap_or_else(|| alone(system));
        }
        into.take_stops_of(system);
    }

    /// Which of the distinct flows a cell has.
    pub fn flow_of(&self, cell: usize) -> u32 {
        self.of_cell[cell]
    }
}

/// The constants of a cell that has them from no other.
fn alone<T: Real, const N: usize>(system: &System) -> Flight<T, N> {
    Flight::<f64, N>::new(system).round()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;
    use crate::system::{Family, Setting};

    fn system(omega: f64, delta: f64, r: f64) -> System {
        System::new(Parameters { omega, delta, r, ..Parameters::default() }).unwrap()
    }

    #[test]
    fn shared_flows_give_the_constants_of_each_cell() {
        check::<f64>();
        check::<f32>();
    }

    fn check<T: Real>() {
        let mut systems = Vec::new();
        for omega in [1.3, 2.7] {
            for (delta, r) in [(0.1, 0.8), (0.37, 0.8), (0.02, 0.5), (0.0, 0.9)] {
                systems.push(system(omega, delta, r));
            }
        }
        let cells: Vec<&System> = systems.iter().collect();
        let shared = Flights::<T, 2>::of(ByFlow::of(&cells, |system| *system));
        assert_eq!(shared.distinct.len(), 2);
        // Of cells that have nothing in common nothing is kept.
        let alone = [&systems[0], &systems[5]];
        let not_shared = Flights::<T, 2>::of(ByFlow::of(&alone, |system| *system));
        assert!(not_shared.distinct.is_empty());
        compare(&shared, &cells);
        compare(&not_shared, &alone);
        // A stop on one side alone.
        let one_sided = Setting::defaults(Family::builtin("shaw-holmes"));
        let systems = [0.1, 0.2, 0.3].map(|gap| System::new(one_sided.with_named("sigma", gap)).unwrap());
        let cells: Vec<&System> = systems.iter().collect();
        compare(&Flights::<T, 1>::of(ByFlow::of(&cells, |system| *system)), &cells);
    }

    fn compare<T: Real, const N: usize>(flights: &Flights<T, N>, cells: &[&System]) {
        let of = |system: &System| Flight::<f64, N>::new(system).round::<T>();
        for (i, system) in cells.iter().enumerate() {
            assert_eq!(flights.get(i, system), of(system), "{system:?}");
            // The test can fail: the constants of another cell differ.
            let other = cells[(i + 1) % cells.len()];
            assert_ne!(flights.get(i, system), of(other));
            for from in 0..cells.len() {
                let mut flight = flights.get(from, cells[from]);
                flights.put(i, system, from, &mut flight);
                assert_eq!(flight, flights.get(i, system), "{i} after {from}");
            }
        }
    }
}
