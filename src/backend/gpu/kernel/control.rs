//! The kernel `control_trajectories`: controlled trajectories to their outcomes.

use std::sync::Arc;

use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::Kernel;
use super::compiled::Compiled;
use super::device::guarded;
use super::drive::MOVE;
use super::follow::shape_of;
use super::program::{Portion, Program, ROW};
use crate::backend::gpu::layout::{Control, ControlDispatch, ControlSchedule, Outcome};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{BackendError, ControlJob, Job, Watch};
use crate::control::{self, DELAYS, LONGEST_DELAY, LONGEST_ON_DEVICE};
use crate::model::Real;

/// Loop iterations in one move under control: beyond those without it, a return to the section sums three more series,
/// moves what is remembered, and compares.
fn iterations(schedule: &control::ControlSchedule) -> u32 {
    let reach = schedule.max_period;
    let kept = reach.max(LONGEST_DELAY as u32) + 1;
    MOVE + 4 * <f32 as Real>::ORDER as u32
        + kept
        + 4 * DELAYS as u32
        + 5 * reach
        + 2 * LONGEST_ON_DEVICE as u32
}

impl Kernel {
    /// Trajectories that one call of [`Kernel::control`] takes at most.
    ///
    /// # Errors
    /// Where the jobs differ in shape, or their kernel cannot be compiled.
    pub fn control_tile(&self, jobs: &[ControlJob]) -> Result<usize, BackendError> {
        let binding = self.device.limits().max_storage_buffer_binding_size;
        let state = self.controlling(jobs)?.map_or(1, |kernel| kernel.state.max(1));
        Ok(self.tile().min((binding / state) as usize).max(1))
    }

    /// The kernel for the shape of some jobs, compiled when it is first needed; none where there are no jobs.
    fn controlling(&self, jobs: &[ControlJob]) -> Result<Option<Arc<Compiled>>, BackendError> {
        let jobs: Vec<Job> = jobs.iter().map(|job| job.job.clone()).collect();
        let kernel = |shape| self.library.get(&self.device, shader::Kernel::Control, shape);
        shape_of(&jobs)?.map(kernel).transpose()
    }

    /// Follows one tile of trajectories under control.
    pub fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &control::ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<control::Outcome>, BackendError> {
        let Some(pipeline) = self.controlling(jobs)? else { return Ok(Vec::new()) };
        let controls: Vec<Vec<u32>> = jobs
            .par_iter()
            .map(|ControlJob { job: Job { system, .. }, controller }| Control::words(controller, system))
            .collect();
        let controls = controls.concat();
        let controls = guarded(&self.device, || {
            self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(&controls),
                usage: wgpu::BufferUsages::STORAGE,
            })
        })?;
        let dispatch = |Portion { count, budget, begin }| ControlDispatch {
            schedule: ControlSchedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
            max_period: schedule.max_period,
        };
        let program = Program {
            pipeline: &pipeline,
            iterations: iterations(schedule),
            more: &[&controls],
            dispatch: &dispatch,
        };
        let jobs: Vec<Job> = jobs.iter().map(|job| job.job.clone()).collect();
        let outcomes = self.drive::<_, Outcome>(&jobs, &program, watch)?;
        Ok(outcomes.iter().zip(&jobs).map(|(outcome, job)| outcome.widen(&job.system)).collect())
    }
}
