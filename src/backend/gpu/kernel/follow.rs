//! The kernel `follow`: trajectories to their verdicts.

use super::Kernel;
use super::compiled::Compiled;
use super::drive::MOVE;
use super::program::{Portion, Program, ROW};
use crate::analysis;
use crate::analysis::constants::{CLEAR_STEPS, ROUNDS, TURNS};
use crate::backend::gpu::layout::{Dispatch, Schedule, Verdict};
use crate::backend::gpu::shader::{self, Shape, WORKGROUP};
use crate::backend::{BackendError, Job, Watch};

/// Loop iterations in what the kernel counts as one move: turns of rounds in the transient, others under observation, and
/// what is rare after them.
const TURN: u32 = 2 * TURNS * (1 + ROUNDS * (2 + CLEAR_STEPS)) + MOVE;

impl Kernel {
    /// Follows one tile of trajectories.
    pub fn run(
        &self,
        jobs: &[Job],
        schedule: &analysis::Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Verdict>, BackendError> {
        let dispatch = |Portion { count, budget, begin }| Dispatch {
            schedule: Schedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
        };
        let Some(shape) = shape_of(jobs)? else { return Ok(Vec::new()) };
        let pipeline = self.library.get(&self.device, shader::Kernel::Follow, shape)?;
        let program = self.observing(&pipeline, TURN, &[], &dispatch);
        let verdicts = self.drive::<_, Verdict>(jobs, &program, watch)?;
        Ok(verdicts.iter().zip(jobs).map(|(verdict, job)| verdict.widen(&job.system)).collect())
    }

    /// A kernel that carries observers and gives verdicts.
    pub(super) fn observing<'a, D>(
        &self,
        pipeline: &'a Compiled,
        iterations: u32,
        more: &'a [&'a wgpu::Buffer],
        dispatch: &'a dyn Fn(Portion) -> D,
    ) -> Program<'a, D> {
        Program { pipeline, iterations, more, dispatch }
    }
}

/// The shape that all jobs of a tile have; none where there are no jobs.
///
/// # Errors
/// [`BackendError::Unsupported`] where they differ: a direction that turns parallel to another within a plane.
pub fn shape_of(jobs: &[Job]) -> Result<Option<Shape>, BackendError> {
    let Some(first) = jobs.first() else { return Ok(None) };
    let shape = |job: &Job| {
        let plant = job.system.plant();
        Shape { coordinates: plant.n, normals: job.system.normals(), stops: plant.stops.len() }
    };
    let expected = shape(first);
    if jobs.iter().all(|job| shape(job) == expected) {
        return Ok(Some(expected));
    }
    Err(BackendError::Unsupported(
        "the stops of these cells do not lie along the same number of directions everywhere: use --backend cpu"
            .to_owned(),
    ))
}
