//! A control run as a NumPy archive.

use std::io::{self, Seek, Write};

use super::write::Archive;
use crate::control::History;
use crate::plane::fields::{CellField, CellResult, Extras};
use crate::plane::{Control, RegionMap};

/// The fields of a cell that a map under control has too.
const CONTROLLED: [&str; 11] = [
    "regime",
    "n",
    "p",
    "q",
    "counts",
    "symmetric",
    "lyapunov",
    "state",
    "impacts",
    "peak_impact_velocity",
    "periods",
];

/// Writes a control run as a NumPy archive; its arrays are in the table of [`store`](crate::store).
///
/// # Errors
/// What the file system reports.
pub fn write_control(history: &History, config: &str, to: impl Write + Seek) -> io::Result<()> {
    let mut archive = Archive::new(to);
    let returns = &history.returns;
    let count = returns.len() as u64;
    archive.array("iterate", &[count], returns.iter().map(|met| met.iterate))?;
    let components = returns.first().map_or(4, |met| met.section.len()) as u64;
    archive.array("section", &[count, components], returns.iter().flat_map(|met| met.section.to_vec()))?;
    archive.array("arrived", &[count, components], returns.iter().flat_map(|met| met.arrived.to_vec()))?;
    archive.array("signal", &[count], returns.iter().map(|met| met.signal))?;
    archive.array("escaped", &[count], returns.iter().map(|met| u8::from(met.escaped)))?;
    let samples = &history.recording.samples;
    let rows = samples.iter().flat_map(|s| std::iter::once(s.time).chain(s.state.to_vec()));
    let width = 1 + samples.first().map_or(components, |sample| sample.state.len() as u64);
    archive.array("trajectory", &[samples.len() as u64, width], rows)?;
    archive.text("config", config)?;
    archive.finish()
}

/// Writes a plane under control as a NumPy archive; its arrays are in the table of [`store`](crate::store).
///
/// # Errors
/// What the file system reports.
pub fn write_control_map(map: &RegionMap<Control>, to: impl Write + Seek) -> io::Result<()> {
    let RegionMap { plane, verdicts: outcomes, .. } = map;
    let mut archive = Archive::new(to);
    let cells = [u64::from(plane.y.count), u64::from(plane.x.count)];
    let results = (0..outcomes.len()).map(|i| CellResult::of(i, outcomes, None, None));
    let of_cells = CellField::of_plane(Extras::NONE).filter(|field| CONTROLLED.contains(&field.name));
    archive.cells(plane, of_cells, results)?;
    let outcomes = || outcomes.iter();
    archive.array("period", &cells, outcomes().map(|o| o.period))?;
    archive.array("iterates", &cells, outcomes().map(|o| o.iterates))?;
    archive.array("converged_at", &cells, outcomes().map(|o| o.converged_at))?;
    archive.array("escapes", &cells, outcomes().map(|o| o.escapes))?;
    archive.array("effort", &cells, outcomes().map(|o| o.effort))?;
    archive.array("signal", &cells, outcomes().map(|o| o.signal))?;
    archive.array("runaway", &cells, outcomes().map(|o| u8::from(o.runaway)))?;
    archive.array("x", &[plane.x.count.into()], plane.x.values())?;
    archive.array("y", &[plane.y.count.into()], plane.y.values())?;
    archive.text("config", &map.config())?;
    archive.finish()
}
