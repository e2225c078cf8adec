//! Which motions a plane shows, and how much of it each takes.

use std::cmp::Reverse;
use std::collections::HashMap;

use rayon::prelude::*;

use super::bands::bands;
use crate::analysis::Regime;
use crate::figure::Paint;
use crate::model::vector::MOST as MOST_STOPS;
use crate::plane::Window;
use crate::plane::fields::{CellField, Cells, CellsError};
use crate::render::colouring::Colouring;
use crate::render::colours::{NOT_THERE, SHARED};
use crate::render::motion::Motion;
use crate::system::Family;

/// So many periodic motions have colours of their own at most, those with a smaller share of the plane only where there
/// are few.
const MOST: usize = 24;
const RARE: f64 = 0.0005;
const FEW: usize = 12;

/// All cells of one motion.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::render) struct Region {
    /// What the cells have in common; none of those that were not computed.
    pub motion: Option<Motion>,
    /// What the motion is called.
    pub name: String,
    /// What the region is filled with.
    pub paint: Paint,
    /// Whether nothing else on the plane looks like it.
    pub distinct: bool,
    /// How many cells there are.
    pub cells: u64,
}

impl Region {
    /// Whether its motion has a period.
    pub fn is_periodic(&self) -> bool {
        self.motion.is_some_and(|motion| motion.regime.is_periodic())
    }
}

/// The regions of a part of a plane, the largest first; those that are not distinct share one paint.
#[derive(Clone, Debug)]
pub(in crate::render) struct Census {
    /// The family of the plane's system.
    pub family: &'static Family,
    /// The regions, by descending size.
    pub regions: Vec<Region>,
    /// How many cells there are.
    pub cells: u64,
    /// The region of every motion.
    rank: HashMap<Option<Motion>, u32>,
}

impl Census {
    /// Takes the census of a window of a plane.
    ///
    /// # Errors
    /// What could not be read.
    pub fn of(cells: &dyn Cells, window: Window) -> Result<Self, CellsError> {
        let mut counted: HashMap<Option<Motion>, u64> = HashMap::new();
        for band in bands(cells, window) {
            for run in motions(cells, band)?.chunk_by(|a, b| a == b) {
                *counted.entry(run[0]).or_default() += run.len() as u64;
            }
        }
        let plane = cells.plane();
        Ok(Census::counted(plane.parameters.family(), plane.has_mirror(), counted))
    }

    /// Takes the census of so many cells of each motion; those of none were not computed.
    pub fn counted(
        family: &'static Family,
        mirrored: bool,
        counted: impl IntoIterator<Item = (Option<Motion>, u64)>,
    ) -> Self {
        let stops = family.stops().len();
        let counted: Vec<(Option<Motion>, u64)> = counted.into_iter().collect();
        let symmetric = |(motion, _): &(Option<Motion>, u64)| motion.is_some_and(|motion| motion.symmetric);
        let mirrored = mirrored || counted.iter().any(symmetric);
        let mut regions: Vec<Region> =
            counted.into_iter().map(|(motion, cells)| Region::of(motion, stops, mirrored, cells)).collect();
        regions.sort_by_key(|region| (Reverse(region.cells), region.motion));
        let all: u64 = regions.iter().map(|region| region.cells).sum();
        let least = (RARE * all as f64) as u64;
        let mut periodic = 0;
        let matters = |region: &&Region| {
            if !region.is_periodic() {
                return true;
            }
            periodic += 1;
            periodic <= FEW || periodic <= MOST && region.cells >= least
        };
        let colouring = Colouring::of(regions.iter().filter(matters).filter_map(|region| region.motion));
        for region in &mut regions {
            let Some(motion) = region.motion else { continue };
            region.paint = colouring.paint(motion);
            region.distinct = colouring.own(motion).is_some();
        }
        let rank = (0..).zip(&regions).map(|(place, region)| (region.motion, place)).collect();
        Census { family, regions, cells: all, rank }
    }

    /// The region of a motion, if it is there.
    pub fn region(&self, motion: Motion) -> Option<&Region> {
        self.rank.get(&Some(motion)).map(|&place| &self.regions[place as usize])
    }

    /// How many rows of a legend cannot be grouped: everything that is not periodic.
    pub fn indispensable(&self) -> usize {
        self.regions.iter().filter(|region| !region.is_periodic()).count()
    }

    /// The regions of the cells of a window, row by row.
    ///
    /// # Errors
    /// What could not be read.
    pub fn regions_of(&self, cells: &dyn Cells, window: Window) -> Result<Vec<u32>, CellsError> {
        // A store may have grown since.
        let region = |motion: &Option<Motion>| self.rank.get(motion).copied().unwrap_or(0);
        Ok(motions(cells, window)?.iter().map(region).collect())
    }
}

impl Region {
    fn of(motion: Option<Motion>, stops: usize, mirrored: bool, cells: u64) -> Self {
        let name = motion.map_or_else(|| "not computed".to_owned(), |motion| motion.name_of(stops, mirrored));
        let paint = if motion.is_some() { SHARED } else { NOT_THERE };
        Region { motion, name, paint, distinct: motion.is_none(), cells }
    }
}

/// The motions of the cells of a window, row by row; none of those that were not computed.
fn motions(cells: &dyn Cells, window: Window) -> Result<Vec<Option<Motion>>, CellsError> {
    let read = |name: &str| cells.read(CellField::named(name).expect("the table has the field"), window);
    let (regime, n, counts, symmetric) = (read("regime")?, read("n")?, read("counts")?, read("symmetric")?);
    let stops = cells.plane().parameters.family().stops().len();
    let motion = |i: usize| {
        let regime = u8::try_from(regime.whole(i)).ok().and_then(Regime::from_repr)?;
        if !regime.is_periodic() {
            return Some(Motion { regime, counts: [0; 1 + MOST_STOPS], symmetric: false });
        }
        let count = |k: usize| match k {
            0 => n.whole(i) as u16,
            k if k <= stops => counts.whole(stops * i + k - 1) as u16,
            _ => 0,
        };
        Some(Motion { regime, counts: std::array::from_fn(count), symmetric: symmetric.whole(i) != 0 })
    };
    Ok((0..window.cells()).into_par_iter().map(motion).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::example;

    #[test]
    fn regions_are_counted_and_sorted() {
        let map = example::map(60, 40);
        let whole = Window::whole(&map.plane);
        let census = Census::of(&map, whole).unwrap();
        assert_eq!(census.regions.iter().map(|region| region.cells).sum::<u64>(), 60 * 40);
        assert!(census.regions.windows(2).all(|pair| pair[0].cells >= pair[1].cells));
        let region_of = census.regions_of(&map, whole).unwrap();
        for (verdict, index) in map.verdicts.iter().zip(region_of) {
            assert_eq!(census.regions[index as usize].motion, Some(Motion::of(verdict)));
            assert_eq!(census.regions[index as usize].name, Motion::name(verdict, true));
        }
        let paint = |distinct: bool| {
            let alike = census.regions.iter().filter(move |region| region.distinct == distinct);
            alike.map(|region| region.paint).collect::<Vec<_>>()
        };
        assert!(paint(false).iter().all(|&paint| paint == SHARED) && !paint(true).contains(&SHARED));
        assert!(census.regions.iter().all(|r| r.distinct || r.is_periodic()));
        let chaotic = census.regions.iter().find(|r| r.motion.unwrap().regime == Regime::Chaotic).unwrap();
        let counted = map.census().into_iter().find(|(regime, _)| *regime == Regime::Chaotic);
        assert_eq!(Some((Regime::Chaotic, chaotic.cells)), counted);
    }
}
