//! The constants of many cells at once.

use std::hash::Hash;
use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::flight::Flight;
use super::of_flow::OfFlow;
use super::shared::flow;
use super::stops_along::StopsAlong;
use super::system::System;

/// The constants of many cells, those of each distinct flow computed once.
#[derive(Debug)]
pub struct Flights<const N: usize> {
    /// One flight of each distinct flow; none where they are computed when they are asked for.
    distinct: Vec<Flight<f64, N>>,
    /// Which of them belongs to each cell.
    of_cell: Vec<usize>,
}

impl<const N: usize> Flights<N> {
    /// Prepares cells of N coordinates.
    pub fn of(systems: &[&System]) -> Self {
        let (cells, of_cell) = told_apart(systems);
        Flights { distinct: computed(&cells), of_cell }
    }

    /// The same, but where hardly a cell has its flow in common with another: there they would be many and large, and each is
    /// computed when it is asked for.
    pub fn of_shared(systems: &[&System]) -> Self {
        let (cells, of_cell) = told_apart(systems);
        let are_shared = 2 * cells.len() <= systems.len();
        Flights { distinct: if are_shared { computed(&cells) } else { Vec::new() }, of_cell }
    }

    /// The constants of one of the cells, the same as [`Flight::new`] has them.
    pub fn get(&self, cell: usize, system: &System) -> Flight<f64, N> {
        let known = self.distinct.get(self.of_cell[cell]);
        known.map_or_else(|| Flight::new(system), |flight| flight.with_stops_of(system))
    }

    /// Puts the constants of one of the cells, as [`Flights::get`] has them, in the place of those of another, `from`.
    pub fn put(&self, cell: usize, system: &System, from: usize, into: &mut Flight<f64, N>) {
        if self.of_cell[cell] != self.of_cell[from] {
            let known = self.distinct.get(self.of_cell[cell]);
            *into = known.copied().unwrap_or_else(|| Flight::new(system));
        }
        into.take_stops_of(system);
    }

    /// The cells, those with the same flow one after the other.
    pub fn by_flow(&self) -> Vec<u32> {
        let mut cells: Vec<u32> = (0..self.of_cell.len() as u32).collect();
        cells.par_sort_by_key(|&cell| self.of_cell[cell as usize]);
        cells
    }

    /// The constants of some cell of each distinct flow; none where [`Flights::of_shared`] found too many.
    pub fn distinct(&self) -> &[Flight<f64, N>] {
        &self.distinct
    }

    /// Which of the distinct flows a cell has.
    pub fn flow_of(&self, cell: usize) -> u32 {
        self.of_cell[cell] as u32
    }

    /// The stops along each normal of one of the cells.
    ///
    /// # Panics
    /// Where [`Flights::of_shared`] found too many flows.
    pub fn stops(&self, cell: usize, system: &System) -> impl Iterator<Item = StopsAlong> {
        self.distinct[self.of_cell[cell]].stops_of(system)
    }
}

/// One cell of each distinct flow, and which of them has that of each cell.
fn told_apart<'a>(systems: &[&'a System]) -> (Vec<&'a System>, Vec<usize>) {
    // Systems that are known to share their flow need not be compared.
    let mut known: FxHashMap<*const OfFlow, usize> = FxHashMap::default();
    let mut seen: Vec<&System> = Vec::new();
    let mut of_cell: Vec<usize> = Vec::with_capacity(systems.len());
    for system in systems {
        of_cell.push(numbered(&mut known, Arc::as_ptr(system.of_flow()), system, &mut seen));
    }
    let flows: Vec<Vec<u64>> = seen.par_iter().map(|system| flow(system)).collect();
    let mut first: FxHashMap<&[u64], usize> = FxHashMap::default();
    let mut cells: Vec<&System> = Vec::new();
    let of_seen: Vec<usize> = (flows.iter().zip(&seen))
        .map(|(flow, system)| numbered(&mut first, &flow[..], system, &mut cells))
        .collect();
    of_cell.iter_mut().for_each(|cell| *cell = of_seen[*cell]);
    (cells, of_cell)
}

/// The constants of some cells.
fn computed<const N: usize>(cells: &[&System]) -> Vec<Flight<f64, N>> {
    cells.par_iter().map(|system| Flight::new(system)).collect()
}

/// The number of a key, a new one for one that is not known yet; `first` are the systems that brought them.
fn numbered<'a, K: Eq + Hash>(
    known: &mut FxHashMap<K, usize>,
    key: K,
    system: &'a System,
    first: &mut Vec<&'a System>,
) -> usize {
    *known.entry(key).or_insert_with(|| {
        first.push(system);
        first.len() - 1
    })
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
        assert_eq!(flights.distinct().len(), 2);
        let shared = Flights::<2>::of_shared(&cells);
        assert_eq!(shared.distinct().len(), 2);
        // Of cells that have nothing in common nothing is kept.
        let (alone, cells) = ([&systems[0], &systems[5]], &cells[..]);
        assert_eq!(Flights::<2>::of(&alone).distinct().len(), 2);
        let alone_shared = Flights::<2>::of_shared(&alone);
        assert!(alone_shared.distinct().is_empty());
        for (flights, cells) in [(&flights, cells), (&shared, cells), (&alone_shared, &alone)] {
            for (i, system) in cells.iter().enumerate() {
                assert_eq!(flights.get(i, system), Flight::new(system), "{system:?}");
                // The test can fail: the constants of another cell differ.
                let other = cells[(i + 1) % cells.len()];
                assert_ne!(flights.get(i, system), Flight::new(other));
                for from in 0..cells.len() {
                    let mut flight = flights.get(from, cells[from]);
                    flights.put(i, system, from, &mut flight);
                    assert_eq!(flight, flights.get(i, system), "{i} after {from}");
                }
            }
        }
    }
}
