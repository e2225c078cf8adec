//! The kernel of extents: how far trajectories go.

use super::Kernel;
use super::device::filled;
use super::drive::MOVE;
use super::program::{Portion, Program, ROW};
use super::room::Batch;
use crate::analysis;
use crate::backend::gpu::layout::{Extent, ExtentDispatch};
use crate::backend::gpu::shader::{self, WORKGROUP};
use crate::backend::{Job, Result, Watch};
use crate::model::Real;

/// The halves in which a piece of flight is measured.
pub(super) const HALVES: u32 = 2;

/// A move, and the flights that measure it: two for each half.
pub(super) const WITH_FLIGHTS: u32 = MOVE + HALVES * (1 + 2 * <f32 as Real>::ORDER as u32);

impl Kernel {
    /// Follows one batch of trajectories, each for so many forcing periods.
    pub fn extents(&self, batch: Batch<'_, (&Job, u32)>, watch: &dyn Watch) -> Result<Vec<analysis::Extent>> {
        let periods = filled(&self.device, &[batch.jobs.iter().map(|&(_, periods)| periods).collect()])?;
        let dispatch =
            |Portion { count, budget, begin }| ExtentDispatch { count, budget, begin, row: ROW * WORKGROUP };
        let more = [&periods];
        let kernel = shader::Kernel::Extent;
        let program = Program { kernel, iterations: WITH_FLIGHTS, more: &more, dispatch: &dispatch };
        let n = batch.jobs[0].0.system.coordinates();
        self.drive(batch, &program, watch, |extents: &[Extent]| {
            extents.iter().map(|extent| extent.widen(n)).collect()
        })
    }
}
