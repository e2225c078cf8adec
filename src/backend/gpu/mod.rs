//! The GPU path: f32, the same mathematics as the CPU's, one trajectory per invocation.
//!
//! Only this folder names wgpu.

mod adapters;
mod kernel;
mod layout;
mod shader;

use derive_more::Debug;
use rayon::prelude::*;

use super::{Backend, BackendError, ControlJob, Job, REPRODUCIBLE, Result, Watch, in_flight};
use crate::analysis::{Extent, Probe, Schedule, Trace, Verdict};
use crate::control::{ControlSchedule, LONGEST_ON_DEVICE, Outcome};
use crate::model::System;

pub use adapters::{AdapterReport, adapters};
pub use kernel::Spent;

use kernel::{Kernel, readings};
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

    /// The results of all jobs of some tiles: while the device is busy with one, the processor prepares another.
    fn in_tiles<J: Sync, R: Send>(
        &self,
        tiles: Vec<&[J]>,
        compute: impl Fn(&[J]) -> Result<Vec<R>> + Sync,
    ) -> Result<Vec<R>> {
        let mut found = in_flight(self.calls(), tiles, compute)?;
        if found.len() <= 1 {
            return Ok(found.pop().unwrap_or_default());
        }
        let mut all = Vec::with_capacity(found.iter().map(Vec::len).sum());
        found.into_iter().for_each(|of_tile| all.par_extend(of_tile));
        Ok(all)
    }

    /// Refuses what a software adapter may not come to an end with: Mesa 22.3 does not always when it compiles the kernel of
    /// control in exact arithmetic, or for several contact normals, and its memory grows meanwhile.
    fn check_control_ends(&self, jobs: &[ControlJob]) -> Result<()> {
        if !self.is_software() {
            return Ok(());
        }
        let what = match self.arithmetic {
            Arithmetic::Exact => "in exact arithmetic: use --backend cpu, which gives the same bits",
            Arithmetic::Native if jobs.iter().any(|job| job.job.system.normals() > 1) => {
                "for stops in several directions: use --backend cpu"
            }
            Arithmetic::Native => return Ok(()),
        };
        Err(BackendError::Unsupported(format!(
            "a software adapter's compiler does not always come to an end with the kernel of control {what}"
        )))
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
        let tiles = self.kernel.tiles(shader::Kernel::Follow, jobs, |job| job, 0)?;
        self.in_tiles(tiles, |tile| self.kernel.run(tile, schedule, watch))
    }

    fn control(
        &self,
        jobs: &[ControlJob],
        schedule: &ControlSchedule,
        watch: &dyn Watch,
    ) -> Result<Vec<Outcome>> {
        self.check_control_ends(jobs)?;
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
        let tiles = self.kernel.tiles(shader::Kernel::Control, jobs, |job| &job.job, 0)?;
        self.in_tiles(tiles, |tile| self.kernel.control(tile, schedule, watch))
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
        let tiles = self.kernel.tiles(shader::Kernel::Trace, jobs, |job| job, readings(capacity))?;
        self.in_tiles(tiles, |tile| self.kernel.trace(tile, schedule, probe, capacity, watch))
    }

    fn extents(&self, jobs: &[Job], periods: &[u32], watch: &dyn Watch) -> Result<Vec<Extent>> {
        let followed: Vec<(&Job, u32)> = jobs.iter().zip(periods.iter().copied()).collect();
        let tiles = self.kernel.tiles(shader::Kernel::Extent, &followed, |(job, _)| job, 0)?;
        self.in_tiles(tiles, |tile| self.kernel.extents(tile, watch))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::{Reading, Section};
    use crate::backend::Unwatched;
    use crate::model::{Flows, Setting};
    use crate::plane::Start;
    use crate::system::Family;

    /// Cells of few flows that go through chatter, sticking, chaos and rest.
    fn jobs() -> Vec<Job> {
        let flows = Flows::default();
        let cell = |omega: f64, delta: f64| {
            let setting = Setting::defaults(Family::paper()).with_named("omega", omega);
            let system = flows.share(System::new(setting.with_named("delta", delta)).unwrap());
            let start = Start::Symmetric.state(&system);
            Job { system, start }
        };
        [0.3, 0.9, 1.5, 2.6, 3.7]
            .into_iter()
            .flat_map(|omega| [0.03, 0.11, 0.22, 0.5].map(|delta| cell(omega, delta)))
            .collect()
    }

    /// Cells of which each has a flow of its own take more room than those that share theirs.
    #[test]
    fn what_a_device_cannot_bind_at_once_is_followed_in_tiles() {
        let schedule = Schedule { transient: 20, observe: 20, max_period: 8, fixed_periods: true };
        let job = |omega: f64| {
            let system = System::new(Setting::defaults(Family::paper()).with_named("omega", omega)).unwrap();
            Job { system, start: [0.0; 4].into() }
        };
        let jobs: Vec<Job> = (0..60).map(|i| job(1.0 + 0.05 * f64::from(i))).collect();
        let found = adapters::find(None).expect("an adapter");
        println!("{}", found.report);
        let arithmetic = Arithmetic::Native;
        let limits = wgpu::Limits { max_storage_buffer_binding_size: 16 << 10, ..wgpu::Limits::default() };
        let kernel = Kernel::within(limits, &found, arithmetic).unwrap();
        let expected: Vec<Verdict> =
            jobs.chunks(7).flat_map(|some| kernel.run(some, &schedule, &Unwatched).unwrap()).collect();
        let tiles = kernel.tiles(shader::Kernel::Follow, &jobs, |job| job, 0).unwrap();
        assert!(tiles.len() > 2 && tiles[0].len() > 7, "{} tiles of {}", tiles.len(), tiles[0].len());
        let shared = vec![jobs[0].clone(); 60];
        let tiles_of_shared = kernel.tiles(shader::Kernel::Follow, &shared, |job| job, 0).unwrap();
        assert!(tiles_of_shared.len() < tiles.len(), "{} tiles", tiles_of_shared.len());
        assert!(matches!(kernel.run(&jobs, &schedule, &Unwatched), Err(BackendError::Device(_))), "one tile");
        let gpu = Gpu { report: found.report, arithmetic, kernel };
        let verdicts = gpu.run(&jobs, &schedule, &Unwatched).unwrap();
        assert_eq!(format!("{verdicts:?}"), format!("{expected:?}"));
        assert!(verdicts.iter().any(|verdict| verdict.state != verdicts[0].state), "not all are alike");
    }

    /// Buffers of a tile that is done are another's, which may be smaller.
    #[test]
    fn what_one_tile_left_is_nothing_to_the_next() {
        let schedule = Schedule { transient: 20, observe: 20, max_period: 8, fixed_periods: true };
        let open = || {
            let gpu = Gpu::open(None).expect("an adapter");
            println!("{}", gpu.report);
            gpu
        };
        let ways = |gpu: &Gpu, jobs: &[Job]| {
            let probe = Probe { section: Section::A, reading: Reading::VAfter };
            let verdicts = gpu.run(jobs, &schedule, &Unwatched).unwrap();
            let traces = gpu.trace(jobs, &schedule, probe, 64, &Unwatched).unwrap();
            let extents = gpu.extents(jobs, &vec![20; jobs.len()], &Unwatched).unwrap();
            format!("{verdicts:?} {traces:?} {extents:?}")
        };
        let (used, jobs) = (open(), jobs());
        let before = ways(&used, &jobs);
        let fewer = &jobs[7..12];
        let found = ways(&used, fewer);
        assert_eq!(found, ways(&open(), fewer));
        assert_eq!(before, ways(&used, &jobs));
        assert_ne!(found, ways(&used, &jobs[6..11]), "the check can fail");
    }

    /// What hardware compiles is run by the software adapter too, with the same bits as what that compiles.
    #[test]
    fn hardwares_shader_gives_the_bits_of_the_software_adapters() {
        let schedule = Schedule { transient: 40, observe: 40, max_period: 8, fixed_periods: false };
        let jobs = jobs();
        // With too little memory of the workgroup it is the software adapter's.
        let kernel = |of_workgroups: u32| {
            let found = adapters::find(None).expect("an adapter");
            println!("{}", found.report);
            let limits =
                wgpu::Limits { max_compute_workgroup_storage_size: of_workgroups, ..wgpu::Limits::default() };
            Kernel::within(limits, &found, Arithmetic::Exact)
                .unwrap()
                .with_shaders_of_hardware(Arithmetic::Exact)
        };
        let run =
            |kernel: &Kernel, jobs: &[Job]| format!("{:?}", kernel.run(jobs, &schedule, &Unwatched).unwrap());
        let (hardwares, softwares) = (kernel(16 << 10), kernel(1 << 10));
        // At the same time, since it is the compiler that takes long.
        let (found, expected) = rayon::join(|| run(&hardwares, &jobs), || run(&softwares, &jobs));
        assert_eq!(found, expected);
        for met in ["regime: Periodic,", "regime: PeriodicSticking", "regime: Chaotic", "symmetric: true"] {
            assert!(expected.contains(met), "{met}: {expected}");
        }
        // The test can fail: a cell with another gap comes to something else.
        let mut other = jobs.clone();
        other[5] = jobs[6].clone();
        assert_ne!(run(&hardwares, &other), expected);
    }
}
