//! Writing a bifurcation diagram.

use std::io::{self, Seek, Write};

use super::write::Archive;
use crate::analysis::Trace;
use crate::diagram::Diagram;

/// Writes a diagram as a NumPy archive; `numpy.load` reads it, without pickles.
/// Its arrays are in the table of [`store`](crate::store).
///
/// # Errors
/// What the file system reports.
pub fn write_diagram(diagram: &Diagram, to: impl Write + Seek) -> io::Result<()> {
    let columns = u64::from(diagram.spec.x.count);
    let shape = [diagram.branches.len() as u64, columns];
    let traces: Vec<&Trace> = diagram.branches.iter().flat_map(|branch| &branch.traces).collect();
    let mut archive = Archive::new(to);
    archive.array("x", &[columns], diagram.spec.x.values())?;
    archive.array("counts", &shape, traces.iter().map(|t| t.readings.len() as u32))?;
    let all = traces.iter().map(|t| t.readings.len() as u64).sum();
    archive.array("readings", &[all], traces.iter().flat_map(|t| t.readings.iter().copied()))?;
    archive.array("left_out", &shape, traces.iter().map(|t| t.left_out))?;
    archive.array("rebounds", &shape, traces.iter().map(|t| t.rebounds))?;
    archive.array("regime", &shape, traces.iter().map(|t| t.verdict.regime.code()))?;
    archive.array("n", &shape, traces.iter().map(|t| t.verdict.n))?;
    archive.array("p", &shape, traces.iter().map(|t| t.verdict.p()))?;
    archive.array("q", &shape, traces.iter().map(|t| t.verdict.q()))?;
    archive.array("symmetric", &shape, traces.iter().map(|t| u8::from(t.verdict.symmetric)))?;
    archive.array("lyapunov", &shape, traces.iter().map(|t| t.verdict.lyapunov))?;
    let [branches, _] = shape;
    let components = 2 * diagram.spec.parameters.family().n() as u64;
    let states = traces.iter().flat_map(|t| t.verdict.state.to_vec());
    archive.array("state", &[branches, columns, components], states)?;
    let order = diagram.spec.parameters.family().label_order();
    let counts = traces.iter().flat_map(|t| t.verdict.counts.per_stop(order));
    archive.array("impacts_per_stop", &[branches, columns, order.len() as u64], counts)?;
    let spectra: Option<Vec<&Vec<Vec<f64>>>> =
        diagram.branches.iter().map(|branch| branch.spectrum.as_ref()).collect();
    if let Some(spectra) = spectra {
        let exponents = spectra.into_iter().flatten().flatten().copied();
        archive.array("spectrum", &[branches, columns, components], exponents)?;
    }
    archive.text("config", &diagram.config())?;
    archive.finish()
}
