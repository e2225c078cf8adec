//! Cells told apart by their flow: what follows from it is found once for all that have it in common.

use std::hash::Hash;
use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::shared::flow;
use super::system::System;

/// As many cells as are worth a thread's turn.
const LEAST: usize = 1 << 12;

/// Which cells have their flow in common.
#[derive(Debug)]
pub struct ByFlow<'a> {
    /// One cell of each distinct flow.
    pub distinct: Vec<&'a System>,
    /// Which of those flows each cell has.
    pub of_cell: Vec<u32>,
}

impl<'a> ByFlow<'a> {
    /// Tells the cells of some jobs apart.
    pub fn of<J: Sync>(jobs: &'a [J], system: impl Fn(&'a J) -> &'a System + Sync) -> Self {
        ByFlow::known(jobs, system).compared()
    }

    /// The same as far as it is known beforehand: flows that are made anew for a cell count as its own, whatever they are.
    pub fn known<J: Sync>(jobs: &'a [J], system: impl Fn(&'a J) -> &'a System + Sync) -> Self {
        // Part by part first, as many as there are threads.
        let keyed = |system: &'a System| (Arc::as_ptr(system.of_flow()).addr(), system);
        let length = jobs.len().div_ceil(rayon::current_num_threads()).max(LEAST);
        let parts = jobs.par_chunks(length).map(|jobs| Told::apart(jobs.iter().map(&system).map(keyed)));
        let parts: Vec<Told<'a>> = parts.collect();
        let seen = Told::apart(parts.iter().flat_map(|part| &part.first).copied().map(keyed));
        let (mut of_cell, mut rest) = (vec![0; jobs.len()], &seen.numbers[..]);
        let numbers_of_parts =
            parts.iter().map(|part| rest.split_off(..part.first.len()).expect("a number for each"));
        let numbers_of_parts: Vec<&[u32]> = numbers_of_parts.collect();
        of_cell.par_chunks_mut(length).zip(&parts).zip(numbers_of_parts).for_each(
            |((of_cell, part), numbers)| {
                for (cell, &number) in of_cell.iter_mut().zip(&part.numbers) {
                    *cell = numbers[number as usize];
                }
            },
        );
        ByFlow { distinct: seen.first, of_cell }
    }

    /// The same with flows counted as one that are the same, though that was not known.
    #[must_use]
    pub fn compared(mut self) -> Self {
        let flows: Vec<Vec<u64>> = self.distinct.par_iter().map(|system| flow(system)).collect();
        let flows = Told::apart(flows.iter().zip(self.distinct.iter().copied()));
        if flows.first.len() < self.distinct.len() {
            let each = self.of_cell.par_iter_mut().with_min_len(LEAST);
            each.for_each(|cell| *cell = flows.numbers[*cell as usize]);
            self.distinct = flows.first;
        }
        self
    }

    /// The cells, those with the same flow one after the other.
    pub fn order(&self) -> Vec<u32> {
        // Where the next cell of each flow comes.
        let mut places = vec![0; self.distinct.len() + 1];
        self.of_cell.iter().for_each(|&flow| places[flow as usize + 1] += 1);
        (1..places.len()).for_each(|flow| places[flow] += places[flow - 1]);
        let mut order = vec![0; self.of_cell.len()];
        for (cell, &flow) in (0..).zip(&self.of_cell) {
            let place = &mut places[flow as usize];
            order[*place] = cell;
            *place += 1;
        }
        order
    }
}

/// Systems that are told apart by a key.
struct Told<'a> {
    /// The first system with each key.
    first: Vec<&'a System>,
    /// The number of each system's key.
    numbers: Vec<u32>,
}

impl<'a> Told<'a> {
    fn apart<K: Copy + Eq + Hash>(systems: impl Iterator<Item = (K, &'a System)>) -> Self {
        let mut told = Told { first: Vec::new(), numbers: Vec::with_capacity(systems.size_hint().0) };
        let mut known: FxHashMap<K, u32> = FxHashMap::default();
        let mut last = None;
        for (key, system) in systems {
            let number = match last {
                Some((last, number)) if last == key => number,
                _ => *known.entry(key).or_insert_with(|| {
                    told.first.push(system);
                    told.first.len() as u32 - 1
                }),
            };
            told.numbers.push(number);
            last = Some((key, number));
        }
        told
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    #[test]
    fn cells_are_numbered_by_their_flow_in_parts_as_in_one() {
        let of = |omega: f64, delta: f64| {
            System::new(Parameters { omega, delta, ..Parameters::default() }).unwrap()
        };
        // Every flow twice, which is not known beforehand; one of them comes in the last part alone.
        let known: Vec<System> = (0..8).map(|i| of(1.0 + 0.1 * f64::from(i % 4), 0.2)).collect();
        let late = of(2.0, 0.3);
        let count = 3 * LEAST + 5;
        let expected = |cell: usize| if cell == count - 2 { 4 } else { (cell * 5 / 3 % 8 % 4) as u32 };
        let system = |cell: usize| if cell == count - 2 { &late } else { &known[cell * 5 / 3 % 8] };
        let cells: Vec<&System> = (0..count).map(system).collect();
        let first = |flow: u32| (0..count).find(|&cell| expected(cell) == flow).unwrap();
        let mut by_first: Vec<u32> = (0..5).collect();
        by_first.sort_by_key(|&flow| first(flow));
        for threads in [1, 2, 4] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let (found, order) = pool.install(|| {
                let found = ByFlow::of(&cells, |system| *system);
                let order = found.order();
                (found, order)
            });
            let place =
                |cell: usize| by_first.iter().position(|&flow| flow == expected(cell)).unwrap() as u32;
            assert!(found.of_cell.iter().copied().eq((0..count).map(place)), "{threads} threads");
            let distinct = by_first.iter().map(|&flow| cells[first(flow)]);
            assert!(found.distinct.iter().copied().zip(distinct).all(|(a, b)| std::ptr::eq(a, b)));
            let mut sorted: Vec<u32> = (0..count as u32).collect();
            sorted.sort_by_key(|&cell| place(cell as usize));
            assert_eq!(order, sorted, "{threads} threads");
        }
    }
}
