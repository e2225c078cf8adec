//! How many cells of a plane each regime has, as it is printed.

use impact_atlas::analysis::Regime;
use serde::Serializer;

/// Names and cells of every regime, in the order of their codes.
pub type Census = [(&'static str, u64); Regime::ALL.len()];

/// Writes the regimes as one JSON object, in their order.
pub fn in_order<S: Serializer>(regimes: &Census, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(regimes.iter().copied())
}

/// A line for every regime that has cells, with its share of all of them.
pub fn lines(regimes: Census, all: u64) -> impl Iterator<Item = String> {
    regimes.into_iter().filter(|(_, cells)| *cells > 0).map(move |(name, cells)| {
        let share = 100.0 * cells as f64 / all as f64;
        format!("  {name:<24} {cells:>10}  {share:>6.2} %")
    })
}
