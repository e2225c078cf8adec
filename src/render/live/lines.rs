//! Bifurcation curves as lines, for a page that draws them itself.

use serde::Serialize;

use super::css;
use crate::curves::Curve;
use crate::plane::RegionMap;
use crate::render::curves::{Overlay, Shown};

/// A part of a curve that looks the same all along.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LiveLine {
    /// What it is, in words: kind, motion, criticality, and the paper's name where it has one.
    pub about: String,
    /// What stands beside it: the paper's name, or the abbreviated kind and the motion.
    pub name: String,
    /// The colour of its kind, as style sheets write it.
    pub colour: String,
    /// The widths of the line and of the light ground under it, in em.
    pub widths: [f64; 2],
    /// Dashes and gaps in em; none for a line without.
    pub dashes: Vec<f64>,
    /// (x, y) of its points in the plane's quantities; non-dimensional.
    pub points: Vec<[f64; 2]>,
}

/// The lines of a map's curves, as its picture has them, longest first; those of which less is shown are left out there
/// and here.
pub fn live_lines(map: &RegionMap, curves: &[Curve], shown: Shown) -> Vec<LiveLine> {
    let overlay = Overlay::new(map, curves, shown);
    let lines = overlay.lines().into_iter().map(|line| LiveLine {
        about: line.about,
        name: line.name,
        colour: css(line.style.colour),
        widths: [line.style.width, line.style.cased],
        dashes: line.style.dashes,
        points: line.points,
    });
    lines.collect()
}
