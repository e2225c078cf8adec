//! A linear scale: what an edge of a plot stands for.

use super::ticks::Ticks;
use crate::plane::Axis;

/// A linear scale from one value to a greater one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    low: f64,
    high: f64,
    only: Option<f64>,
}

impl Scale {
    /// A scale between two values.
    ///
    /// # Panics
    /// If `low` is not less than `high`.
    pub fn new(low: f64, high: f64) -> Self {
        assert!(low < high, "a scale needs two different ends, not {low} and {high}");
        Scale { low, high, only: None }
    }

    /// The scale of an axis of cells: each value stands in the middle of its cell, so that the scale reaches
    /// half a cell beyond both ends. A single value has no scale and gets a single tick.
    pub fn of(axis: &Axis) -> Self {
        if axis.count == 1 {
            let half = if axis.first == 0.0 { 0.5 } else { 0.05 * axis.first.abs() };
            return Scale { low: axis.first - half, high: axis.first + half, only: Some(axis.first) };
        }
        let half = 0.5 * (axis.last - axis.first) / f64::from(axis.count - 1);
        Scale::new(axis.first - half, axis.last + half)
    }

    /// How far along the scale a value stands: 0 at the low end, 1 at the high end.
    pub fn fraction(&self, value: f64) -> f64 {
        (value - self.low) / (self.high - self.low)
    }

    /// Ticks for the scale, with at most `most` labels (and never fewer than one).
    pub fn ticks(&self, most: usize) -> Ticks {
        match self.only {
            Some(value) => Ticks::single(value),
            None => Ticks::between(self.low, self.high, most),
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
