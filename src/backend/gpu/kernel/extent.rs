//! The kernel of extents: how far trajectories go.

use wgpu::util::DeviceExt;

use super::Kernel;
use super::device::guarded;
use super::drive::MOVE;
use super::follow::shape_of;
use super::program::{Portion, Program, ROW};
use crate::analysis;
use crate::backend::gpu::layout::{Extent, ExtentDispatch};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{BackendError, Job, Watch};
use crate::model::Real;

/// A move, and the two flights that measure it.
const WITH_FLIGHTS: u32 = MOVE + 2 * <f32 as Real>::ORDER as u32;

impl Kernel {
    /// Follows one tile of trajectories, each for so many forcing periods.
    pub fn extents(
        &self,
        jobs: &[Job],
        periods: &[u32],
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Extent>, BackendError> {
        let Some(shape) = shape_of(jobs)? else { return Ok(Vec::new()) };
        let pipeline = self.library.get(&self.device, shader::Kernel::Extent, shape)?;
        let periods = guarded(&self.device, || {
            self.device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: None,
                contents: bytemuck::cast_slice(periods),
                usage: wgpu::BufferUsages::STORAGE,
            })
        })?;
        let dispatch =
            |Portion { count, budget, begin }| ExtentDispatch { count, budget, begin, row: ROW * WORKGROUP };
        let more = [&periods];
        let program =
            Program { pipeline: &pipeline, iterations: WITH_FLIGHTS, more: &more, dispatch: &dispatch };
        let extents = self.drive::<_, Extent>(jobs, &program, watch)?;
        Ok(extents.iter().map(|extent| extent.widen(shape.coordinates)).collect())
    }
}
