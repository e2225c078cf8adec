//! Where a kernel reads what a dispatch is asked for.

/// How every kernel declares the parameters of a dispatch.
const UNIFORM: &str = "var<uniform> dispatch:";
/// The same in storage.
const STORAGE: &str = "var<storage, read> dispatch:";
/// The most storage buffers of a kernel whose parameters are one of them.
const BUFFERS: u32 = 9;

/// The address space of the parameters of a dispatch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Space {
    /// Hardware reads uniforms as fast as constants.
    Uniform,
    /// Mesa's software adapter takes a uniform that a kernel branches on for a constant of the kernel, and compiles the kernel again
    /// for every value of it: in each dispatch, since no two are alike, for seconds, and its memory grows meanwhile.
    Storage,
}

impl Space {
    /// What suits an adapter, which may be a software one, of a device with such limits.
    pub fn of(software: bool, limits: &wgpu::Limits) -> Self {
        let room = limits.max_storage_buffers_per_shader_stage >= BUFFERS;
        if software && room { Space::Storage } else { Space::Uniform }
    }

    /// The source of a kernel whose parameters are there.
    pub fn placed(self, source: String) -> String {
        match self {
            Space::Uniform => source,
            Space::Storage => source.replace(UNIFORM, STORAGE),
        }
    }
}

#[cfg(test)]
mod tests {
    use strum::VariantArray;

    use super::*;
    use crate::backend::gpu::shader::{self, Arithmetic, Kernel, Residence, Shape};

    #[test]
    fn no_kernel_has_a_uniform_where_its_parameters_are_stored() {
        let shape = Shape { coordinates: 2, normals: 1, stops: 2 };
        let mut most = 0;
        for &kernel in Kernel::VARIANTS {
            let source = shader::source(kernel, &shape, Residence::Private, Arithmetic::Native);
            assert_eq!(source.matches("var<uniform>").count(), 1, "{kernel:?}");
            assert_eq!(Space::Uniform.placed(source.clone()), source);
            let stored = Space::Storage.placed(source);
            assert!(!stored.contains("var<uniform>") && stored.contains(STORAGE), "{kernel:?}");
            most = most.max(stored.matches("var<storage").count());
        }
        assert_eq!(most, BUFFERS as usize);
    }
}
