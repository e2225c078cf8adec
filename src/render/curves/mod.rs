//! Bifurcation curves over a plane: lines that tell kinds apart, their names, special points, and a key.

mod drawn;
mod key;
mod major;
mod regions;
mod style;

pub use self::drawn::{LiveLine, live_lines};
pub(super) use self::key::Key;

use self::major::major;
use self::style::{CASING, Line};
use crate::curves::{Criticality, Curve, CurvePoint, Kind};
use crate::figure::geometry::{about, crosses, length, overlap, within};
use crate::figure::labels::{self, Wanted};
use crate::figure::{Anchor, Canvas, Frame, INK, Point, Rect, Text, clip};
use crate::paper::{Named, named};
use crate::plane::RegionMap;
use crate::system::named;

/// The sizes of names: the paper's, other curves' and regions', in em.
const PAPER_SIZE: f64 = 1.0;
const OTHER_SIZE: f64 = 0.78;
/// No name is set smaller, in pixels.
const READABLE: f64 = 8.0;
const REGION_SIZE: f64 = 1.15;
/// A region's name is set smaller, down to this, where its region is narrow, and left out where that is not enough.
const SMALLEST_REGION_SIZE: f64 = 0.8;
/// The clearance that a region's name needs, in text sizes.
const REGION_CLEARANCE: f64 = 0.4;
/// The light around a name, in text sizes.
const HALO: f64 = 0.22;

/// Marks of special points closer together than this are one, in em.
const TOGETHER: f64 = 0.8;

/// The width of the line that leads to a name, without and with its casing, and the radius of its end, in em.
const LEADER: [f64; 2] = [0.06, 0.2];
const END_OF_LEADER: f64 = 0.13;

named! {
    /// Which parts of the curves are drawn.
    #[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
    pub enum Shown {
        /// Those of motions that fill 0.3 % of the plane, and the paper's, where the motion is stable on one side of the curve.
        Bounding = "bounding",
        /// All of every curve.
        All = "all",
    }
}

/// Curves to be drawn over a plane.
#[derive(Clone, Debug)]
pub(super) struct Overlay<'a> {
    map: &'a RegionMap,
    curves: Vec<Curve>,
    /// How many more there are, too small to be drawn.
    minor: usize,
    names: Vec<Named>,
    shown: Shown,
}

/// A part of a curve that looks the same all along, in pixels.
struct Piece<'a> {
    curve: &'a Curve,
    name: Option<&'a str>,
    criticality: Option<Criticality>,
    line: Vec<Point>,
}

impl<'a> Overlay<'a> {
    /// The curves of a map: all of them, or those of its larger motions.
    pub fn new(map: &'a RegionMap, curves: &[Curve], shown: Shown) -> Self {
        let drawn = match shown {
            Shown::Bounding => major(map, curves, &named(curves, &map.plane)),
            Shown::All => curves.to_vec(),
        };
        let minor = curves.len() - drawn.len();
        Overlay { map, minor, names: named(&drawn, &map.plane), curves: drawn, shown }
    }

    fn shows(&self, point: &CurvePoint) -> bool {
        self.shown == Shown::All || point.bounding
    }

    /// The key to what is drawn.
    pub fn key(&self) -> Key {
        let shown = |kind: Option<Kind>, wanted: &dyn Fn(&CurvePoint) -> bool| {
            let curves = self.curves.iter().filter(|curve| kind.is_none_or(|kind| curve.kind == kind));
            curves.flat_map(|curve| &curve.points).any(|point| self.shows(point) && wanted(point))
        };
        Key {
            kinds: style::KINDS.into_iter().filter(|&kind| shown(Some(kind), &|_| true)).collect(),
            subcritical: shown(None, &|point| point.criticality == Some(Criticality::Subcritical)),
            marks: shown(None, &|point| point.special.is_some()),
            curves: self.curves.iter().filter(|curve| curve.points.iter().any(|p| self.shows(p))).count(),
            minor: self.minor,
        }
    }

