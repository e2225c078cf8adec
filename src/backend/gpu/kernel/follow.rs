//! The kernel `follow`: trajectories to their verdicts.

use super::Kernel;
use super::drive::{ITERATIONS, Portion, Program, ROW};
use crate::analysis;
use crate::backend::gpu::layout::{Dispatch, OBSERVER_BYTES, Schedule, Verdict};
use crate::backend::gpu::shader::WORKGROUP;
use crate::backend::{BackendError, Job, Watch};

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
        let program = self.observing(&self.follow, &[], &dispatch);
        Ok(self.drive::<_, Verdict>(jobs, &program, watch)?.iter().map(Verdict::widen).collect())
    }

    /// A kernel that carries observers and gives verdicts.
    pub(super) fn observing<'a, D>(
        &self,
        pipeline: &'a wgpu::ComputePipeline,
        more: &'a [&'a wgpu::Buffer],
        dispatch: &'a dyn Fn(Portion) -> D,
    ) -> Program<'a, D> {
        Program { pipeline, state: OBSERVER_BYTES, iterations: ITERATIONS, more, dispatch }
    }
}
