//! Which motions a map shows, and where: their connected regions, a motion and its mirror image together.

use std::collections::HashMap;

use super::curve::CurveMotion;
use crate::analysis::{Regime, Verdict};
use crate::plane::{Adjacency, Cell, RegionMap, connected};
use crate::theory::StopSet;

/// A periodic motion that a map shows, with all of its cells.
#[derive(Clone, Debug)]
pub(super) struct Shown {
    /// Its name: of the motion and its mirror image that of which there are more cells.
    pub motion: CurveMotion,
    /// Whether it rests on a stop.
    pub sticks: bool,
    /// Its connected regions, the largest first; cells that meet at a corner are connected.
    pub regions: Vec<Vec<Cell>>,
}

impl Shown {
    /// How many cells show it.
    pub fn cells(&self) -> usize {
        self.regions.iter().map(Vec::len).sum()
    }
}

/// The periodic motions of a map, among the stops of its plane, in the order of their first cells.
pub(super) fn shown(map: &RegionMap, stops: &StopSet) -> Vec<Shown> {
    let keys: Vec<Option<Key>> = map.verdicts.iter().map(|verdict| key(verdict, stops)).collect();
    let mut found: Vec<(Key, Vec<Vec<Cell>>)> = Vec::new();
    let mut index: HashMap<Key, usize> = HashMap::new();
    for region in connected(&keys, map.plane.x.count, map.plane.y.count, Adjacency::Corners) {
        let (column, row) = region[0];
        let Some(key) = &keys[(row * map.plane.x.count + column) as usize] else { continue };
        let at = *index.entry(key.clone()).or_insert_with(|| {
            found.push((key.clone(), Vec::new()));
            found.len() - 1
        });
        found[at].1.push(region);
    }
    let named = |((key, sticks), mut regions): (Key, Vec<Vec<Cell>>)| {
        regions.sort_by_key(|region| std::cmp::Reverse(region.len()));
        let is_upright = |cell: &&Cell| {
            let counts = map.at(cell.0, cell.1).counts;
            counts.iter().map(|&count| u32::from(count)).eq(key.impacts.iter().copied())
        };
        let upright = regions.iter().flatten().filter(is_upright).count();
        let all: usize = regions.iter().map(Vec::len).sum();
        let motion = if 2 * upright >= all { key } else { key.mirror_image() };
        Shown { motion, sticks, regions }
    };
    found.into_iter().map(named).collect()
}

/// What a motion and its mirror image have in common: the leading one of the two, and whether it sticks.
type Key = (CurveMotion, bool);

/// The key of a cell's motion; none where it shows no periodic one.
fn key(verdict: &Verdict, stops: &StopSet) -> Option<Key> {
    let sticks = verdict.regime == Regime::PeriodicSticking;
    verdict.regime.is_periodic().then(|| (CurveMotion::shown(verdict, stops).leading(), sticks))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::model::System;
    use crate::plane::{Plane, Provenance, Start};

    /// A map of one letter a cell, the last line first: u and d are mirror images, s another motion, dots chaos.
    fn map(lines: &[&str]) -> RegionMap {
        let schedule = Schedule { transient: 1, observe: 1, max_period: 8, fixed_periods: false };
        let (x, y) = (format!("omega=1:2:{}", lines[0].len()), format!("delta=0.1:0.5:{}", lines.len()));
        let plane = Plane::of_paper(&x, &y, Start::Symmetric, schedule).unwrap();
        let verdict = |letter: char| {
            let (regime, counts) = match letter {
                'u' => (Regime::Periodic, [1, 2, 1]),
                'd' => (Regime::Periodic, [1, 1, 2]),
                's' => (Regime::Periodic, [1, 1, 1]),
                _ => (Regime::Chaotic, [0; 3]),
            };
            Verdict::of_motion(regime, counts, letter == 's')
        };
        let verdicts = lines.iter().rev().flat_map(|line| line.chars()).map(verdict).collect();
        RegionMap::new(plane, Provenance::default(), verdicts)
    }

    fn sizes(lines: &[&str]) -> Vec<(String, Vec<usize>)> {
        let map = map(lines);
        let stops = StopSet::of(&System::new(map.plane.parameters).unwrap());
        let shown = shown(&map, &stops);
        shown.iter().map(|s| (s.motion.label(), s.regions.iter().map(Vec::len).collect())).collect()
    }

    #[test]
    fn corners_connect_and_mirror_images_are_one_motion() {
        let found = sizes(&["..d.s", ".u..s", "d..ud", "....."]);
        assert_eq!(found, [("1-1-2".to_owned(), vec![3, 2]), ("1-1-1".to_owned(), vec![2])]);
        let named = |lines: &[&str]| sizes(lines).remove(0).0;
        assert_eq!((named(&["ud", "u."]), named(&["ud", "d."])), ("1-2-1".to_owned(), "1-1-2".to_owned()));
        assert_eq!(sizes(&["u.u", "..."])[0].1, [1, 1], "cells with one between them are apart");
    }
}