    /// Draws lines, marks and names over a plot; what the curves are that there was no room to name.
    pub fn draw(&self, canvas: &mut Canvas, plot: Rect, frame: &Frame, em: f64) -> Vec<String> {
        let place = |point: &CurvePoint| Point {
            x: plot.x + frame.x.fraction(point.x) * plot.width,
            y: plot.bottom() - frame.y.fraction(point.y) * plot.height,
        };
        let mut pieces: Vec<Piece> = (self.pieces(place).into_iter())
            .flat_map(|piece| {
                let parts = clip::polyline(plot, piece.line.iter().copied(), 0.0);
                parts.into_iter().map(move |line| Piece { line, ..piece })
            })
            .collect();
        // Short lines above long ones.
        pieces.sort_by(|a, b| length(&b.line).total_cmp(&length(&a.line)));
        let styled = |piece: &Piece| Line::of_curve(piece.curve, piece.criticality, em);
        for piece in &pieces {
            canvas.stroke(&piece.line, styled(piece).cased, CASING, &[]);
        }
        for piece in &pieces {
            let line = styled(piece);
            canvas.stroke(&piece.line, line.width, line.colour, &line.dashes);
        }
        let special = (self.curves.iter().flat_map(|curve| &curve.points))
            .filter(|point| point.special.is_some() && self.shows(point))
            .map(place)
            .filter(|at| (plot.x..=plot.right()).contains(&at.x) && (plot.y..=plot.bottom()).contains(&at.y));
        let marks = gathered(special, TOGETHER * em);
        for &(at, count) in &marks {
            key::draw_mark(canvas, at, count, em);
        }
        let mut taken: Vec<Rect> =
            marks.iter().map(|&(at, _)| about(at, 2.4 * key::MARK * em, 2.4 * key::MARK * em)).collect();
        let lines: Vec<&[Point]> = pieces.iter().map(|piece| &*piece.line).collect();
        self.draw_region_names(canvas, plot, em, &lines, &mut taken);
        let names = Names { plot, em, pieces: &pieces, lines: &lines };
        let named = names.draw(canvas, taken);
        let shown = self.curves.iter().filter(|curve| curve.points.iter().any(|point| self.shows(point)));
        shown.filter(|curve| !named.contains(&std::ptr::from_ref(*curve))).map(name).collect()
    }

    /// The parts to be drawn; each reaches to the beginning of the next, so that no line is broken.
    fn pieces(&self, place: impl Fn(&CurvePoint) -> Point) -> Vec<Piece<'_>> {
        let mut pieces = Vec::new();
        for stretch in &self.names {
            let curve = &self.curves[stretch.curve];
            let own = &curve.points[stretch.points.clone()];
            let mut first = stretch.points.start;
            for run in own.chunk_by(|a, b| a.criticality == b.criticality && self.shows(a) == self.shows(b)) {
                let last = first + run.len();
                if self.shows(&run[0]) {
                    let points = &curve.points[first..(last + 1).min(curve.points.len())];
                    pieces.push(Piece {
                        curve,
                        // Another curve of the same kind and motion than the paper's is called by these.
                        name: stretch.name.as_deref().filter(|name| !name.ends_with('\'')),
                        criticality: run[0].criticality,
                        line: points.iter().map(&place).collect(),
                    });
                }
                first = last;
            }
        }
        pieces
    }

    fn draw_region_names(
        &self,
        canvas: &mut Canvas,
        plot: Rect,
        em: f64,
        lines: &[&[Point]],
        taken: &mut Vec<Rect>,
    ) {
        for region in regions::region_names(self.map, &self.curves, &self.names, plot) {
            let text = Text::from(region.name);
            let size = |clearance: f64| (REGION_SIZE * em).min(clearance / REGION_CLEARANCE);
            let boxed = |place: &regions::Place| {
                let size = size(place.clearance);
                let rect = about(place.at, text.width(size) + 0.3 * size, labels::HEIGHT * size);
                (place.at, size, rect)
            };
            let candidates = || {
                let large =
                    region.places.iter().take_while(|at| size(at.clearance) >= SMALLEST_REGION_SIZE * em);
                let free = |rect| within(rect, plot) && !taken.iter().any(|&other| overlap(rect, other));
                large.map(boxed).filter(move |&(_, _, rect)| free(rect))
            };
            let off_all_lines =
                |rect| lines.iter().all(|line| line.windows(2).all(|l| !crosses(rect, l[0], l[1])));
            // A narrow region has its name over its borders.
            let found =
                candidates().find(|&(_, _, rect)| off_all_lines(rect)).or_else(|| candidates().next());
            let Some((at, size, rect)) = found else { continue };
            canvas.haloed_text(&text, at, Anchor::Middle, size, INK, (HALO * size, CASING));
            taken.push(rect);
        }
    }
}

