//! Kernels compiled for a shape, once each.

use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

use parking_lot::Mutex;
use wgpu::ShaderSource;

use super::device::compiled;
use crate::backend::gpu::shader::{self, Arithmetic, Residence, Shape, Space, WORKGROUP};
use crate::backend::{BackendError, Result};

/// A compiled kernel, and the sizes of what decides how many trajectories it has room for.
pub struct Compiled {
    pub pipeline: wgpu::ComputePipeline,
    /// Bytes of a trajectory's state.
    pub state: u64,
    /// Bytes of the constants of a flow.
    pub flight: u64,
}

/// Every kernel that was compiled so far.
pub struct Library {
    residence: Residence,
    space: Space,
    arithmetic: Arithmetic,
    compiled: Mutex<HashMap<(shader::Kernel, Shape), Arc<Compiled>>>,
}

impl Library {
    /// An empty library of kernels that keep the observer of a trajectory there, where there is room for it, have their parameters
    /// there, and compute so.
    pub fn new(residence: Residence, space: Space, arithmetic: Arithmetic) -> Self {
        Library { residence, space, arithmetic, compiled: Mutex::default() }
    }

    /// The kernel for a shape, compiled if it is needed for the first time.
    pub fn get(&self, device: &wgpu::Device, kernel: shader::Kernel, shape: Shape) -> Result<Arc<Compiled>> {
        let mut library = self.compiled.lock();
        if let Some(compiled) = library.get(&(kernel, shape)) {
            return Ok(compiled.clone());
        }
        let source =
            |residence| self.space.placed(shader::source(kernel, &shape, residence, self.arithmetic));
        let nearest = source(self.residence);
        let [state, flight, observer] = sizes(&nearest, [kernel.state(), "Flight", "Observer"]);
        let room = device.limits().max_compute_workgroup_storage_size;
        let source = if fit(observer, room) { nearest } else { source(Residence::Private) };
        let source = match self.arithmetic {
            Arithmetic::Native => ShaderSource::Wgsl(source.into()),
            Arithmetic::Exact => {
                ShaderSource::Naga(Cow::Owned(shader::exact(&source).map_err(BackendError::Device)?))
            }
        };
        let pipeline = compiled(device, kernel.entry(), source)?;
        let compiled = Arc::new(Compiled { pipeline, state, flight });
        library.insert((kernel, shape), compiled.clone());
        Ok(compiled)
    }
}

/// Whether as many observers of so many bytes as a workgroup has are not more than a device has room for; wgpu does not ask.
fn fit(observer: u64, room: u32) -> bool {
    u64::from(WORKGROUP) * observer <= u64::from(room)
}

/// The bytes of structs in an array, as their shader declares them; 0 where the shader is not valid, which compiling reports.
fn sizes<const K: usize>(source: &str, names: [&str; K]) -> [u64; K] {
    let Ok(module) = naga::front::wgsl::parse_str(source) else { return [0; K] };
    names.map(|name| {
        let ty = module.types.iter().find(|(_, ty)| ty.name.as_deref() == Some(name));
        ty.map_or(0, |(_, ty)| u64::from(ty.inner.size(module.to_ctx())))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::gpu::layout::NORMAL_TERMS;

    /// How many trajectories there is room for goes by these alone.
    #[test]
    fn nothing_of_a_trajectory_is_larger_than_its_state_and_nothing_of_a_flow_than_its_constants() {
        for (coordinates, normals) in (1..=4).flat_map(|n| (1..=4).map(move |normals| (n, normals))) {
            let shape = Shape { coordinates, normals, stops: 4 };
            for (kernel, others) in [
                (shader::Kernel::Follow, ["Cell", "Verdict", "Verdict"]),
                (shader::Kernel::Trace, ["Cell", "Verdict", "Trace"]),
                (shader::Kernel::Control, ["Cell", "Control", "Outcome"]),
                (shader::Kernel::Extent, ["Cell", "Extent", "Extent"]),
            ] {
                let source = shader::source(kernel, &shape, Residence::Workgroup, Arithmetic::Native);
                let [state, flight, of_kick] = sizes(&source, [kernel.state(), "Flight", "State"]);
                for (other, name) in sizes(&source, others).into_iter().zip(others) {
                    assert!(
                        0 < other && other <= state,
                        "{kernel:?}, {shape:?}: {name} {other}, state {state}"
                    );
                }
                let kicks = of_kick * (NORMAL_TERMS * normals) as u64;
                assert!(0 < kicks && kicks <= flight, "{shape:?}: kicks {kicks}, flight {flight}");
            }
        }
        assert_eq!(sizes("not a shader", ["State"]), [0]);
    }

    /// Nearly all hardware has 32 KiB, and every device half of that.
    #[test]
    fn observers_fit_into_the_memory_of_workgroups() {
        for (coordinates, stops) in (1..=4).flat_map(|n| (1..=4).map(move |stops| (n, stops))) {
            let shape = Shape { coordinates, normals: stops, stops };
            let source =
                shader::source(shader::Kernel::Follow, &shape, Residence::Workgroup, Arithmetic::Native);
            let [observer] = sizes(&source, ["Observer"]);
            println!("{shape:?}: {observer} bytes");
            assert!(fit(observer, 32 << 10) && !fit(observer, 2 << 10), "{shape:?}");
            assert_eq!(fit(observer, 16 << 10), coordinates <= 2, "{shape:?}");
        }
    }
}
