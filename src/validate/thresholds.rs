//! When two back ends count as agreeing.

use serde::Serialize;

use super::agreement::Agreement;

/// The least agreement that is accepted.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Thresholds {
    /// Least share of cells inside regions whose regime and label agree.
    pub inside: f64,
    /// Least share of all non-chaotic cells whose regime and label agree, of many: of few as much less as chance allows.
    pub non_chaotic: f64,
    /// Largest median difference of end states; non-dimensional.
    pub end_state_median: f64,
    /// Largest 95th percentile of the differences of end states; non-dimensional.
    pub end_state_p95: f64,
}

impl Default for Thresholds {
    /// What single precision gives: two independent f32 codes differ by 2e-5 (median) and 1e-4 (95th percentile).
    fn default() -> Self {
        Thresholds { inside: 0.995, non_chaotic: 0.97, end_state_median: 2e-5, end_state_p95: 1e-4 }
    }
}

/// A threshold and what it was held against.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// What was measured.
    pub name: &'static str,
    /// The value; none where there was no cell to measure, which holds: that some cells were compared is a check of its own.
    pub value: Option<f64>,
    /// The least value accepted, or the largest.
    pub bound: f64,
    /// Whether `bound` is the least value, and not the largest.
    pub at_least: bool,
    /// Whether the value is accepted.
    pub holds: bool,
}

impl Check {
    fn at_least(name: &'static str, value: Option<f64>, bound: f64) -> Self {
        Check { name, value, bound, at_least: true, holds: value.is_none_or(|value| value >= bound) }
    }

    pub(super) fn at_most(name: &'static str, value: Option<f64>, bound: f64) -> Self {
        Check { name, value, bound, at_least: false, holds: value.is_none_or(|value| value <= bound) }
    }
}

/// Standard errors of a share by which chance may lower it: a few cells that rounding decides are many of a small plane's.
const SCATTER: f64 = 2.0;

/// A least share, lowered by what chance can do where it is measured on so few cells, in five decimals.
fn of_few(least: f64, cells: u64) -> f64 {
    let lowered = least - SCATTER * (least * (1.0 - least) / cells.max(1) as f64).sqrt();
    (lowered * 1e5).floor() / 1e5
}

impl Agreement {
    /// Every threshold with what it is held against.
    pub fn checks(&self, thresholds: &Thresholds) -> Vec<Check> {
        let end_state = self.end_state;
        let inside = self.inside.without(self.tipped.inside);
        let non_chaotic = self.non_chaotic.without(self.tipped.non_chaotic);
        let failed = (self.failed.reference + self.failed.candidate) as f64;
        vec![
            Check::at_least("agreement inside regions", inside.value(), thresholds.inside),
            Check::at_least(
                "agreement of non-chaotic cells",
                non_chaotic.value(),
                of_few(thresholds.non_chaotic, non_chaotic.cells),
            ),
            Check::at_least("cells compared", Some(inside.cells.max(non_chaotic.cells) as f64), 1.0),
            Check::at_most("failed cells", Some(failed), 0.0),
            Check::at_most(
                "end state, median difference",
                end_state.map(|s| s.median),
                thresholds.end_state_median,
            ),
            Check::at_most("end state, 95th percentile", end_state.map(|s| s.p95), thresholds.end_state_p95),
        ]
    }

    /// Whether every threshold is met.
    pub fn holds(&self, thresholds: &Thresholds) -> bool {
        self.checks(thresholds).iter().all(|check| check.holds)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_cells_may_scatter_and_many_may_not() {
        let least = 0.97;
        assert!(0.95 >= of_few(least, 81) && 0.95 < of_few(least, 10_000));
        assert!(of_few(least, 120_000) > least - 0.002);
        // A plane of one cell, or of two, must agree in all.
        assert!(0.0 < of_few(least, 1) && 0.5 < of_few(least, 2));
    }
}
