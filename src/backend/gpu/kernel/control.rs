//! The kernel `control_trajectories`: controlled trajectories to their outcomes.

use rayon::prelude::*;

use super::Kernel;
use super::device::filled;
use super::drive::MOVE;
use super::program::{Portion, Program, ROW};
use super::room::Batch;
use crate::backend::gpu::layout::{ControlDispatch, ControlSchedule, Outcome, control_words};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{ControlJob, Result, Watch};
use crate::control::{self, DELAYS, LONGEST_DELAY, LONGEST_ON_DEVICE};
use crate::model::Real;

/// Loop iterations in one move under control: beyond those without it, a return to the section sums seven more series,
/// moves what is remembered, and compares; what begins and ends a trajectory is taken as part of a move.
pub(super) fn iterations(schedule: &control::ControlSchedule) -> u32 {
    let reach = schedule.max_period;
    let kept = reach.max(LONGEST_DELAY as u32) + 1;
    MOVE + 7 * <f32 as Real>::ORDER as u32
        + kept
        + 7 * DELAYS as u32
        + 8 * reach
        + 2 * LONGEST_ON_DEVICE as u32
}

impl Kernel {
    /// Follows one batch of trajectories under control.
    pub fn control(
        &self,
        batch: Batch<'_, ControlJob>,
        schedule: &control::ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<control::Outcome>> {
        let jobs = batch.jobs;
        let words = |job: &ControlJob| control_words(&job.controller, &job.job.system);
        let controls: Vec<Vec<u32>> = jobs.par_iter().map(words).collect();
        let controls = filled(&self.device, &controls)?;
        let dispatch = |Portion { count, budget, begin }| ControlDispatch {
            schedule: ControlSchedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
            max_period: schedule.max_period,
        };
        let program = Program {
            kernel: shader::Kernel::Control,
            iterations: iterations(schedule),
            more: &[&controls],
            dispatch: &dispatch,
        };
        let widened =
            |(outcome, job): (&Outcome, &ControlJob)| outcome.widen(&job.job.system, job.controller.stop());
        self.drive(batch, &program, watch, |outcomes: &[Outcome]| {
            outcomes.iter().zip(jobs).map(widened).collect()
        })
    }
}
