//! The kernel on its device: a tile of trajectories, dispatched in bounded portions until all are finished.

mod control;
mod device;
mod drive;
mod follow;
mod tile;
mod trace;

use std::sync::OnceLock;

use super::adapters::Found;
use super::shader::follow_source;
use crate::backend::BackendError;

use device::compiled;

/// Trajectories of one tile.
const HARDWARE_TILE: usize = 1 << 18;
const SOFTWARE_TILE: usize = 1 << 13;

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
}
