//! The ticks and the title of one side of a live plane.

use serde::Serialize;

use super::words::{Word, words};
use crate::figure::{Scale, Spacing, TITLE, fitting_ticks, widest};
use crate::plane::{Plane, Quantity};
use crate::render::regions;
use crate::render::symbols;

/// One side of a live plane.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveAxis {
    /// Labelled ticks: the value and its label.
    pub labelled: Vec<(f64, String)>,
    /// Short ticks.
    pub minor: Vec<f64>,
    /// The title, as full as there is room for, in the unit that the labels leave out.
    pub title: Vec<Word>,
}

/// Ticks and title of a side that shows `first` to `last` of a quantity along `length` pixels, in letters of `em` pixels;
/// `across` where it is the lower side, whose labels stand beside each other.
///
/// As many ticks as in a picture of that size. The two ends must differ, and be positive on a scale of equal ratios.
pub fn live_axis(
    quantity: Quantity,
    [first, last]: [f64; 2],
    spacing: Spacing,
    length: f64,
    em: f64,
    across: bool,
) -> LiveAxis {
    let scale = match spacing {
        Spacing::Linear => Scale::new(first, last),
        Spacing::Log => Scale::logarithmic(first, last),
    };
    let ticks =
        fitting_ticks(scale, length, |ticks| if across { widest(ticks, em) + 1.2 * em } else { 2.0 * em });
    let title = symbols::axis_title(quantity).fitting(ticks.exponent, TITLE * em, length);
    LiveAxis {
        labelled: ticks.labelled.into_iter().filter(|(value, _)| scale.shows(*value)).collect(),
        minor: ticks.minor.into_iter().filter(|&value| scale.shows(value)).collect(),
        title: title.map(|title| words(&title)).unwrap_or_default(),
    }
}

/// The title of a plane's picture, in pieces that belong together.
pub fn live_title(plane: &Plane) -> Vec<Vec<Word>> {
    regions::title(plane).iter().map(words).collect()
}
