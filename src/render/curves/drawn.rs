//! Bifurcation curves as lines in the plane's quantities, for a page that draws them itself.

use serde::Serialize;

use super::style::{self, Line};
use super::{Overlay, Piece, Shown, name};
use crate::curves::Curve;
use crate::figure::{Point, css};
use crate::plane::RegionMap;

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

/// The lines of a map's curves, as its picture has them; those of which less is shown are left out there and here.
pub fn live_lines(map: &RegionMap, curves: &[Curve], shown: Shown) -> Vec<LiveLine> {
    let overlay = Overlay::new(map, curves, shown);
    let pieces = overlay.pieces(|point| Point { x: point.x, y: point.y });
    let lines = pieces.into_iter().map(|piece| {
        let Line { colour, width, cased, dashes } = Line::of_curve(piece.curve, piece.criticality, 1.0);
        LiveLine {
            about: about(&piece),
            name: piece.name.map_or_else(|| name(piece.curve), str::to_owned),
            colour: css(colour),
            widths: [width, cased],
            dashes,
            points: piece.line.iter().map(|point| [point.x, point.y]).collect(),
        }
    });
    lines.collect()
}

fn about(piece: &Piece) -> String {
    let [kind, _] = style::names(piece.curve.kind);
    let criticality = piece.criticality.map(|criticality| format!(", {}", criticality.name()));
    let symmetric = if piece.curve.motion.symmetric { " symmetric" } else { "" };
    let name = piece.name.map(|name| format!("{name}: ")).unwrap_or_default();
    format!("{name}{kind} of {}{symmetric}{}", piece.curve.motion.label(), criticality.unwrap_or_default())
}
