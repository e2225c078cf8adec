//! Writing a bifurcation diagram.

use std::io::{self, Seek, Write};

use super::write::Archive;
use crate::analysis::Trace;
use crate::diagram::Diagram;

/// Writes a diagram as a NumPy archive; `numpy.load` reads it, without pickles.
///
/// | array | type | shape | meaning |
/// |---|---|---|---|
/// | `x` | f64 | x | the values of the axis, as written |
/// | `counts` | u32 | branch, x | readings kept of each column |
/// | `readings` | f64 | all | the readings, column after column, branch after branch |
/// | `left_out` | u32 | branch, x | readings that were seen and not kept |
/// | `rebounds` | u32 | branch, x | the longest row of impacts at one stop, each slower than the one before |
/// | `regime`, `n`, `p`, `q`, `symmetric`, `lyapunov` | as in a map | branch, x | what the column settled on |
/// | `state` | f64 | branch, x, 4 | (x1, x2, v1, v2) at the end, at forcing phase 0 |
/// | `spectrum` | f64 | branch, x, 4 | the Lyapunov exponents in the unit of `config`, if they were asked for |
/// | `config` | text | (none) | everything needed to compute the diagram again; the branches are in its order |
///
/// # Errors
/// What the file system reports.
pub fn write_diagram(diagram: &Diagram, to: impl Write + Seek) -> io::Result<()> {
    let columns = u64::from(diagram.spec.x.count());
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
    archive.array("p", &shape, traces.iter().map(|t| t.verdict.p))?;
    archive.array("q", &shape, traces.iter().map(|t| t.verdict.q))?;
    archive.array("symmetric", &shape, traces.iter().map(|t| u8::from(t.verdict.symmetric)))?;
    archive.array("lyapunov", &shape, traces.iter().map(|t| t.verdict.lyapunov))?;
    let [branches, _] = shape;
    archive.array("state", &[branches, columns, 4], traces.iter().flat_map(|t| t.verdict.state))?;
    let spectra: Option<Vec<&Vec<[f64; 4]>>> =
        diagram.branches.iter().map(|branch| branch.spectrum.as_ref()).collect();
    if let Some(spectra) = spectra {
        let exponents = spectra.into_iter().flatten().flatten().copied();
        archive.array("spectrum", &[branches, columns, 4], exponents)?;
    }
    archive.text("config", &diagram.config())?;
    archive.finish()
}
