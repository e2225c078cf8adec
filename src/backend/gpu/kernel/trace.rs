//! The kernel `trace`: trajectories to their verdicts and what was read on a section.

use super::Kernel;
use super::device::empty;
use super::drive::{MOVE, SQUARES};
use super::program::{Portion, Program, ROW};
use super::room::Batch;
use crate::analysis;
use crate::backend::gpu::layout::{Schedule, Trace, TraceDispatch, Verdict};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{Job, Result, Watch};

/// Loop iterations in one move.
pub(super) const ITERATIONS: u32 = MOVE + SQUARES;

/// Bytes of what is read of a trajectory, at most `capacity` passages.
pub fn readings(capacity: u32) -> u64 {
    size_of::<f32>() as u64 * u64::from(capacity)
}

impl Kernel {
    /// Follows one batch of trajectories and reads a section while they are observed.
    pub fn trace(
        &self,
        batch: Batch<'_, Job>,
        schedule: &analysis::Schedule,
        probe: analysis::Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Trace>> {
        let jobs = batch.jobs;
        let cells = jobs.len() as u64;
        let storage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let [traces, readings] = self.with_room(|| {
            let traces = empty(&self.device, size_of::<Trace>() as u64 * cells, storage);
            Ok([traces, empty(&self.device, readings(capacity) * cells, storage)])
        })?;
        let dispatch = |Portion { count, budget, begin }| TraceDispatch {
            schedule: Schedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
            section: probe.section.code(),
            reading: probe.reading.code(jobs[0].system.plant().n),
            capacity,
            unused: 0,
        };
        let more = [&traces, &readings];
        let program = Program {
            kernel: shader::Kernel::Trace,
            iterations: ITERATIONS,
            more: &more,
            dispatch: &dispatch,
        };
        let verdicts = self.drive(batch, &program, watch, <[Verdict]>::to_vec)?;
        let traces = self.read(&traces, traces.size(), <[Trace]>::to_vec)?;
        let readings = self.read(&readings, readings.size(), <[f32]>::to_vec)?;
        let of_cell = |(((verdict, trace), readings), job): (((Verdict, &Trace), &[f32]), &Job)| {
            let kept = trace.passages.min(capacity);
            analysis::Trace {
                verdict: verdict.widen(&job.system),
                readings: readings[..kept as usize].iter().map(|&value| f64::from(value)).collect(),
                left_out: trace.passages - kept,
                rebounds: trace.rebounds.longest,
            }
        };
        Ok(verdicts
            .into_iter()
            .zip(&traces)
            .zip(readings.chunks_exact(capacity as usize))
            .zip(jobs)
            .map(of_cell)
            .collect())
    }
}
