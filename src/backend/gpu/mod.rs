//! The GPU path: f32, the same mathematics as the CPU's, one trajectory per invocation.
//!
//! Only this folder names wgpu.

mod adapters;
mod followed;
mod kernel;
mod layout;
mod shader;

use derive_more::Debug;

use super::{Backend, BackendError, ControlJob, Job, REPRODUCIBLE, Result, Watch, joined_in_flight};
use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::control::{ControlSchedule, LONGEST_ON_DEVICE, Outcome};
use crate::model::System;

pub use adapters::{AdapterReport, adapters};
pub use kernel::Spent;

use followed::Followed;
use kernel::{Batch, Kernel, readings};
use shader::{Arithmetic, Residence, Shape};

/// The shader by which hardware follows trajectories of a system to their verdicts, in WGSL.
pub fn hardware_shader(system: &System) -> String {
    shader::source(shader::Kernel::Follow, &Shape::of(system), Residence::Workgroup, Arithmetic::Native)
}

/// Follows trajectories on an adapter.
#[derive(Debug)]
pub struct Gpu {
    report: AdapterReport,
    arithmetic: Arithmetic,
    #[debug(skip)]
    kernel: Kernel,
}

impl Gpu {
    /// Opens the best adapter whose description contains `text` (any, if there is none): hardware before software.
    ///
    /// # Errors
    /// [`BackendError::NoAdapter`] where none matches, listing what there is; [`BackendError::Device`] where the
    /// adapter refuses a device or the shader.
    pub fn open(text: Option<&str>) -> Result<Self> {
        Self::on(adapters::find(text)?, Arithmetic::Native)
    }

    /// The same with arithmetic that no driver changes: the same bits on every adapter, those of the processor's f32.
    ///
    /// # Errors
    /// As [`Gpu::open`].
    pub fn open_exact(text: Option<&str>) -> Result<Self> {
        Self::on(adapters::find(text)?, Arithmetic::Exact)
    }

    /// Opens the best hardware adapter, if there is one.
    ///
    /// # Errors
    /// [`BackendError::Device`] where the adapter refuses a device or the shader.
    pub fn open_hardware() -> Result<Option<Self>> {
        adapters::find_hardware().map(|found| Self::on(found, Arithmetic::Native)).transpose()
    }

    /// The same with the arithmetic of [`Gpu::open_exact`].
    ///
    /// # Errors
    /// As [`Gpu::open_hardware`].
    pub fn open_hardware_exact() -> Result<Option<Self>> {
        adapters::find_hardware().map(|found| Self::on(found, Arithmetic::Exact)).transpose()
    }

    fn on(found: adapters::Found, arithmetic: Arithmetic) -> Result<Self> {
        let kernel = Kernel::new(&found, arithmetic)?;
        Ok(Gpu { report: found.report, arithmetic, kernel })
    }

    /// Where the time of its work went since this was last asked.
    pub fn spent(&self) -> Spent {
        self.kernel.spent()
    }

    /// Whether the adapter is a software one.
    pub fn is_software(&self) -> bool {
        self.report.is_software()
    }

    /// The results of all jobs; `more` are the bytes that are bound for each beside what its kernel keeps. While the device is busy
    /// with one tile, the processor prepares another.
    fn in_tiles<F: Followed, R: Send>(
        &self,
        kernel: shader::Kernel,
        jobs: &[F],
        more: u64,
        compute: impl Fn(Batch<'_, F>) -> Result<Vec<R>> + Sync,
    ) -> Result<Vec<R>> {
        let (calls, tiles) = (self.calls(), self.kernel.tiles(kernel, jobs, more)?);
        // Several batches are under way where there are not as many tiles.
        let batches_at_a_time = calls.div_ceil(tiles.len().clamp(1, calls));
        joined_in_flight(calls, jobs.len(), tiles, |tile| {
            joined_in_flight(batches_at_a_time, tile.len(), self.kernel.batches(kernel, tile)?, &compute)
        })
    }
}

impl Backend for Gpu {
    fn name(&self) -> &'static str {
        "gpu"
    }

    fn adapter(&self) -> String {
        match self.arithmetic {
            Arithmetic::Native => self.report.to_string(),
            Arithmetic::Exact => format!("{}{REPRODUCIBLE}", self.report),
        }
    }

    fn tile(&self) -> usize {
        self.kernel.tile()
    }

    fn calls(&self) -> usize {
        self.kernel.tiles_at_a_time()
    }

    fn run(&self, jobs: &[Job], schedule: &Schedule, watch: &dyn Watch) -> Result<Vec<Verdict>> {
        schedule.check()?;
        self.in_tiles(shader::Kernel::Follow, jobs, 0, |batch| self.kernel.run(batch, schedule, watch))
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Outcome>> {
        schedule.check()?;
        jobs.iter()
            .try_for_each(|job| job.controller.check_on_device())
            .map_err(|why| BackendError::Unsupported(why.to_owned()))?;
        if schedule.max_period as usize > LONGEST_ON_DEVICE {
            return Err(BackendError::Unsupported(format!(
                "on the GPU periods of at most {LONGEST_ON_DEVICE} iterates are looked for, and not {}: lower \
                 --max-period, or use --backend cpu",
                schedule.max_period
            )));
        }
        self.in_tiles(shader::Kernel::Control, jobs, 0, |batch| self.kernel.control(batch, schedule, watch))
    }

    fn trace(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        probe: Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<Trace>> {
        schedule.check()?;
        self.in_tiles(shader::Kernel::Trace, jobs, readings(capacity), |batch| {
            self.kernel.trace(batch, schedule, probe, capacity, watch)
        })
    }

    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>> {
        let followed: Vec<(&Job, u32)> = jobs.iter().zip(periods.iter().copied()).collect();
        self.in_tiles(shader::Kernel::Extent, &followed, 0, |batch| self.kernel.extents(batch, watch))
    }
}

#[cfg(test)]
mod tests;
