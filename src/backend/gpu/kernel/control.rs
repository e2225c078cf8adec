//! The kernel `control_trajectories`: controlled trajectories to their outcomes.

use std::sync::Arc;

use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::Kernel;
use super::compiled::Compiled;
use super::device::guarded;
use super::drive::{ITERATIONS, Portion, Program, ROW};
use crate::backend::gpu::layout::{Control, ControlDispatch, ControlSchedule, Outcome};
use crate::backend::gpu::shader::{self, Shape, WORKGROUP};
use crate::backend::{BackendError, ControlJob, Job, Watch};
use crate::control::{self, DELAYS, LONGEST_DELAY, LONGEST_ON_DEVICE};
use crate::model::{self, Real};

/// Loop iterations in one move under control: beyond those without it, a return to the section sums three more series,
/// moves what is remembered, and compares.
fn iterations(schedule: &control::ControlSchedule) -> u32 {
    let reach = schedule.max_period;
    let kept = reach.max(LONGEST_DELAY as u32) + 1;
    ITERATIONS
        + 4 * <f32 as Real>::ORDER as u32
        + kept
        + 4 * DELAYS as u32
        + 4 * reach
        + 2 * LONGEST_ON_DEVICE as u32
}

impl Kernel {
    /// Trajectories that one call of [`Kernel::control`] takes at most.
    pub fn control_tile(&self) -> usize {
        let binding = self.device.limits().max_storage_buffer_binding_size;
        let state = self.controlling().map_or(1, |kernel| kernel.state.max(1));
        self.tile().min((binding / state) as usize)
    }

    /// The kernel, compiled when it is first needed.
    fn controlling(&self) -> Result<Arc<Compiled>, BackendError> {
        let shape = Shape { coordinates: 2, normals: 1, stops: 2 };
        self.library.get(&self.device, shader::Kernel::Control, shape)
    }

    /// Follows one tile of trajectories under control.
    pub fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &control::ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<control::Outcome>, BackendError> {
        if jobs.is_empty() {
            return Ok(Vec::new());
        }
        let pipeline = self.controlling()?;
        let controls: Vec<Control> = jobs
            .par_iter()
            .map(|ControlJob { job: Job { system, .. }, controller }| {
                Control::new(controller, system, &model::Flight::<f64, 2>::new(system))
            })
            .collect();
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
