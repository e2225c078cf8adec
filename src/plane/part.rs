//! A plane divided into parts that independent processes compute.

use std::cmp::Reverse;
use std::str::FromStr;

use derive_more::Display;
use thiserror::Error;

use super::some_cells::some_cells;
use super::spec::Plane;
use super::start::Start;
use super::window::{Tiling, Window};
use crate::model::System;

/// Of so many columns and rows of a tile it is looked whether their cells begin.
const ALONG: u32 = 4;

/// Part K of M.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Display)]
#[display("{number}/{of}")]
pub struct Part {
    number: u32,
    of: u32,
}

impl Part {
    /// All of it.
    pub const WHOLE: Part = Part { number: 1, of: 1 };

    /// The tiles of this part, the dearest first.
    ///
    /// All tiles are ordered by what they cost, and dealt out to and fro: parts cost about the same, and neighbours, which
    /// are alike, go to different ones. Every process deals the same.
    pub fn tiles(self, plane: &Plane, tiling: &Tiling) -> Vec<u32> {
        let mut tiles: Vec<(u64, u32)> =
            (0..tiling.count()).map(|tile| (cost(plane, tiling, tile), tile)).collect();
        tiles.sort_by_key(|&(cost, tile)| (Reverse(cost), tile));
        let own = |place: usize| {
            let (round, turn) = (place / self.of as usize, place % self.of as usize);
            let dealt_to = if round.is_multiple_of(2) { turn } else { self.of as usize - 1 - turn };
            dealt_to + 1 == self.number as usize
        };
        let dealt = tiles.into_iter().enumerate().filter(|(place, _)| own(*place));
        dealt.map(|(_, (_, tile))| tile).collect()
    }
}

/// What a tile costs, about: the steps of flight in one forcing period, over all its cells that begin.
///
/// The steps follow the fastest motion, so that a low frequency has many in a period, and impacts with them.
pub fn cost(plane: &Plane, tiling: &Tiling, tile: u32) -> u64 {
    let window = tiling.window(tile);
    let middle = (window.column + window.columns / 2, window.row + window.rows / 2);
    let steps = System::new(plane.parameters_at(middle.0, middle.1)).map_or(1, |system| system.steps());
    let [looked_at, begin] = beginning(plane, window);
    (window.cells() as u64 * u64::from(steps) * begin).div_ceil(looked_at).max(1)
}

/// Of how many cells of a window it is looked whether they begin between the stops, and how many of these do.
fn beginning(plane: &Plane, window: Window) -> [u64; 2] {
    if !matches!(plane.start_at(window.column, window.row), Start::State(_)) {
        return [1, 1];
    }
    let columns = window.column..window.column + window.columns;
    let rows = window.row..window.row + window.rows;
    let looked_at: Vec<(u32, u32)> = some_cells(columns, rows, ALONG).collect();
    let begins = |&(column, row): &(u32, u32)| {
        let plant = plane.parameters_at(column, row).plant();
        plant.is_ok_and(|plant| plane.start_at(column, row).begins(&plant))
    };
    [looked_at.len() as u64, looked_at.iter().filter(|cell| begins(cell)).count() as u64]
}

impl FromStr for Part {
    type Err = PartError;

    fn from_str(text: &str) -> Result<Self, PartError> {
        let wrong = || PartError(text.to_owned());
        let (number, of) = text.split_once('/').ok_or_else(wrong)?;
        let (number, of) = (number.parse().map_err(|_| wrong())?, of.parse().map_err(|_| wrong())?);
        if number == 0 || number > of { Err(wrong()) } else { Ok(Part { number, of }) }
    }
}

/// A text that is not a part.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is no part: write K/M, the K-th of M parts, with K from 1 to M, for example 17/64")]
pub struct PartError(pub String);

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Schedule;
    use crate::plane::Start;

    fn plane() -> Plane {
        let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
        Plane::of_paper("omega=0.1:5:400", "delta=0.02:0.8:300", Start::Rest, schedule).unwrap()
    }

    #[test]
    fn parts_hold_every_tile_once() {
        let (plane, tiling) = (plane(), Tiling::of(&plane(), 16));
        for of in [1, 2, 7, 64, 1000] {
            let mut held: Vec<u32> =
                (1..=of).flat_map(|number| Part { number, of }.tiles(&plane, &tiling)).collect();
            held.sort_unstable();
            assert!(held.into_iter().eq(0..tiling.count()), "{of} parts");
        }
    }

    #[test]
    fn parts_cost_about_the_same() {
        let (plane, tiling) = (plane(), Tiling::of(&plane(), 16));
        let all = |tiles: Vec<u32>| tiles.into_iter().map(|tile| cost(&plane, &tiling, tile)).sum::<u64>();
        let ratio =
            |costs: Vec<u64>| *costs.iter().max().unwrap() as f64 / *costs.iter().min().unwrap() as f64;
        let dealt = (1..=16).map(|number| all(Part { number, of: 16 }.tiles(&plane, &tiling))).collect();
        // One part after the other along the frequency, as a simple split would have it.
        let [across, down] = tiling.shape();
        let block = |k: u32| {
            (0..down)
                .flat_map(move |row| (0..across).map(move |column| row * across + column))
                .filter(move |tile| (tile % across) * 5 / across == k)
        };
        let simple = (0..5).map(|k| all(block(k).collect())).collect();
        let (dealt, simple) = (ratio(dealt), ratio(simple));
        assert!(dealt < 1.1 && simple > 3.0, "{dealt} and {simple}");
    }

    /// Tiles of which nothing begins are dealt out last, and cost next to nothing.
    #[test]
    fn what_does_not_begin_costs_nothing() {
        let schedule = Schedule { transient: 4, observe: 2, max_period: 1, fixed_periods: false };
        let plane = Plane::of_paper("x1=-0.4:0.4:128", "v1=-1:1:128", Start::Rest, schedule).unwrap();
        let tiling = Tiling::of(&plane, 16);
        let of_tile = |tile| cost(&plane, &tiling, tile);
        let costs: Vec<u64> = (0..8).map(of_tile).collect();
        assert!(costs[..3].iter().chain(&costs[5..]).all(|&cost| cost == 1), "{costs:?}");
        assert!(costs[3..5].iter().all(|&cost| cost > 1000), "{costs:?}");
        let dealt =
            |number| Part { number, of: 2 }.tiles(&plane, &tiling).into_iter().map(of_tile).sum::<u64>();
        assert!(dealt(1).abs_diff(dealt(2)) < 100, "{} and {}", dealt(1), dealt(2));
    }

    #[test]
    fn parts_are_read_and_bad_ones_are_named() {
        for text in ["1/1", "17/64", "64/64"] {
            assert_eq!(text.parse::<Part>().unwrap().to_string(), text);
        }
        for text in ["0/0", "0/4", "65/64", "1", "1/", "/4", "a/b", "1/4/2", "-1/4", ""] {
            assert_eq!(text.parse::<Part>(), Err(PartError(text.to_owned())));
        }
    }
}
