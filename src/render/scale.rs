//! A scale: what an edge of a plot stands for, by equal differences or by equal ratios.

use super::ticks::Ticks;
use crate::plane::{Axis, Spacing};

/// An axis of so few cells has a tick at every value.
const FEW: u32 = 5;

/// A scale between two values; it may run downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    first: f64,
    last: f64,
    spacing: Spacing,
    /// The axis whose cells it shows, if it does.
    cells: Option<Axis>,
}

impl Scale {
    /// A scale of equal differences from one value to another.
    ///
    /// # Panics
    /// If the two are not different numbers.
    pub fn new(first: f64, last: f64) -> Self {
        assert!((first - last).abs() > 0.0, "a scale needs two different ends, not {first} and {last}");
        Scale { first, last, spacing: Spacing::Linear, cells: None }
    }

    /// A scale of equal ratios from one positive value to another.
    ///
    /// # Panics
    /// If the two are not different positive numbers.
    pub fn logarithmic(first: f64, last: f64) -> Self {
        assert!(first.min(last) > 0.0, "a logarithmic scale needs positive ends, not {first} and {last}");
        Scale { spacing: Spacing::Log, ..Scale::new(first, last) }
    }

    /// A scale that shows all of some values, with a margin of `margin` times their range at either end; values
    /// that are all alike get a scale about them, and no values at all one from −1 to 1.
    pub fn around(values: impl IntoIterator<Item = f64>, margin: f64) -> Self {
        let finite = values.into_iter().filter(|value| value.is_finite());
        let (low, high) = finite
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
        if low > high {
            return Scale::new(-1.0, 1.0);
        }
        let size = low.abs().max(high.abs());
        let room = match size {
            ..1e-200 => 1.0,
            _ if high - low > 1e-6 * size => margin * (high - low),
            _ => 0.05 * size,
        };
        Scale::new(low - room, high + room)
    }

    /// The values at its ends.
    pub fn ends(&self) -> [f64; 2] {
        [self.first, self.last]
    }

    /// Whether it is one of equal ratios.
    pub fn is_logarithmic(&self) -> bool {
        !self.spacing.is_linear()
    }

    /// Whether a value is on the scale.
    pub fn shows(&self, value: f64) -> bool {
        (0.0..=1.0).contains(&self.fraction(value))
    }

    /// The scale of an axis of cells: each value stands in the middle of its cell, so that the scale reaches
    /// half a cell beyond both ends. There are no ticks beyond the values: nothing was computed there.
    pub fn of(axis: &Axis) -> Self {
        let cells = Some(*axis);
        if axis.count == 1 {
            let half = if axis.first == 0.0 { 0.5 } else { 0.05 * axis.first.abs() };
            return Scale { cells, ..Scale::new(axis.first - half, axis.first + half) };
        }
        let (first, last) = (axis.at(-0.5), axis.at(f64::from(axis.count) - 0.5));
        Scale { first, last, spacing: axis.spacing, cells }
    }

    /// How far along the scale a value stands: 0 at the first end, 1 at the last.
    ///
    /// Not a finite number for a value that is not positive on a scale of equal ratios.
    pub fn fraction(&self, value: f64) -> f64 {
        self.spacing.share(self.first, self.last, value)
    }

    /// Ticks for the scale, with at most `most` labels (and never fewer than one).
    pub fn ticks(&self, most: usize) -> Ticks {
        let [first, last] = match self.cells {
            Some(axis) if axis.count <= FEW => {
                let apart = (axis.count as usize).div_ceil(most.max(1));
                return Ticks::at(axis.values().into_iter().step_by(apart));
            }
            Some(axis) => [axis.first, axis.last],
            None => [self.first, self.last],
        };
        match self.spacing {
            Spacing::Linear => Ticks::between(first.min(last), first.max(last), most),
            Spacing::Log => Ticks::logarithmic(first.min(last), first.max(last), most),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_in_the_middle_of_their_cells() {
        let scale = Scale::of(&"omega=1:3:5".parse().unwrap());
        for (i, value) in [1.0, 1.5, 2.0, 2.5, 3.0].into_iter().enumerate() {
            assert!((scale.fraction(value) - (i as f64 + 0.5) / 5.0).abs() < 1e-12);
        }
    }

    #[test]
    fn cells_of_equal_ratios_are_equally_wide() {
        for axis in ["omega=0.1:10:5:log", "omega=10:0.1:5:log", "omega=5:1:9"] {
            let axis: Axis = axis.parse().unwrap();
            let scale = Scale::of(&axis);
            let count = f64::from(axis.count);
            for (i, value) in (0..axis.count).map(|i| (f64::from(i), axis.value(i))) {
                assert!((scale.fraction(value) - (i + 0.5) / count).abs() < 1e-12, "{axis}: {value}");
            }
        }
        assert!(!Scale::logarithmic(1.0, 10.0).shows(0.0) && !Scale::logarithmic(1.0, 10.0).shows(-1.0));
    }

    #[test]
    fn ticks_stay_where_something_was_computed() {
        for axis in ["omega=0.2:5:2", "omega=5:0.2:2", "omega=0.2:5:7", "r=0:1:3", "omega=0.1:10:6:log"] {
            let axis: Axis = axis.parse().unwrap();
            let ticks = Scale::of(&axis).ticks(6);
            let (low, high) = (axis.least() - 1e-9, axis.first.max(axis.last) + 1e-9);
            assert!(ticks.labelled.len() >= 2, "{axis}");
            let values = ticks.labelled.iter().map(|(value, _)| *value).chain(ticks.minor);
            assert!(values.into_iter().all(|value| (low..=high).contains(&value)), "{axis}");
        }
        let labels = |most| Scale::of(&"omega=0.2:5:5".parse().unwrap()).ticks(most).labelled;
        assert_eq!(
            labels(8).iter().map(|(_, label)| &**label).collect::<Vec<_>>(),
            ["0.2", "1.4", "2.6", "3.8", "5"]
        );
        assert_eq!(labels(3).iter().map(|(_, label)| &**label).collect::<Vec<_>>(), ["0.2", "2.6", "5"]);
    }

    #[test]
    fn a_scale_may_run_downwards() {
        let scale = Scale::new(5.0, 0.2);
        assert_eq!((scale.fraction(5.0), scale.fraction(0.2)), (0.0, 1.0));
        assert_eq!(scale.ticks(5), Scale::new(0.2, 5.0).ticks(5));
        assert!(scale.shows(3.0) && !scale.shows(5.1));
    }

    #[test]
    fn values_have_room_around_them() {
        let scale = Scale::around([1.0, f64::NAN, 3.0], 0.05);
        assert!((scale.fraction(1.0) - 0.05 / 1.1).abs() < 1e-12);
        for values in [vec![], vec![0.0], vec![0.3, 0.3], vec![-1e-300, 1e-300]] {
            let scale = Scale::around(values.clone(), 0.05);
            assert!(values.iter().all(|&value| (scale.fraction(value) - 0.5).abs() < 1e-6), "{values:?}");
        }
    }

    #[test]
    fn a_single_value_has_a_single_tick_in_the_middle() {
        for axis in ["delta=0.1:0.1:1", "x2=0:0:1", "x2=-3:-3:1"] {
            let axis = axis.parse().unwrap();
            let scale = Scale::of(&axis);
            let ticks = scale.ticks(8);
            assert_eq!(ticks.labelled.len(), 1);
            assert!((scale.fraction(ticks.labelled[0].0) - 0.5).abs() < 1e-12);
        }
    }
}
