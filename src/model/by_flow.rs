//! Cells told apart by their flow: what follows from it is found once for all that have it in common.

use std::hash::Hash;
use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashMap;

use super::of_flow::OfFlow;
use super::shared::flow;
use super::system::System;

/// Which cells have their flow in common.
#[derive(Debug)]
pub struct ByFlow<'a> {
    /// One cell of each distinct flow.
    pub distinct: Vec<&'a System>,
    /// Which of those flows each cell has.
    pub of_cell: Vec<u32>,
}

impl<'a> ByFlow<'a> {
    /// Tells cells apart.
    pub fn of(systems: &[&'a System]) -> Self {
        // Systems that are known to share their flow need not be compared.
        let mut known: FxHashMap<*const OfFlow, u32> = FxHashMap::default();
        let mut seen: Vec<&System> = Vec::new();
        let mut of_cell: Vec<u32> = Vec::with_capacity(systems.len());
        for system in systems {
            of_cell.push(numbered(&mut known, Arc::as_ptr(system.of_flow()), system, &mut seen));
        }
        let flows: Vec<Vec<u64>> = seen.par_iter().map(|system| flow(system)).collect();
        let mut first: FxHashMap<&[u64], u32> = FxHashMap::default();
        let mut distinct: Vec<&System> = Vec::new();
        let of_seen: Vec<u32> = (flows.iter().zip(&seen))
            .map(|(flow, system)| numbered(&mut first, &flow[..], system, &mut distinct))
            .collect();
        of_cell.iter_mut().for_each(|cell| *cell = of_seen[*cell as usize]);
        ByFlow { distinct, of_cell }
    }

    /// The cells, those with the same flow one after the other.
    pub fn order(&self) -> Vec<u32> {
        let mut cells: Vec<u32> = (0..self.of_cell.len() as u32).collect();
        cells.par_sort_by_key(|&cell| self.of_cell[cell as usize]);
        cells
    }
}

/// The number of a key, a new one for one that is not known yet; `first` are the systems that brought them.
fn numbered<'a, K: Eq + Hash>(
    known: &mut FxHashMap<K, u32>,
    key: K,
    system: &'a System,
    first: &mut Vec<&'a System>,
) -> u32 {
    *known.entry(key).or_insert_with(|| {
        first.push(system);
        first.len() as u32 - 1
    })
}
