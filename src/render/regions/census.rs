//! Which motions a plane shows, and how much of it each takes.

use std::cmp::Reverse;
use std::collections::HashMap;

use crate::analysis::Verdict;
use crate::plane::RegionMap;
use crate::render::colours::paint_of;
use crate::render::motion::Motion;
use crate::render::paint::Paint;

/// All cells of one motion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Region {
    /// What the cells have in common.
    pub motion: Motion,
    /// What the motion is called.
    pub name: String,
    /// What the region is filled with.
    pub paint: Paint,
    /// How many cells there are.
    pub cells: u64,
}

/// The regions of a plane, the largest first.
#[derive(Clone, Debug)]
pub(super) struct Census {
    /// The regions, by descending size.
    pub regions: Vec<Region>,
    /// For each cell of the plane, the region that it belongs to.
    pub region_of: Vec<u32>,
}

impl Census {
    /// Takes the census of a plane.
    pub fn of(map: &RegionMap) -> Self {
        let mut known: HashMap<Motion, u32> = HashMap::new();
        let mut regions: Vec<Region> = Vec::new();
        let mut region_of: Vec<u32> = Vec::with_capacity(map.verdicts.len());
        for verdict in &map.verdicts {
            let index = *known.entry(Motion::of(verdict)).or_insert_with(|| {
                regions.push(Region::empty(verdict));
                regions.len() as u32 - 1
            });
            regions[index as usize].cells += 1;
            region_of.push(index);
        }
        let mut order: Vec<usize> = (0..regions.len()).collect();
        order.sort_by_key(|&i| (Reverse(regions[i].cells), regions[i].motion));
        let mut rank = vec![0; order.len()];
        for (place, &i) in order.iter().enumerate() {
            rank[i] = place as u32;
        }
        for index in &mut region_of {
            *index = rank[*index as usize];
        }
        let regions = order.into_iter().map(|i| regions[i].clone()).collect();
        Census { regions, region_of }
    }

    /// How many rows of a legend cannot be grouped: everything that is not periodic.
    pub fn indispensable(&self) -> usize {
        self.regions.iter().filter(|region| !region.motion.regime.is_periodic()).count()
    }
}

impl Region {
    fn empty(verdict: &Verdict) -> Self {
        let motion = Motion::of(verdict);
        Region { motion, name: Motion::name(verdict), paint: paint_of(motion), cells: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Regime;
    use crate::render::example;

    #[test]
    fn regions_are_counted_and_sorted() {
        let map = example::map(60, 40);
        let census = Census::of(&map);
        assert_eq!(census.regions.iter().map(|region| region.cells).sum::<u64>(), 60 * 40);
        assert!(census.regions.windows(2).all(|pair| pair[0].cells >= pair[1].cells));
        for (verdict, &index) in map.verdicts.iter().zip(&census.region_of) {
            assert_eq!(census.regions[index as usize].motion, Motion::of(verdict));
        }
        let chaotic = census.regions.iter().find(|r| r.motion.regime == Regime::Chaotic).unwrap();
        let [.., (_, cells), _, _] = map.census();
        assert_eq!(chaotic.cells, cells);
    }
}
