//! What is asked of the device itself: to compile, to hold buffers, to read them back, and to say what it refuses.

use std::fmt::Display;
use std::sync::mpsc;

use bytemuck::Pod;

use crate::backend::{BackendError, Result};

/// The uses of a buffer through which the processor reads another.
pub const READBACK: wgpu::BufferUsages = wgpu::BufferUsages::MAP_READ.union(wgpu::BufferUsages::COPY_DST);

/// What is read of the first bytes of a buffer that can be mapped, once what was submitted is done; what others submitted since is
/// not waited for.
pub fn mapped<T: Pod, V>(
    device: &wgpu::Device,
    readback: &wgpu::Buffer,
    bytes: u64,
    submitted: &wgpu::SubmissionIndex,
    read: impl FnOnce(&[T]) -> V,
) -> Result<V> {
    let (sender, receiver) = mpsc::channel();
    readback.map_async(wgpu::MapMode::Read, ..bytes, move |result| {
        // The receiver is gone only if waiting failed, which is reported by itself.
        let _ = sender.send(result);
    });
    let done = wgpu::PollType::Wait { submission_index: Some(submitted.clone()), timeout: None };
    device.poll(done).map_err(device_error)?;
    receiver
        .recv()
        .map_err(|_| BackendError::Device("the device was lost".to_owned()))?
        .map_err(device_error)?;
    let value = {
        let mapped = readback.get_mapped_range(..bytes).map_err(device_error)?;
        read(bytemuck::cast_slice(&mapped))
    };
    readback.unmap();
    Ok(value)
}

/// Compiles a kernel.
pub fn compiled(
    device: &wgpu::Device,
    name: &str,
    source: wgpu::ShaderSource<'_>,
) -> Result<wgpu::ComputePipeline> {
    guarded(device, || {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(name), source });
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

/// A buffer of words that a kernel reads, in the parts that threads wrote.
pub fn filled(device: &wgpu::Device, parts: &[Vec<u32>]) -> Result<wgpu::Buffer> {
    let descriptor = wgpu::BufferDescriptor {
        label: None,
        size: parts.iter().map(|part| size_of_val(part.as_slice()) as u64).sum(),
        usage: wgpu::BufferUsages::STORAGE,
        mapped_at_creation: true,
    };
    let buffer = guarded(device, || device.create_buffer(&descriptor))?;
    let mut view = buffer.get_mapped_range_mut(..).map_err(device_error)?;
    let mut rest = view.slice(..);
    for part in parts {
        let bytes: &[u8] = bytemuck::cast_slice(part);
        rest.split_off(..bytes.len()).expect("the buffer holds all parts").copy_from_slice(bytes);
    }
    drop(view);
    guarded(device, || buffer.unmap())?;
    Ok(buffer)
}

pub fn empty(device: &wgpu::Device, size: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
}

/// What a device says it cannot do.
pub fn device_error(error: impl Display) -> BackendError {
    BackendError::Device(error.to_string())
}

/// Runs something on a device, and turns what it refuses into an error instead of a panic.
pub fn guarded<R>(device: &wgpu::Device, work: impl FnOnce() -> R) -> Result<R> {
    let invalid = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let result = work();
    let memory = pollster::block_on(memory.pop());
    let invalid = pollster::block_on(invalid.pop());
    match memory.or(invalid) {
        Some(error) => Err(device_error(error)),
        None => Ok(result),
    }
}
