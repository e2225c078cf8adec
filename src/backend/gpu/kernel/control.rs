//! The kernel `control_trajectories`: controlled trajectories to their outcomes.

use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::Kernel;
use super::device::{compiled, guarded};
use super::drive::{ITERATIONS, Portion, Program, ROW};
use crate::backend::gpu::layout::{CONTROLLED_BYTES, Control, ControlDispatch, ControlSchedule, Outcome};
use crate::backend::gpu::shader::{WORKGROUP, control_source};
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
        self.tile().min((binding / CONTROLLED_BYTES) as usize)
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
        let pipeline = match self.control.get() {
            Some(pipeline) => pipeline,
            None => {
                let pipeline = compiled(&self.device, "control_trajectories", control_source())?;
                self.control.get_or_init(|| pipeline)
            }
        };
        let controls: Vec<Control> = jobs
            .par_iter()
            .map(|ControlJob { job: Job { system, .. }, controller }| {
                Control::new(controller, system, &model::Flight::new(system))
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
            pipeline,
            state: CONTROLLED_BYTES,
            iterations: iterations(schedule),
            more: &[&controls],
            dispatch: &dispatch,
        };
        let jobs: Vec<Job> = jobs.iter().map(|job| job.job).collect();
        Ok(self.drive::<_, Outcome>(&jobs, &program, watch)?.iter().map(Outcome::widen).collect())
    }
}
