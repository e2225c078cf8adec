//! The kernel on its device: a tile of trajectories, dispatched in bounded portions until all are finished.

use std::marker::PhantomData;
use std::sync::{OnceLock, mpsc};
use std::time::{Duration, Instant};

use bytemuck::Pod;
use rayon::prelude::*;
use wgpu::util::DeviceExt;

use super::adapters::Found;
use super::layout::{
    CONTROLLED_BYTES, Control, ControlDispatch, ControlSchedule, Dispatch, Flight, Kick, OBSERVER_BYTES,
    Outcome, Record, Schedule, Trace, TraceDispatch, Verdict,
};
use super::shader::{WORKGROUP, control_source, follow_source, trace_source};
use crate::analysis;
use crate::backend::{BackendError, ControlJob, Job, Watch};
use crate::control::{self, DEPTH, LONGEST};
use crate::model::{self, Real};

/// How long one dispatch should take; a display driver kills one of a few seconds.
const PORTION: Duration = Duration::from_millis(200);
/// Moves of the first dispatch, before its speed is known.
const FIRST_BUDGET: u32 = 128;
/// The most moves of one dispatch on hardware.
const HARDWARE_BUDGET: u32 = 1 << 14;
/// Loop iterations in one move: the loop of the moves itself, and every place where a series is summed. Lanes that
/// diverge go through all of them, one after the other.
const ITERATIONS: u32 = 1 + 17 * <f32 as Real>::ORDER as u32;
/// The same under control: a return to the section sums three more series, moves what is remembered, and compares.
const CONTROL_ITERATIONS: u32 =
    ITERATIONS + 4 * <f32 as Real>::ORDER as u32 + 5 * DEPTH as u32 + 4 * LONGEST as u32;
/// Loop iterations of one dispatch on a software adapter: Mesa's stop every loop in silence after 65,535 iterations
/// of all the loops in an invocation. (The kernel counts a trajectory that was cut short as failed.)
const SOFTWARE_ITERATIONS: u32 = 65_535;
/// Trajectories of one tile.
const HARDWARE_TILE: usize = 1 << 18;
const SOFTWARE_TILE: usize = 1 << 13;
/// Workgroups in one row of a dispatch; every adapter takes at least 65,535.
const ROW: u32 = 1 << 15;

/// A device with the compiled shaders.
pub struct Kernel {
    device: wgpu::Device,
    queue: wgpu::Queue,
    follow: wgpu::ComputePipeline,
    /// Compiled when it is first needed.
    trace: OnceLock<wgpu::ComputePipeline>,
    /// The same.
    control: OnceLock<wgpu::ComputePipeline>,
    software: bool,
}

/// What a tile of trajectories is followed with.
struct Program<'a, D> {
    pipeline: &'a wgpu::ComputePipeline,
    /// Bytes of a trajectory's state.
    state: u64,
    /// Loop iterations in one move.
    iterations: u32,
    /// Buffers beyond those that every kernel has, in the order of their bindings.
    more: &'a [&'a wgpu::Buffer],
    /// The uniforms of one dispatch: of so many trajectories, so many moves, the first or a later one.
    dispatch: &'a dyn Fn(Portion) -> D,
}

/// One dispatch of a tile.
#[derive(Clone, Copy)]
struct Portion {
    /// Trajectories.
    count: u32,
    /// Moves of each.
    budget: u32,
    /// 1 in the first dispatch, 0 in those that resume it.
    begin: u32,
}

