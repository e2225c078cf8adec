//! Kernels compiled for a shape, once each.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use parking_lot::Mutex;
use wgpu::ShaderSource;

use super::device::compiled;
use crate::backend::gpu::shader::{self, Arithmetic, Residence, Shape};
use crate::backend::{BackendError, Result};

/// A compiled kernel, and the size of what it keeps of a trajectory.
pub struct Compiled {
    pub pipeline: wgpu::ComputePipeline,
    /// Bytes of a trajectory's state.
    pub state: u64,
}

/// Every kernel that was compiled so far.
pub struct Library {
    residence: Residence,
    arithmetic: Arithmetic,
    compiled: Mutex<HashMap<(shader::Kernel, Shape), Arc<Compiled>>>,
}

impl Library {
    /// An empty library of kernels that keep the constants of a cell there, and compute so.
    pub fn new(residence: Residence, arithmetic: Arithmetic) -> Self {
        Library { residence, arithmetic, compiled: Mutex::default() }
    }

    /// The kernel for a shape, compiled if it is needed for the first time.
    pub fn get(&self, device: &wgpu::Device, kernel: shader::Kernel, shape: Shape) -> Result<Arc<Compiled>> {
        let mut library = self.compiled.lock();
        if let Some(compiled) = library.get(&(kernel, shape)) {
            return Ok(compiled.clone());
        }
        let source = shader::source(kernel, &shape, self.residence, self.arithmetic);
        let state = size_of_state(&source, kernel.state());
        let source = match self.arithmetic {
            Arithmetic::Native => ShaderSource::Wgsl(source.into()),
            Arithmetic::Exact => {
                ShaderSource::Naga(Cow::Owned(shader::exact(&source).map_err(BackendError::Device)?))
            }
        };
        let pipeline = compiled(device, kernel.entry(), source)?;
        let compiled = Arc::new(Compiled { pipeline, state });
        library.insert((kernel, shape), compiled.clone());
        Ok(compiled)
    }
}

/// The bytes of a struct in an array, as its shader declares it; 0 where the shader is not valid, which compiling reports.
fn size_of_state(source: &str, name: &str) -> u64 {
    let Ok(module) = naga::front::wgsl::parse_str(source) else { return 0 };
    let ty = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
    ty.map_or(0, |(_, ty)| u64::from(ty.inner.size(module.to_ctx())))
}
