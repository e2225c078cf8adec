//! The statistics of a comparison: shares, and quantiles of differences.

use serde::Serialize;

/// How many of some cells agree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Share {
    /// The cells that agree.
    pub agree: u64,
    /// All of the cells.
    pub cells: u64,
}

impl Share {
    /// The share that agrees, from 0 to 1; none of no cells.
    pub fn value(&self) -> Option<f64> {
        (self.cells > 0).then(|| self.agree as f64 / self.cells as f64)
    }

    /// The share without some of the cells that do not agree.
    pub fn without(self, cells: u64) -> Self {
        Share { agree: self.agree, cells: self.cells.saturating_sub(cells).max(self.agree) }
    }

    pub(super) fn count(&mut self, agrees: bool) {
        self.agree += u64::from(agrees);
        self.cells += 1;
    }
}

/// How some differences are spread; quantiles by nearest rank, a difference that is not a number is infinite.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// How many differences.
    pub cells: u64,
    /// Half of them are at most this.
    pub median: f64,
    /// 95 % of them are at most this.
    pub p95: f64,
    /// The largest of them.
    pub max: f64,
}

impl Spread {
    /// The spread of some differences; none of no differences.
    pub fn of(mut differences: Vec<f64>) -> Option<Self> {
        for difference in &mut differences {
            if difference.is_nan() {
                *difference = f64::INFINITY;
            }
        }
        differences.sort_unstable_by(f64::total_cmp);
        let rank = |share: f64| ((share * differences.len() as f64).ceil() as usize).saturating_sub(1);
        let max = *differences.last()?;
        let (median, p95) = (differences[rank(0.5)], differences[rank(0.95)]);
        Some(Spread { cells: differences.len() as u64, median, p95, max })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_by_nearest_rank() {
        let spread = Spread::of((1..=100).rev().map(f64::from).collect()).unwrap();
        assert_eq!(spread, Spread { cells: 100, median: 50.0, p95: 95.0, max: 100.0 });
        assert_eq!(Spread::of(vec![3.0]), Some(Spread { cells: 1, median: 3.0, p95: 3.0, max: 3.0 }));
        assert_eq!(Spread::of(Vec::new()), None);
    }

    #[test]
    fn what_is_not_a_number_is_the_worst() {
        let spread = Spread::of(vec![f64::NAN, 0.0, -f64::NAN]).unwrap();
        assert_eq!((spread.median, spread.max), (f64::INFINITY, f64::INFINITY));
    }
}
