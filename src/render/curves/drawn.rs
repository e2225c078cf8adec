//! The lines of an overlay in the plane's quantities, for a page that draws them itself.

use super::style::{self, Line};
use super::{Overlay, Piece, name};
use crate::figure::Point;

/// A line as it is drawn, in the plane's quantities.
pub(in crate::render) struct Drawn {
    /// Kind, motion and criticality in words.
    pub about: String,
    /// What stands beside it.
    pub name: String,
    /// The line, in em.
    pub style: Line,
    /// (x, y).
    pub points: Vec<[f64; 2]>,
}

impl Overlay<'_> {
    /// The lines that are drawn, with their points in the plane's quantities.
    pub(in crate::render) fn lines(&self) -> Vec<Drawn> {
        let pieces = self.pieces(|point| Point { x: point.x, y: point.y });
        let drawn = pieces.into_iter().map(|piece| Drawn {
            about: about(&piece),
            name: piece.name.map_or_else(|| name(piece.curve), str::to_owned),
            style: Line::of_curve(piece.curve, piece.criticality, 1.0),
            points: piece.line.iter().map(|point| [point.x, point.y]).collect(),
        });
        drawn.collect()
    }
}

fn about(piece: &Piece) -> String {
    let [kind, _] = style::names(piece.curve.kind);
    let criticality = piece.criticality.map(|criticality| format!(", {}", criticality.name()));
    let symmetric = if piece.curve.motion.symmetric { " symmetric" } else { "" };
    let name = piece.name.map(|name| format!("{name}: ")).unwrap_or_default();
    format!("{name}{kind} of {}{symmetric}{}", piece.curve.motion.label(), criticality.unwrap_or_default())
}
