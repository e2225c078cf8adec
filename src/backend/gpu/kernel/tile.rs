//! The buffers of one tile of trajectories, and one dispatch of it.

use std::num::NonZero;
use std::sync::Arc;

use bytemuck::Pod;

use super::Kernel;
use super::clock::Clock;
use super::compiled::Compiled;
use super::device::{READBACK, empty, filled, mapped};
use super::program::{Portion, Program, ROW};
use crate::backend::Result;
use crate::backend::gpu::layout::{Cells, FINISHED};
use crate::backend::gpu::shader::WORKGROUP;

/// The buffers of one tile.
pub struct Tile {
    compiled: Arc<Compiled>,
    bind_group: wgpu::BindGroup,
    dispatch: wgpu::Buffer,
    unfinished: wgpu::Buffer,
    states: wgpu::Buffer,
    results: wgpu::Buffer,
    readback: wgpu::Buffer,
    clock: Option<Clock>,
}

impl Tile {
    /// The buffers of so many cells, with a result of so many bytes for each.
    pub fn new<D: Pod>(
        kernel: &Kernel,
        compiled: Arc<Compiled>,
        program: &Program<'_, D>,
        Cells { flights, kicks, cells, .. }: &Cells,
        count: usize,
        result: u64,
    ) -> Result<Self> {
        let device = &kernel.device;
        let storage = wgpu::BufferUsages::STORAGE;
        let count = count as u64;
        let (reads, writes) = (wgpu::BufferUsages::COPY_SRC, wgpu::BufferUsages::COPY_DST);
        let dispatch = empty(device, size_of::<D>() as u64, wgpu::BufferUsages::UNIFORM | storage | writes);
        let flights = filled(device, flights)?;
        let kicks = filled(device, kicks)?;
        let cells = filled(device, cells)?;
        let take = |bytes: u64, usage| kernel.kept.take(device, bytes, usage);
        let [of_list, of_states, of_results] = [4, compiled.state, result].map(|bytes| bytes * count);
        let unfinished = take(of_list, storage | reads | writes);
        let states = take(of_states, storage);
        let results = take(of_results, storage | reads);
        let readback = take(of_list, READBACK);
        let whole = [&dispatch, &flights, &kicks, &cells].map(wgpu::Buffer::as_entire_binding);
        // Those that are kept may be longer.
        let parts = [(&unfinished, of_list), (&states, of_states), (&results, of_results)];
        let parts = parts.map(|(buffer, bytes)| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer,
                offset: 0,
                size: NonZero::new(bytes),
            })
        });
        let more = program.more.iter().map(|buffer| buffer.as_entire_binding());
        let entries: Vec<wgpu::BindGroupEntry<'_>> = (0..)
            .zip(whole.into_iter().chain(parts).chain(more))
            .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource })
            .collect();
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &compiled.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let clock = Clock::of(device, &kernel.queue);
        Ok(Tile { compiled, bind_group, dispatch, unfinished, states, results, readback, clock })
    }

    /// One portion of moves for the unfinished trajectories; those that are still unfinished, and the
    /// seconds of the kernel where the adapter has a clock.
    pub fn dispatch<D: Pod>(
        &self,
        kernel: &Kernel,
        program: &Program<'_, D>,
        portion: Portion,
        unfinished: &[u32],
    ) -> Result<(Vec<u32>, Option<f64>)> {
        kernel.queue.write_buffer(&self.dispatch, 0, bytemuck::bytes_of(&(program.dispatch)(portion)));
        kernel.queue.write_buffer(&self.unfinished, 0, bytemuck::cast_slice(unfinished));
        let mut encoder = kernel.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: None,
                timestamp_writes: self.clock.as_ref().map(Clock::writes),
            });
            pass.set_pipeline(&self.compiled.pipeline);
            pass.set_bind_group(0, &self.bind_group, &[]);
            let groups = portion.count.div_ceil(WORKGROUP);
            pass.dispatch_workgroups(groups.min(ROW), groups.div_ceil(ROW), 1);
        }
        if let Some(clock) = &self.clock {
            clock.resolve(&mut encoder);
        }
        let bytes = 4 * u64::from(portion.count);
        encoder.copy_buffer_to_buffer(&self.unfinished, 0, &self.readback, 0, bytes);
        let submitted = kernel.queue.submit([encoder.finish()]);
        let unfinished = |cells: &[u32]| cells.iter().copied().filter(|&cell| cell != FINISHED).collect();
        let left = mapped(&kernel.device, &self.readback, bytes, &submitted, unfinished)?;
        let took = self.clock.as_ref().map(|clock| clock.took(&kernel.device, &submitted)).transpose()?;
        Ok((left, took))
    }

    /// The results of all its trajectories; what else it had is for others now.
    pub fn into_results(self, kernel: &Kernel) -> wgpu::Buffer {
        kernel.kept.keep([self.unfinished, self.states, self.readback]);
        self.results
    }
}
