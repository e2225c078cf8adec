//! When two verdicts are the same.

use crate::analysis::Verdict;
use crate::model::Flows;
use crate::plane::{Reached, RegionMap, Task};

/// Whether regime and label are equal.
pub fn same_label(a: &Verdict, b: &Verdict) -> bool {
    (a.regime, a.n, a.counts) == (b.regime, b.n, b.counts)
}

/// Whether both are the same periodic motion by label.
pub fn same_motion(a: &Verdict, b: &Verdict) -> bool {
    a.regime.is_periodic() && same_label(a, b)
}

/// The largest difference of the strobe states in units of what is of order one; infinite where one is not a number.
pub fn state_difference(a: &[f64], b: &[f64], unit: f64) -> f64 {
    largest(a.iter().zip(b).map(|(a, b)| (a - b) / unit))
}

/// What is of order one in the cells of a map; see [`System::unit`](crate::model::System::unit).
pub struct Units<'a, T: Task> {
    map: &'a RegionMap<T>,
    flows: Flows,
}

impl<'a, T: Task> Units<'a, T> {
    /// Those of a map.
    pub fn of(map: &'a RegionMap<T>) -> Self {
        Units { map, flows: Flows::default() }
    }

    /// That of a cell.
    pub fn at(&self, index: usize) -> f64 {
        let columns = self.map.plane.x.count;
        let parameters = self.map.plane.parameters_at(index as u32 % columns, index as u32 / columns);
        self.flows.system(parameters).map_or(1.0, |system| system.unit())
    }
}

/// The largest absolute value of some differences; infinite where one is not a number.
pub fn largest(differences: impl Iterator<Item = f64>) -> f64 {
    let larger = |largest: f64, d: f64| if d.is_nan() { f64::INFINITY } else { d.abs().max(largest) };
    differences.fold(0.0, larger)
}

/// Whether every neighbour that the cell has agrees with it.
pub fn is_inside<T: Task>(map: &RegionMap<T>, index: usize) -> bool {
    let (columns, rows) = (map.plane.x.count, map.plane.y.count);
    let (column, row) = (index as u32 % columns, index as u32 / columns);
    let around = |i: u32, count: u32| i.saturating_sub(1)..=(i + 1).min(count - 1);
    let here = map.verdicts[index].verdict();
    around(row, rows).all(|r| around(column, columns).all(|c| same_label(map.at(c, r).verdict(), here)))
}