impl Kernel {
    /// Opens a device on the adapter and compiles the shader.
    pub fn new(found: &Found) -> Result<Self, BackendError> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("impact-atlas"),
            required_limits: wgpu::Limits::default(),
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) = pollster::block_on(found.adapter.request_device(&descriptor))
            .map_err(|error| BackendError::Device(error.to_string()))?;
        let follow = compiled(&device, "follow", follow_source())?;
        Ok(Kernel {
            device,
            queue,
            follow,
            trace: OnceLock::new(),
            control: OnceLock::new(),
            software: found.report.is_software(),
        })
    }

    /// Trajectories that one call of [`Kernel::run`] takes at most.
    pub fn tile(&self) -> usize {
        if self.software { SOFTWARE_TILE } else { HARDWARE_TILE }
    }

    /// Trajectories that one call of [`Kernel::trace`] takes at most.
    pub fn trace_tile(&self, capacity: u32) -> usize {
        let binding = self.device.limits().max_storage_buffer_binding_size;
        let cells = binding / (4 * u64::from(capacity.max(1)));
        self.tile().min(cells.max(1) as usize)
    }

    /// Follows one tile of trajectories.
    pub fn run(
        &self,
        jobs: &[Job],
        schedule: &analysis::Schedule,
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Verdict>, BackendError> {
        let dispatch = |Portion { count, budget, begin }| Dispatch {
            schedule: Schedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
        };
        let program = self.observing(&self.follow, &[], &dispatch);
        Ok(self.drive::<_, Verdict>(jobs, &program, watch)?.iter().map(Verdict::widen).collect())
    }

    /// A kernel that carries observers and gives verdicts.
    fn observing<'a, D>(
        &self,
        pipeline: &'a wgpu::ComputePipeline,
        more: &'a [&'a wgpu::Buffer],
        dispatch: &'a dyn Fn(Portion) -> D,
    ) -> Program<'a, D> {
        Program { pipeline, state: OBSERVER_BYTES, iterations: ITERATIONS, more, dispatch }
    }

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
        };
        let program = Program {
            pipeline,
            state: CONTROLLED_BYTES,
            iterations: CONTROL_ITERATIONS,
            more: &[&controls],
            dispatch: &dispatch,
        };
        let jobs: Vec<Job> = jobs.iter().map(|job| job.job).collect();
        Ok(self.drive::<_, Outcome>(&jobs, &program, watch)?.iter().map(Outcome::widen).collect())
    }

    /// Follows one tile of trajectories and reads a section while they are observed.
    pub fn trace(
        &self,
        jobs: &[Job],
        schedule: &analysis::Schedule,
        probe: analysis::Probe,
        capacity: u32,
        watch: &dyn Watch,
    ) -> Result<Vec<analysis::Trace>, BackendError> {
        if jobs.is_empty() {
            return Ok(Vec::new());
        }
        let pipeline = match self.trace.get() {
            Some(pipeline) => pipeline,
            None => {
                let pipeline = compiled(&self.device, "trace", trace_source())?;
                self.trace.get_or_init(|| pipeline)
            }
        };
        let cells = jobs.len() as u64;
        let storage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC;
        let [traces, readings] = guarded(&self.device, || {
            let traces = empty(&self.device, size_of::<Trace>() as u64 * cells, storage);
            [traces, empty(&self.device, 4 * u64::from(capacity) * cells, storage)]
        })?;
        let dispatch = |Portion { count, budget, begin }| TraceDispatch {
            schedule: Schedule::new(schedule),
            count,
            budget,
            begin,
            row: ROW * WORKGROUP,
            section: probe.section as u32,
            reading: probe.reading as u32,
            capacity,
            unused: 0,
        };
        let more = [&traces, &readings];
        let program = self.observing(pipeline, &more, &dispatch);
        let verdicts = self.drive::<_, Verdict>(jobs, &program, watch)?;
        let traces: Vec<Trace> = guarded(&self.device, || self.fetch(&traces))??;
        let readings: Vec<f32> = guarded(&self.device, || self.fetch(&readings))??;
        let of_cell = |((verdict, trace), readings): ((Verdict, &Trace), &[f32])| {
            let kept = trace.passages.min(capacity);
            analysis::Trace {
                verdict: verdict.widen(),
                readings: readings[..kept as usize].iter().map(|&value| f64::from(value)).collect(),
                left_out: trace.passages - kept,
                rebounds: trace.rebounds.longest,
            }
        };
        Ok(verdicts
            .into_iter()
            .zip(&traces)
            .zip(readings.chunks_exact(capacity as usize))
            .map(of_cell)
            .collect())
    }

    /// Follows one tile of trajectories with a kernel, in portions of bounded time.
    fn drive<D: Pod, R: Record>(
        &self,
        jobs: &[Job],
        program: &Program<'_, D>,
        watch: &dyn Watch,
    ) -> Result<Vec<R>, BackendError> {
        if jobs.is_empty() {
            return Ok(Vec::new());
        }
        let tile = guarded(&self.device, || Tile::<R>::new(self, program, jobs))?;
        let most = if self.software { SOFTWARE_ITERATIONS / program.iterations } else { HARDWARE_BUDGET };
        let mut budget = FIRST_BUDGET.min(most);
        let mut unfinished: Vec<u32> = (0..jobs.len() as u32).collect();
        let mut verdicts = Vec::new();
        let mut begin = 1;
        while !unfinished.is_empty() {
            if watch.cancelled() {
                return Err(BackendError::Cancelled);
            }
            let began = Instant::now();
            let portion = Portion { count: unfinished.len() as u32, budget, begin };
            verdicts = guarded(&self.device, || tile.dispatch(self, program, portion, &unfinished))??;
            let before = unfinished.len();
            unfinished.retain(|&cell| verdicts[cell as usize].is_pending());
            watch.finished((before - unfinished.len()) as u64);
            budget = next_budget(budget, began.elapsed(), most);
            begin = 0;
        }
        Ok(verdicts)
    }

    /// Reads a buffer of the device.
    fn fetch<T: Pod>(&self, buffer: &wgpu::Buffer) -> Result<Vec<T>, BackendError> {
        let readback =
            empty(&self.device, buffer.size(), wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_buffer_to_buffer(buffer, 0, &readback, 0, buffer.size());
        self.queue.submit([encoder.finish()]);
        self.mapped(&readback)
    }

    /// What is in a buffer that can be mapped, once everything submitted is done.
    fn mapped<T: Pod>(&self, readback: &wgpu::Buffer) -> Result<Vec<T>, BackendError> {
        let (sender, receiver) = mpsc::channel();
        readback.map_async(wgpu::MapMode::Read, .., move |result| {
            // The receiver is gone only if waiting failed, which is reported by itself.
            let _ = sender.send(result);
        });
        let device_error = |error: &dyn std::fmt::Display| BackendError::Device(error.to_string());
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| device_error(&error))?;
        receiver
            .recv()
            .map_err(|_| BackendError::Device("the device was lost".to_owned()))?
            .map_err(|error| device_error(&error))?;
        let values = {
            let mapped = readback.get_mapped_range(..).map_err(|error| device_error(&error))?;
            bytemuck::pod_collect_to_vec(&mapped)
        };
        readback.unmap();
        Ok(values)
    }
}

