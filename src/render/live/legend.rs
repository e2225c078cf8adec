//! The legend of what is in view, and the paint of each of its motions.

use serde::Serialize;

use super::words::{Word, words};
use crate::figure::{Paint, css};
use crate::render::colours::paint_of;
use crate::render::motion::Motion;
use crate::render::regions::{Census, definition, entries_of};
use crate::system::Family;

/// A row of the legend.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveRow {
    /// Ground and hatch of the samples, as style sheets write colours; no hatch where there is none.
    pub paints: Vec<(String, Option<String>)>,
    /// What it stands for.
    pub name: Vec<Word>,
    /// Its share of what is in view.
    pub share: Vec<Word>,
}

/// The legend of what is in view.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveLegend {
    /// The rows, in order.
    pub rows: Vec<LiveRow>,
    /// Ground and hatch of each motion that was given, in that order.
    pub paints: Vec<(String, Option<String>)>,
    /// What labels mean.
    pub notes: Vec<Vec<Word>>,
}

/// The legend and the paints of a picture whose cells are so many of each motion of a family.
///
/// `rows` is how many rows there is room for; what is not periodic has one of its own in any case.
pub fn live_legend(
    family: &'static Family,
    mirrored: bool,
    found: &[(Motion, u64)],
    rows: usize,
) -> LiveLegend {
    let census =
        Census::counted(family, mirrored, found.iter().map(|(motion, cells)| (Some(*motion), *cells)));
    let paint = |paint: &Paint| (css(paint.fill), paint.hatch.map(css));
    let rows = entries_of(&census, rows).into_iter().map(|entry| LiveRow {
        paints: entry.paints.iter().map(paint).collect(),
        name: words(&entry.name),
        share: entry.value.as_ref().map(words).unwrap_or_default(),
    });
    let own =
        |motion: &Motion| census.region(*motion).map_or_else(|| paint_of(*motion), |region| region.paint);
    LiveLegend {
        rows: rows.collect(),
        paints: found.iter().map(|(motion, _)| paint(&own(motion))).collect(),
        notes: definition(&census, false).iter().map(words).collect(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::plane::Window;
    use crate::render::example;

    #[test]
    fn a_live_plane_has_the_paints_and_the_shares_of_its_picture() {
        let map = example::map(40, 30);
        let census = Census::of(&map, Window::whole(&map.plane)).unwrap();
        let mut counts: BTreeMap<Motion, u64> = BTreeMap::new();
        for verdict in &map.verdicts {
            *counts.entry(Motion::of(verdict)).or_default() += 1;
        }
        let mut found: Vec<(Motion, u64)> = counts.into_iter().collect();
        let live = live_legend(Family::paper(), true, &found, 24);
        for ((motion, _), paint) in found.iter().zip(&live.paints) {
            let region = census.region(*motion).unwrap();
            assert_eq!(*paint, (css(region.paint.fill), region.paint.hatch.map(css)), "{}", region.name);
        }
        let share = format!("{:.1} %", 100.0 * census.regions[0].cells as f64 / map.verdicts.len() as f64);
        assert_eq!(live.rows[0].share[0].text, share);
        // A census of other cells has other shares.
        let first = found.iter_mut().find(|(motion, _)| Some(*motion) == census.regions[0].motion).unwrap();
        first.1 *= 3;
        assert_ne!(live_legend(Family::paper(), true, &found, 24).rows[0].share[0].text, share);
    }
}
