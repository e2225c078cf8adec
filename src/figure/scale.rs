//! A scale: what an edge of a plot stands for, by equal differences or by equal ratios.

use super::spacing::Spacing;
use super::steps::Steps;
use super::ticks::Ticks;

/// An edge of so few cells has a tick at every value.
const FEW: u32 = 5;

/// Values that are smaller than this are as good as 0: a share of them may be no number.
const NOTHING: f64 = 1e-200;

/// A scale between two values; it may run downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    first: f64,
    last: f64,
    spacing: Spacing,
    /// The values in the middle of the cells that it shows, if it shows cells.
    cells: Option<Steps>,
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
            ..NOTHING => 1.0,
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

    /// The scale of a row of cells: each value stands in the middle of its cell, so that the scale reaches
    /// half a cell beyond both ends. There are no ticks beyond the values: nothing was computed there.
    pub fn of(values: &Steps) -> Self {
        let cells = Some(*values);
        if values.count == 1 {
            let half = if values.first.abs() < NOTHING { 0.5 } else { 0.05 * values.first.abs() };
            return Scale { cells, ..Scale::new(values.first - half, values.first + half) };
        }
        let (first, last) = (values.at(-0.5), values.at(f64::from(values.count) - 0.5));
        Scale { first, last, spacing: values.spacing, cells }
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
            Some(values) if values.count <= FEW => {
                let apart = (values.count as usize).div_ceil(most.max(1));
                return Ticks::at(values.values().into_iter().step_by(apart));
            }
            Some(values) => [values.first, values.last],
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

    fn even(first: f64, last: f64, count: u32) -> Steps {
        Steps { first, last, count, spacing: Spacing::Linear }
    }

    fn ratios(first: f64, last: f64, count: u32) -> Steps {
        Steps { spacing: Spacing::Log, ..even(first, last, count) }
    }

    #[test]
    fn one_cell_has_a_scale_whatever_its_value() {
        for value in [0.0, 5e-324, -5e-324, 1e-250, 3.0, -1e300] {
            let scale = Scale::of(&even(value, value, 1));
            assert!((scale.fraction(value) - 0.5).abs() < 1e-9, "{value:e}");
        }
    }

    #[test]
    fn values_stand_in_the_middle_of_their_cells() {
        let scale = Scale::of(&even(1.0, 3.0, 5));
        for (i, value) in [1.0, 1.5, 2.0, 2.5, 3.0].into_iter().enumerate() {
            assert!((scale.fraction(value) - (i as f64 + 0.5) / 5.0).abs() < 1e-12);
        }
    }

    #[test]
    fn cells_of_equal_ratios_are_equally_wide() {
        for steps in [ratios(0.1, 10.0, 5), ratios(10.0, 0.1, 5), even(5.0, 1.0, 9)] {
            let scale = Scale::of(&steps);
            let count = f64::from(steps.count);
            for (i, value) in (0..steps.count).map(|i| (f64::from(i), steps.value(i))) {
                assert!((scale.fraction(value) - (i + 0.5) / count).abs() < 1e-12, "{steps:?}: {value}");
            }
        }
        assert!(!Scale::logarithmic(1.0, 10.0).shows(0.0) && !Scale::logarithmic(1.0, 10.0).shows(-1.0));
    }

    #[test]
    fn ticks_stay_where_something_was_computed() {
        for steps in
            [even(0.2, 5.0, 2), even(5.0, 0.2, 2), even(0.2, 5.0, 7), even(0.0, 1.0, 3), ratios(0.1, 10.0, 6)]
        {
            let ticks = Scale::of(&steps).ticks(6);
            let (low, high) = (steps.first.min(steps.last) - 1e-9, steps.first.max(steps.last) + 1e-9);
            assert!(ticks.labelled.len() >= 2, "{steps:?}");
            let values = ticks.labelled.iter().map(|(value, _)| *value).chain(ticks.minor);
            assert!(values.into_iter().all(|value| (low..=high).contains(&value)), "{steps:?}");
        }
        let labels = |most| Scale::of(&even(0.2, 5.0, 5)).ticks(most).labelled;
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
        for value in [0.1, 0.0, -3.0] {
            let scale = Scale::of(&even(value, value, 1));
            let ticks = scale.ticks(8);
            assert_eq!(ticks.labelled.len(), 1);
            assert!((scale.fraction(ticks.labelled[0].0) - 0.5).abs() < 1e-12);
        }
    }
}
