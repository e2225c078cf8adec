//! A linear scale: what an edge of a plot stands for.

use super::ticks::Ticks;
use crate::plane::Axis;

/// A linear scale between two values; it may run downwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    first: f64,
    last: f64,
    only: Option<f64>,
}

impl Scale {
    /// A scale from one value to another.
    ///
    /// # Panics
    /// If the two are not different numbers.
    pub fn new(first: f64, last: f64) -> Self {
        assert!((first - last).abs() > 0.0, "a scale needs two different ends, not {first} and {last}");
        Scale { first, last, only: None }
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

    /// Whether a value is on the scale.
    pub fn shows(&self, value: f64) -> bool {
        (0.0..=1.0).contains(&self.fraction(value))
    }

    /// The scale of an axis of cells: each value stands in the middle of its cell, so that the scale reaches
    /// half a cell beyond both ends. A single value has no scale and gets a single tick.
    pub fn of(axis: &Axis) -> Self {
        if axis.count == 1 {
            let half = if axis.first == 0.0 { 0.5 } else { 0.05 * axis.first.abs() };
            return Scale { first: axis.first - half, last: axis.first + half, only: Some(axis.first) };
        }
        let half = 0.5 * (axis.last - axis.first) / f64::from(axis.count - 1);
        Scale::new(axis.first - half, axis.last + half)
    }

    /// How far along the scale a value stands: 0 at the first end, 1 at the last.
    pub fn fraction(&self, value: f64) -> f64 {
        (value - self.first) / (self.last - self.first)
    }

    /// Ticks for the scale, with at most `most` labels (and never fewer than one).
    pub fn ticks(&self, most: usize) -> Ticks {
        match self.only {
            Some(value) => Ticks::single(value),
            None => Ticks::between(self.first.min(self.last), self.first.max(self.last), most),
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
