//! The legend of what is in view, and the paint of each of its motions.

use serde::Serialize;

use super::css;
use super::words::{Word, words};
use crate::analysis::Verdict;
use crate::render::colours::SHARED;
use crate::render::paint::Paint;
use crate::render::regions::{definition_of, legend_of};
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

/// The legend and the paints of a picture whose cells are so many of each motion of a family; a motion is given by any of its verdicts.
///
/// `rows` is how many rows there is room for; what is not periodic has one of its own in any case.
pub fn live_legend(
    family: &'static Family,
    mirrored: bool,
    found: &[(Verdict, u64)],
    rows: usize,
) -> LiveLegend {
    let (entries, census) = legend_of(family, mirrored, found, rows);
    let paint = |paint: &Paint| (css(paint.fill), paint.hatch.map(css));
    let rows = entries.iter().map(|entry| LiveRow {
        paints: entry.paints.iter().map(paint).collect(),
        name: words(&entry.name),
        share: entry.value.as_ref().map(words).unwrap_or_default(),
    });
    LiveLegend {
        rows: rows.collect(),
        paints: found
            .iter()
            .map(|(verdict, _)| paint(census.region(verdict).map_or(&SHARED, |region| &region.paint)))
            .collect(),
        notes: definition_of(&census).iter().map(words).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::example;
    use crate::render::regions::census_of;

    #[test]
    fn a_live_plane_has_the_paints_and_the_shares_of_its_picture() {
        let map = example::map(40, 30);
        let census = census_of(&map);
        let mut found: Vec<(Verdict, u64)> = Vec::new();
        let mut place = vec![usize::MAX; census.regions.len()];
        for verdict in &map.verdicts {
            let of = census.region(verdict).unwrap();
            let region = census.regions.iter().position(|region| region == of).unwrap();
            let at = &mut place[region];
            if *at == usize::MAX {
                *at = found.len();
                found.push((*verdict, 0));
            }
            found[*at].1 += 1;
        }
        let live = live_legend(Family::paper(), true, &found, 24);
        for (region, &at) in census.regions.iter().zip(&place) {
            let paint = (css(region.paint.fill), region.paint.hatch.map(css));
            assert_eq!(live.paints[at], paint, "{}", region.name);
        }
        let all = map.verdicts.len() as f64;
        let share = format!("{:.1} %", 100.0 * census.regions[0].cells as f64 / all);
        assert_eq!(live.rows[0].share[0].text, share);
        // A census of other cells has other shares.
        found[place[0]].1 *= 3;
        assert_ne!(live_legend(Family::paper(), true, &found, 24).rows[0].share[0].text, share);
    }
}
