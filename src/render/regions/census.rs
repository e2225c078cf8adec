//! Which motions a plane shows, and how much of it each takes.

use std::cmp::Reverse;
use std::collections::HashMap;

use crate::analysis::Verdict;
use crate::plane::RegionMap;
use crate::render::colouring::Colouring;
use crate::render::colours::SHARED;
use crate::render::motion::Motion;
use crate::render::paint::Paint;
use crate::system::Family;

/// So many periodic motions have colours of their own at most, those with a smaller share of the plane only where there
/// are few.
const MOST: usize = 24;
const RARE: f64 = 0.0005;
const FEW: usize = 12;

/// All cells of one motion.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Region {
    /// What the cells have in common.
    pub motion: Motion,
    /// What the motion is called.
    pub name: String,
    /// What the region is filled with.
    pub paint: Paint,
    /// Whether nothing else on the plane looks like it.
    pub distinct: bool,
    /// How many cells there are.
    pub cells: u64,
}

/// The regions of a plane, the largest first; those that are not distinct share one paint.
#[derive(Clone, Debug)]
pub(super) struct Census {
    /// The family of the plane's system.
    pub family: &'static Family,
    /// The regions, by descending size.
    pub regions: Vec<Region>,
    /// For each cell of the plane, the region that it belongs to.
    pub region_of: Vec<u32>,
}

impl Census {
    /// Takes the census of a plane.
    pub fn of(map: &RegionMap) -> Self {
        let mirrored = map.has_mirror();
        let mut known: HashMap<Motion, u32> = HashMap::new();
        let mut regions: Vec<Region> = Vec::new();
        let mut region_of: Vec<u32> = Vec::with_capacity(map.verdicts.len());
        for verdict in &map.verdicts {
            let index = *known.entry(Motion::of(verdict)).or_insert_with(|| {
                regions.push(Region::empty(verdict, mirrored));
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
        let mut regions: Vec<Region> = order.into_iter().map(|i| regions[i].clone()).collect();
        let least = (RARE * region_of.len() as f64) as u64;
        let mut periodic = 0;
        let matters = |region: &&Region| {
            if !region.motion.regime.is_periodic() {
                return true;
            }
            periodic += 1;
            periodic <= FEW || periodic <= MOST && region.cells >= least
        };
        let colouring = Colouring::of(regions.iter().filter(matters).map(|region| region.motion));
        for region in &mut regions {
            region.paint = colouring.paint(region.motion);
            region.distinct = colouring.own(region.motion).is_some();
        }
        Census { family: map.plane.parameters.family(), regions, region_of }
    }

    /// How many rows of a legend cannot be grouped: everything that is not periodic.
    pub fn indispensable(&self) -> usize {
        self.regions.iter().filter(|region| !region.motion.regime.is_periodic()).count()
    }
}

impl Region {
    fn empty(verdict: &Verdict, mirrored: bool) -> Self {
        let motion = Motion::of(verdict);
        Region { motion, name: Motion::name(verdict, mirrored), paint: SHARED, distinct: false, cells: 0 }
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
        let paint = |distinct: bool| {
            let alike = census.regions.iter().filter(move |region| region.distinct == distinct);
            alike.map(|region| region.paint).collect::<Vec<_>>()
        };
        assert!(paint(false).iter().all(|&paint| paint == SHARED) && !paint(true).contains(&SHARED));
        assert!(census.regions.iter().all(|r| r.distinct || r.motion.regime.is_periodic()));
        let chaotic = census.regions.iter().find(|r| r.motion.regime == Regime::Chaotic).unwrap();
        let [.., (_, cells), _, _] = map.census();
        assert_eq!(chaotic.cells, cells);
    }
}
