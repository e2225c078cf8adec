//! The kernel `follow`: trajectories to their verdicts.

use rayon::prelude::*;

use super::Kernel;
use super::drive::{MOVE, SQUARES};
use super::program::{Portion, Program, ROW};
use super::room::Batch;
use crate::analysis;
use crate::analysis::constants::{CLEAR_STEPS, HELD_STEPS, ROUNDS, TURNS};
use crate::backend::gpu::layout::{Dispatch, Schedule, Verdict};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{Job, Result, Watch};

/// Loop iterations in what the kernel counts as one move: turns of rounds in the transient, others under observation, whole
/// steps on a stop after them, and what is rare.
pub(super) const ITERATIONS: u32 =
    2 * TURNS * (1 + ROUNDS * (2 + CLEAR_STEPS) + SQUARES) + HELD_STEPS + MOVE + SQUARES;

impl Kernel {
    /// Follows one batch of trajectories.
    pub fn run(
        &self,
        batch: Batch<'_, Job>,
        schedule: &analysis::Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Verdict>> {
        let dispatch = |Portion { count, budget, begin }| Dispatch {
            schedule: Schedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
        };
        let program = Program {
            kernel: shader::Kernel::Follow,
            iterations: ITERATIONS,
            more: &[],
            dispatch: &dispatch,
        };
        let jobs = batch.jobs;
        self.drive(batch, &program, watch, |verdicts: &[Verdict]| {
            verdicts.par_iter().zip(jobs).map(|(verdict, job)| verdict.widen(&job.system)).collect()
        })
    }
}
