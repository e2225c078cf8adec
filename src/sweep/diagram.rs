//! A bifurcation diagram: independent columns in tiles on a back end, carried ones one after the other on the CPU.

use rayon::prelude::*;

use super::begun::{Begun, of_begun};
use super::{Result, provenance};
use crate::analysis::{Regime, Trace, Verdict};
use crate::backend::{Backend, Cpu, Job, Watch, trace};
use crate::diagram::{Branch, Diagram, DiagramSpec, Direction, ExponentUnit};
use crate::model::{StateVector, System};
use crate::plane::Reached as _;
use crate::theory::{Spectrum, SymmetricStarts, confirmed};

/// Computes a bifurcation diagram.
///
/// Columns that begin by themselves are computed in tiles on the back end; a branch whose state is carried along is a
/// sequence, computed on the CPU whatever the back end, both branches at the same time. The Lyapunov spectrum is
/// computed on the CPU, from where each column ended and over as many periods as its section was read.
///
/// # Errors
/// A specification or a system that cannot be used, or what the back end could not do; nothing is kept of a diagram that
/// the watch ended.
pub fn diagram(spec: &DiagramSpec, backend: &dyn Backend, watch: &dyn Watch) -> Result<Diagram> {
    spec.check()?;
    let systems: Vec<System> =
        (0..spec.x.count).map(|column| System::new(spec.parameters_at(column))).collect::<Result<_, _>>()?;
    let branches: Vec<Branch> = (spec.sweep.branches().par_iter())
        .map(|&direction| {
            let traces = match direction {
                Direction::Each => each(spec, &systems, backend, watch)?,
                Direction::Down => carried(spec, &systems, true, watch)?,
                Direction::Up => carried(spec, &systems, false, watch)?,
            };
            Ok(Branch { direction, traces, spectrum: None })
        })
        .collect::<Result<_>>()?;
    let branches = match spec.spectrum {
        Some(unit) => with_spectra(spec, unit, &systems, branches, watch)?,
        None => branches,
    };
    let provenance = if spec.sweep.is_carried() { provenance(&Cpu) } else { provenance(backend) };
    Ok(Diagram { spec: spec.clone(), provenance, branches })
}

fn each(
    spec: &DiagramSpec,
    systems: &[System],
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Trace>> {
    let mut symmetric = SymmetricStarts::default();
    let begun = (0..).zip(systems).map(|(column, system)| {
        let start = spec.start_at(column).begun_by(system, &mut symmetric);
        start.map(|start| Job { system: system.clone(), start })
    });
    traces(begun.collect(), spec, backend, watch)
}

/// What columns that begin by themselves leave on the section of a diagram; nothing of those that would begin beyond a stop.
///
/// # Errors
/// What the back end could not do.
pub fn traces(
    begun: Vec<Begun>,
    spec: &DiagramSpec,
    backend: &dyn Backend,
    watch: &dyn Watch,
) -> Result<Vec<Trace>> {
    let all = begun.len();
    let traced = |jobs: &[Job]| {
        watch.finished((all - jobs.len()) as u64);
        let mut traces = Vec::with_capacity(jobs.len());
        for tile in jobs.chunks(backend.tile().max(1)) {
            watch.check()?;
            traces.extend(backend.trace(tile, &spec.schedule, spec.probe, spec.capacity, watch)?);
        }
        confirm(&mut traces, jobs.iter().map(|job| &job.system));
        Ok(traces)
    };
    let nothing = |start| Trace {
        verdict: Verdict::inadmissible(start),
        readings: Vec::new(),
        left_out: 0,
        rebounds: 0,
    };
    of_begun(begun, traced, nothing)
}

/// Every column begins where the one before it ended; where that is beyond a stop of this column, on the stop.
fn carried(spec: &DiagramSpec, systems: &[System], falling: bool, watch: &dyn Watch) -> Result<Vec<Trace>> {
    let mut traces: Vec<Option<Trace>> = vec![None; systems.len()];
    let mut last: Option<StateVector> = None;
    for column in spec.x.order(falling) {
        watch.check()?;
        let system = systems[column as usize].clone();
        let start = match last.filter(StateVector::is_bounded) {
            Some(state) => system.between_stops(state),
            None => spec.start.state(&system),
        };
        let trace = trace::<f64>(&Job { system, start }, &spec.schedule, spec.probe, spec.capacity);
        last = Some(trace.verdict.state);
        traces[column as usize] = Some(trace);
        watch.finished(1);
    }
    let mut traces: Vec<Trace> = traces.into_iter().flatten().collect();
    confirm(&mut traces, systems.iter());
    Ok(traces)
}

/// Slow spirals and alternations are held against the exact motion.
fn confirm<'a>(traces: &mut [Trace], systems: impl Iterator<Item = &'a System>) {
    for (trace, system) in traces.iter_mut().zip(systems) {
        trace.verdict = confirmed(system, &trace.verdict).unwrap_or(trace.verdict);
    }
}

fn with_spectra(
    spec: &DiagramSpec,
    unit: ExponentUnit,
    systems: &[System],
    branches: Vec<Branch>,
    watch: &dyn Watch,
) -> Result<Vec<Branch>> {
    let spectra = |branch: Branch| {
        let spectrum = systems
            .par_iter()
            .zip(&branch.traces)
            .map(|(system, trace)| {
                watch.check()?;
                let exponents = exponents(system, trace, spec, unit);
                watch.finished(1);
                Ok(exponents)
            })
            .collect::<Result<_>>()?;
        Ok(Branch { spectrum: Some(spectrum), ..branch })
    };
    branches.into_iter().map(spectra).collect()
}

/// The 2n exponents, largest first whatever their statistical error; NaN where the trajectory could not be followed, and for the
/// last ones where the masses may drift.
fn exponents(system: &System, trace: &Trace, spec: &DiagramSpec, unit: ExponentUnit) -> Vec<f64> {
    if matches!(trace.verdict.regime, Regime::Failed | Regime::Inadmissible) {
        return vec![f64::NAN; trace.verdict.state.len()];
    }
    let start = system.between_stops(trace.verdict.state);
    let spectrum = Spectrum::of(system, &start[..], 0, spec.schedule.observe);
    let in_unit = |spectrum: Spectrum| unit.of(&spectrum, spec.probe.section);
    let mut exponents = spectrum.map_or_else(|_| vec![f64::NAN; start.len()], in_unit);
    exponents.sort_by(|a, b| b.total_cmp(a));
    exponents.resize(start.len(), f64::NAN);
    exponents
}
