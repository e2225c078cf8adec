//! How curves of each kind are drawn.

use image::Rgb;

use crate::curves::{Criticality, Curve, Kind};
use crate::figure::Colour;

/// The ground under a line, so that it is seen on any region.
pub(super) const CASING: Colour = Rgb([255; 3]);
/// The widths of a line and of the casing on either side of it, in em.
const WIDTH: f64 = 0.12;
const CASING_WIDTH: f64 = 0.06;
/// Curves of motions with more impacts at a stop in a forcing period crowd: they are thinner by this factor.
const FEW_IMPACTS: u32 = 3;
const THIN: f64 = 0.5;
/// Dashes and gaps, in line widths.
const DASHES: [f64; 2] = [3.0, 2.0];
const DOTS: [f64; 2] = [1.0, 1.0];

/// The kinds, as a legend lists them.
pub(super) const KINDS: [Kind; 5] =
    [Kind::NeimarkSacker, Kind::Pitchfork, Kind::PeriodDoubling, Kind::Fold, Kind::Grazing];

/// The colour of a kind.
pub(super) fn colour(kind: Kind) -> Colour {
    match kind {
        Kind::NeimarkSacker => Rgb([0xc8, 0x00, 0x2b]),
        Kind::Pitchfork => Rgb([0x00, 0x3d, 0xa8]),
        Kind::PeriodDoubling => Rgb([0x00, 0x74, 0x3f]),
        Kind::Fold => Rgb([0x11, 0x11, 0x11]),
        Kind::Grazing => Rgb([0x8a, 0x1c, 0x8f]),
    }
}

/// What a kind is called in a legend, and its abbreviation on the curves.
pub(super) fn names(kind: Kind) -> [&'static str; 2] {
    match kind {
        Kind::NeimarkSacker => ["Neimark–Sacker", "NS"],
        Kind::Pitchfork => ["pitchfork", "PF"],
        Kind::PeriodDoubling => ["period doubling", "PD"],
        Kind::Fold => ["fold", "F"],
        Kind::Grazing => ["grazing", "G"],
    }
}

/// Whether a curve is one of many that crowd.
pub(super) fn is_thin(curve: &Curve) -> bool {
    curve.motion.impacts.iter().any(|&impacts| impacts > FEW_IMPACTS * curve.motion.n)
}

/// A line, in pixels.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Line {
    pub colour: Colour,
    pub width: f64,
    /// What the line and its casing take together.
    pub cased: f64,
    /// Dashes and gaps; none for a line without.
    pub dashes: Vec<f64>,
}

impl Line {
    /// The line of a kind as a legend shows it.
    pub fn of(kind: Kind, em: f64) -> Self {
        Line::new(colour(kind), WIDTH * em, em, if kind == Kind::Grazing { &DOTS } else { &[] })
    }

    /// The line of a curve where it has some criticality.
    pub fn of_curve(curve: &Curve, criticality: Option<Criticality>, em: f64) -> Self {
        let plain = Line::of(curve.kind, em);
        let thin = if is_thin(curve) { THIN } else { 1.0 };
        let dashes: &[f64] = match (curve.kind, criticality) {
            (Kind::Grazing, _) => &DOTS,
            (_, Some(Criticality::Subcritical)) => &DASHES,
            _ => &[],
        };
        Line { cased: plain.cased * thin, ..Line::new(plain.colour, plain.width * thin, em, dashes) }
    }

    /// What is subcritical, of whatever kind.
    pub fn subcritical(colour: Colour, em: f64) -> Self {
        Line::new(colour, WIDTH * em, em, &DASHES)
    }

    fn new(colour: Colour, width: f64, em: f64, dashes: &[f64]) -> Self {
        let dashes = dashes.iter().map(|length| length * width).collect();
        Line { colour, width, cased: (WIDTH + 2.0 * CASING_WIDTH) * em, dashes }
    }
}