/// A curve by kind and motion, such as "PD 1-2-2".
fn name(curve: &Curve) -> String {
    let [_, short] = style::names(curve.kind);
    format!("{short} {}", curve.motion.label())
}

/// Places in groups that reach less far than a distance from their first, with how many there are of each.
fn gathered(places: impl Iterator<Item = Point>, distance: f64) -> Vec<(Point, usize)> {
    let mut groups: Vec<(Point, usize)> = Vec::new();
    for place in places {
        let near = |(at, _): &&mut (Point, usize)| (at.x - place.x).hypot(at.y - place.y) < distance;
        match groups.iter_mut().find(near) {
            Some((_, count)) => *count += 1,
            None => groups.push((place, 1)),
        }
    }
    groups
}

/// The names of curves, to be placed among their lines.
struct Names<'a> {
    plot: Rect,
    em: f64,
    pieces: &'a [Piece<'a>],
    lines: &'a [&'a [Point]],
}

impl Names<'_> {
    /// Draws the names that there is room for: beside their curves first, then those that need a leader. Gives the
    /// curves that have one.
    fn draw(&self, canvas: &mut Canvas, mut taken: Vec<Rect>) -> Vec<*const Curve> {
        // The paper's names first, then the longest.
        let mut order: Vec<&Piece> = self.pieces.iter().collect();
        order.sort_by_key(|piece| piece.name.is_none());
        let mut said: Vec<(*const Curve, &str)> = Vec::new();
        for leader in [false, true] {
            for piece in &order {
                let curve = std::ptr::from_ref(piece.curve);
                let entry = (curve, piece.name.unwrap_or_default());
                // Every name of the paper's may have a leader, other names only where the curve has no name yet.
                let known = said.iter().any(|&(other, name)| {
                    other == curve && (name == entry.1 || leader && piece.name.is_none())
                });
                if known || leader && style::is_thin(piece.curve) {
                    continue;
                }
                if let Some(rect) = self.draw_one(canvas, piece, leader, &taken) {
                    said.push(entry);
                    taken.push(rect);
                }
            }
        }
        said.into_iter().map(|(curve, _)| curve).collect()
    }

    /// Draws the name of a piece, if there is room for it.
    fn draw_one(&self, canvas: &mut Canvas, piece: &Piece, leader: bool, taken: &[Rect]) -> Option<Rect> {
        let em = self.em;
        let (text, size) = match piece.name {
            Some(name) => (Text::from(name), PAPER_SIZE * em),
            None => (name(piece.curve).into(), (OTHER_SIZE * em).max(READABLE)),
        };
        let wanted = Wanted { line: &piece.line, width: text.width(size), size };
        let space = labels::Plot { rect: self.plot, lines: self.lines, taken };
        let place = if leader { space.led(&wanted) } else { space.beside(&wanted) }?;
        let colour = style::colour(piece.curve.kind);
        if let Some((from, to)) = place.leader {
            canvas.stroke(&[from, to], LEADER[1] * em, CASING, &[]);
            canvas.stroke(&[from, to], LEADER[0] * em, colour, &[]);
            canvas.disc(from, END_OF_LEADER * em, colour, LEADER[0] * em, CASING);
        }
        let Rect { x, y, width, height } = place.rect;
        let at = Point { x: x + width / 2.0, y: y + height / 2.0 };
        canvas.haloed_text(&text, at, Anchor::Middle, size, colour, (HALO * size, CASING));
        Some(place.rect)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_close_together_are_gathered() {
        let at = |x: f64, y: f64| Point { x, y };
        let places = [at(0.0, 0.0), at(10.0, 0.0), at(0.5, 0.5), at(10.0, 1.9), at(10.0, 3.0)];
        let expected = [(at(0.0, 0.0), 2), (at(10.0, 0.0), 2), (at(10.0, 3.0), 1)];
        assert_eq!(gathered(places.into_iter(), 2.0), expected);
    }
}