/// Compiles a kernel.
fn compiled(
    device: &wgpu::Device,
    name: &str,
    source: String,
) -> Result<wgpu::ComputePipeline, BackendError> {
    guarded(device, || {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(name),
            layout: None,
            module: &module,
            entry_point: Some(name),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        })
    })
}

fn empty(device: &wgpu::Device, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
}

/// The moves of the next dispatch, so that it takes about [`PORTION`]; at most twice the last.
fn next_budget(budget: u32, took: Duration, most: u32) -> u32 {
    let factor = (PORTION.as_secs_f64() / took.as_secs_f64().max(1e-6)).clamp(0.1, 2.0);
    ((f64::from(budget) * factor) as u32).clamp(1, most)
}

/// Runs something on a device, and turns what it refuses into an error instead of a panic.
fn guarded<R>(device: &wgpu::Device, work: impl FnOnce() -> R) -> Result<R, BackendError> {
    let invalid = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let result = work();
    let memory = pollster::block_on(memory.pop());
    let invalid = pollster::block_on(invalid.pop());
    match memory.or(invalid) {
        Some(error) => Err(BackendError::Device(error.to_string())),
        None => Ok(result),
    }
}

/// The buffers of one tile.
struct Tile<R> {
    record: PhantomData<R>,
    bind_group: wgpu::BindGroup,
    dispatch: wgpu::Buffer,
    unfinished: wgpu::Buffer,
    verdicts: wgpu::Buffer,
    readback: wgpu::Buffer,
}

impl<R: Record> Tile<R> {
    fn new<D: Pod>(kernel: &Kernel, program: &Program<'_, D>, jobs: &[Job]) -> Self {
        let device = &kernel.device;
        let constants: Vec<model::Flight<f32>> =
            jobs.par_iter().map(|job| model::Flight::new(&job.system).round()).collect();
        let flights: Vec<Flight> = constants.iter().map(Flight::new).collect();
        let kicks: Vec<Kick> = constants.iter().map(Kick::new).collect();
        let starts: Vec<[f32; 4]> = jobs.iter().map(|job| job.start.map(|value| value as f32)).collect();
        let pending = vec![R::PENDING; jobs.len()];
        let filled = |contents: &[u8], usage: wgpu::BufferUsages| {
            device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
        };
        let cells = jobs.len() as u64;
        let storage = wgpu::BufferUsages::STORAGE;
        let uniform = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let dispatch = empty(device, size_of::<D>() as u64, uniform);
        let flights = filled(bytemuck::cast_slice(&flights), storage);
        let kicks = filled(bytemuck::cast_slice(&kicks), storage);
        let starts = filled(bytemuck::cast_slice(&starts), storage);
        let unfinished = empty(device, 4 * cells, storage | wgpu::BufferUsages::COPY_DST);
        let observers = empty(device, program.state * cells, storage);
        let verdicts = filled(bytemuck::cast_slice(&pending), storage | wgpu::BufferUsages::COPY_SRC);
        let readback =
            empty(device, verdicts.size(), wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST);
        let buffers = [&dispatch, &flights, &kicks, &starts, &unfinished, &observers, &verdicts];
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(buffers.into_iter().chain(program.more.iter().copied()))
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &program.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Tile { record: PhantomData, bind_group, dispatch, unfinished, verdicts, readback }
    }

    /// One portion of moves for the unfinished trajectories; all the tile's verdicts come back.
    fn dispatch<D: Pod>(
        &self,
        kernel: &Kernel,
        program: &Program<'_, D>,
        portion: Portion,
        unfinished: &[u32],
    ) -> Result<Vec<R>, BackendError> {
        kernel.queue.write_buffer(&self.dispatch, 0, bytemuck::bytes_of(&(program.dispatch)(portion)));
        kernel.queue.write_buffer(&self.unfinished, 0, bytemuck::cast_slice(unfinished));
        let mut encoder = kernel.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(program.pipeline);
            pass.set_bind_group(0, &self.bind_group, &[]);
            let groups = portion.count.div_ceil(WORKGROUP);
            pass.dispatch_workgroups(groups.min(ROW), groups.div_ceil(ROW), 1);
        }
        encoder.copy_buffer_to_buffer(&self.verdicts, 0, &self.readback, 0, self.verdicts.size());
        kernel.queue.submit([encoder.finish()]);
        kernel.mapped(&self.readback)
    }
}
