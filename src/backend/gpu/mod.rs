//! The GPU path: f32, the same mathematics as the CPU's, one trajectory per invocation.
//!
//! Only this folder names wgpu.

mod adapters;
mod kernel;
mod layout;
mod shader;

use std::fmt;

use super::{Backend, BackendError, ControlJob, Job, REPRODUCIBLE, Watch};
use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::control::{ControlSchedule, Controller, Convention, LONGEST_ON_DEVICE, Outcome};

pub use adapters::{AdapterReport, adapters};

use kernel::Kernel;
use shader::Arithmetic;

/// Follows trajectories on an adapter.
pub struct Gpu {
    report: AdapterReport,
    arithmetic: Arithmetic,
    kernel: Kernel,
}

impl fmt::Debug for Gpu {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Gpu").field("report", &self.report).finish_non_exhaustive()
    }
}

impl Gpu {
    /// Opens the best adapter whose description contains `text` (any, if there is none): hardware before software.
    ///
    /// # Errors
    /// [`BackendError::NoAdapter`] where none matches, listing what there is; [`BackendError::Device`] where the
    /// adapter refuses a device or the shader.
    pub fn open(text: Option<&str>) -> Result<Self, BackendError> {
        Self::on(adapters::find(text)?, Arithmetic::Native)
    }

    /// The same with arithmetic that no driver changes: the same bits on every adapter, those of the processor's f32.
    ///
    /// # Errors
    /// As [`Gpu::open`].
    pub fn open_exact(text: Option<&str>) -> Result<Self, BackendError> {
        Self::on(adapters::find(text)?, Arithmetic::Exact)
    }

    /// Opens the best hardware adapter, if there is one.
    ///
    /// # Errors
    /// [`BackendError::Device`] where the adapter refuses a device or the shader.
    pub fn open_hardware() -> Result<Option<Self>, BackendError> {
        adapters::find_hardware().map(|found| Self::on(found, Arithmetic::Native)).transpose()
    }

    /// The same with the arithmetic of [`Gpu::open_exact`].
    ///
    /// # Errors
    /// As [`Gpu::open_hardware`].
    pub fn open_hardware_exact() -> Result<Option<Self>, BackendError> {
        adapters::find_hardware().map(|found| Self::on(found, Arithmetic::Exact)).transpose()
    }

    fn on(found: adapters::Found, arithmetic: Arithmetic) -> Result<Self, BackendError> {
        let kernel = Kernel::new(&found, arithmetic)?;
        Ok(Gpu { report: found.report, arithmetic, kernel })
    }

    /// Whether the adapter is a software one.
    pub fn is_software(&self) -> bool {
        self.report.is_software()
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

    fn run(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Verdict>, BackendError> {
        let mut verdicts = Vec::with_capacity(jobs.len());
        for tile in jobs.chunks(self.kernel.tile()) {
            verdicts.extend(self.kernel.run(tile, schedule, watch)?);
        }
        Ok(verdicts)
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Outcome>, BackendError> {
        if self.arithmetic == Arithmetic::Exact && self.is_software() {
            return Err(BackendError::Unsupported(
                "a software adapter's compiler does not always come to an end with the kernel of control in exact \
                 arithmetic: use --backend cpu, which gives the same bits"
                    .to_owned(),
            ));
        }
        if jobs.iter().any(|job| !has_kernel_for(&job.controller)) {
            return Err(BackendError::Unsupported(
                "on the GPU a sine force is in phase with the forcing, gamma = 1 and phase = 0: use --backend cpu \
                 for any other"
                    .to_owned(),
            ));
        }
        if schedule.max_period as usize > LONGEST_ON_DEVICE {
            return Err(BackendError::Unsupported(format!(
                "on the GPU periods of at most {LONGEST_ON_DEVICE} iterates are looked for, and not {}: lower \
                 --max-period, or use --backend cpu",
                schedule.max_period
            )));
        }
        let mut outcomes = Vec::with_capacity(jobs.len());
        for tile in jobs.chunks(self.kernel.control_tile(jobs)?) {
            outcomes.extend(self.kernel.control(tile, schedule, watch)?);
        }
        Ok(outcomes)
    }

    fn trace(
        &self,
        jobs: &[Job],
        schedule: &Schedule,
        probe: Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<Trace>, BackendError> {
        let mut traces = Vec::with_capacity(jobs.len());
        for tile in jobs.chunks(self.kernel.trace_tile(capacity)) {
            traces.extend(self.kernel.trace(tile, schedule, probe, capacity, watch)?);
        }
        Ok(traces)
    }

    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>, BackendError> {
        let mut extents = Vec::with_capacity(jobs.len());
        for (jobs, periods) in jobs.chunks(self.kernel.tile()).zip(periods.chunks(self.kernel.tile())) {
            extents.extend(self.kernel.extents(jobs, periods, watch)?);
        }
        Ok(extents)
    }
}

/// A force in phase with the forcing is a change of it; any other would be a second phasor.
fn has_kernel_for(controller: &Controller<f64>) -> bool {
    match controller {
        Controller::Sine(sine) => match sine.convention {
            Convention::Kick => true,
            Convention::Force => sine.ratio == 1.0 && sine.phase == 0.0,
            Convention::ForceLocal => false,
        },
        Controller::None(_) | Controller::Pulse(_) | Controller::Delay(_) => true,
    }
}
