//! The buffers of one tile of trajectories, and one dispatch of it.

use std::marker::PhantomData;
use std::sync::Arc;

use bytemuck::Pod;
use wgpu::util::DeviceExt;

use super::Kernel;
use super::compiled::Compiled;
use super::device::{empty, mapped};
use super::program::{Portion, Program, ROW};
use crate::backend::gpu::layout::{Cells, Record};
use crate::backend::gpu::shader::WORKGROUP;
use crate::backend::{BackendError, Job};

/// The buffers of one tile.
pub struct Tile<R> {
    record: PhantomData<R>,
    compiled: Arc<Compiled>,
    bind_group: wgpu::BindGroup,
    dispatch: wgpu::Buffer,
    unfinished: wgpu::Buffer,
    verdicts: wgpu::Buffer,
    readback: wgpu::Buffer,
}

impl<R: Record> Tile<R> {
    pub fn new<D: Pod>(
        kernel: &Kernel,
        compiled: Arc<Compiled>,
        program: &Program<'_, D>,
        jobs: &[&Job],
    ) -> Self {
        let device = &kernel.device;
        let Cells { flights, kicks, starts } = Cells::of(jobs);
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
        let observers = empty(device, compiled.state * cells, storage);
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
            layout: &compiled.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Tile { record: PhantomData, compiled, bind_group, dispatch, unfinished, verdicts, readback }
    }

    /// One portion of moves for the unfinished trajectories; all the tile's verdicts come back.
    pub fn dispatch<D: Pod>(
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
            pass.set_pipeline(&self.compiled.pipeline);
            pass.set_bind_group(0, &self.bind_group, &[]);
            let groups = portion.count.div_ceil(WORKGROUP);
            pass.dispatch_workgroups(groups.min(ROW), groups.div_ceil(ROW), 1);
        }
        encoder.copy_buffer_to_buffer(&self.verdicts, 0, &self.readback, 0, self.verdicts.size());
        kernel.queue.submit([encoder.finish()]);
        mapped(&kernel.device, &self.readback)
    }
}
