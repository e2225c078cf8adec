//! The table of every point of every bifurcation curve: written, and read again.

use std::path::Path;
use std::str::FromStr;

use impact_atlas::curves::{Criticality, Curve, CurveMotion, CurvePoint, End, Kind};
use impact_atlas::paper::named;
use impact_atlas::plane::Plane;
use impact_atlas::store::Output;

use super::files::Batch;
use super::{Result, wrong};

/// The columns of the table of points.
pub const COLUMNS: [&str; 9] =
    ["curve", "kind", "motion", "x", "y", "criticality", "point", "symmetric", "bounding"];

/// What a point is called that is not a special one.
const ORDINARY: &str = "ordinary";

/// Adds the table to what is written, if it is asked for.
pub fn add<'a>(
    batch: &mut Batch<'a>,
    output: &'a Option<Output>,
    curves: &[Curve],
    plane: &Plane,
) -> Result<()> {
    let stretches = named(curves, plane);
    let rows = stretches.iter().flat_map(|stretch| {
        let curve = &curves[stretch.curve];
        curve.points[stretch.points.clone()].iter().map(|point| {
            (
                stretch.identifier(),
                curve.kind.name(),
                curve.motion.label(),
                point.x,
                point.y,
                point.criticality.map_or("", Criticality::name),
                point.special.map_or(ORDINARY, |special| special.name()),
                curve.motion.symmetric,
                point.bounding,
            )
        })
    });
    batch.table(output, &COLUMNS, rows)
}

/// The most that the first point of a part of a curve lies from the last of the one before it, in steps of the curve.
const CONTINUED: f64 = 3.0;

/// Reads a table of curves of a plane that [`add`] wrote.
pub fn read(path: &Path, plane: &Plane) -> Result<Vec<Curve>> {
    let name = path.display();
    let refused =
        |why: String| wrong!("`{name}` is no table of curves: {why}; give a file that `curves --out` wrote");
    let mut table = csv::Reader::from_path(path).map_err(|error| refused(error.to_string()))?;
    let headers = table.headers().map_err(|error| refused(error.to_string()))?;
    if headers.iter().ne(COLUMNS) {
        return Err(refused(format!("its columns are not {}", COLUMNS.join(", "))));
    }
    let mut curves: Vec<Curve> = Vec::new();
    let mut last = String::new();
    for (row, record) in (2..).zip(table.records()) {
        let record = record.map_err(|error| refused(error.to_string()))?;
        let wrong = |what: &str| refused(format!("line {row} has {what}"));
        let number = |i: usize| record[i].parse::<f64>().ok().filter(|value| value.is_finite());
        let is = |i: usize| {
            record[i].parse::<bool>().map_err(|_| wrong(&format!("neither true nor false in {}", COLUMNS[i])))
        };
        let known = |i: usize| wrong(&format!("`{}` in {}", &record[i], COLUMNS[i]));
        let point = CurvePoint {
            x: number(3).ok_or_else(|| wrong("no number x"))?,
            y: number(4).ok_or_else(|| wrong("no number y"))?,
            criticality: named_unless(&record[5], "").map_err(|_| known(5))?,
            bounding: is(8)?,
            special: named_unless(&record[6], ORDINARY).map_err(|_| known(6))?,
        };
        let kind = record[1].parse::<Kind>().map_err(|_| wrong("an unknown kind"))?;
        let motion = CurveMotion::labelled(&record[2], is(7)?, plane)
            .ok_or_else(|| wrong("no motion of this system"))?;
        match curves.last_mut() {
            Some(curve)
                if curve.kind == kind
                    && curve.motion == motion
                    && (record[0] == *last || goes_on(curve, &point)) =>
            {
                curve.points.push(point);
            }
            _ => curves.push(Curve {
                kind,
                motion,
                touches: None,
                points: vec![point],
                ends: [End::LeavesPlane; 2],
            }),
        }
        last = record[0].to_owned();
    }
    Ok(curves)
}

/// What a name stands for, unless it says that there is nothing.
fn named_unless<T: FromStr>(name: &str, nothing: &str) -> Result<Option<T>, T::Err> {
    if name == nothing { Ok(None) } else { name.parse().map(Some) }
}

/// Whether a point follows on the last of a curve: the paper has two names for some.
fn goes_on(curve: &Curve, point: &CurvePoint) -> bool {
    let apart = |a: &CurvePoint, b: &CurvePoint| (a.x - b.x).hypot(a.y - b.y);
    match curve.points[..] {
        [.., ref before, ref last] => apart(last, point) <= CONTINUED * apart(before, last),
        _ => false,
    }
}
