//! Which back end runs.

use super::{Backend, Cpu, CpuSingle, Gpu, Result};

/// Which back end is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Choice {
    /// A hardware GPU, otherwise the CPU.
    Auto,
    /// A hardware GPU, otherwise a software adapter.
    Gpu,
    /// Double precision on all cores; the reference.
    Cpu,
}

/// Opens a back end; `adapter` is a part of the wanted adapter's description, and asks for the GPU path.
///
/// Without a hardware GPU, `Auto` takes the CPU path: on the same cores a software adapter is not faster (see the
/// throughput example), and f64 is more exact.
///
/// # Errors
/// No adapter where one is asked for and none matches, and one that refuses a device or the shader.
pub fn open(choice: Choice, adapter: Option<&str>) -> Result<Box<dyn Backend>> {
    opened(choice, adapter, Box::new(Cpu), Gpu::open, Gpu::open_hardware)
}

/// The same with results that have the same bits on every adapter and on the CPU: in f32, every operation rounded correctly
/// and in the order of the source. On an adapter that takes longer; see [`Gpu::open_exact`] and [`CpuSingle`].
///
/// # Errors
/// As [`open()`].
pub fn open_reproducible(choice: Choice, adapter: Option<&str>) -> Result<Box<dyn Backend>> {
    opened(choice, adapter, Box::new(CpuSingle), Gpu::open_exact, Gpu::open_hardware_exact)
}

/// What is chosen of the CPU, of any adapter and of hardware.
fn opened(
    choice: Choice,
    adapter: Option<&str>,
    cpu: Box<dyn Backend>,
    any: fn(Option<&str>) -> Result<Gpu>,
    hardware: fn() -> Result<Option<Gpu>>,
) -> Result<Box<dyn Backend>> {
    match (choice, adapter) {
        (Choice::Cpu, _) => Ok(cpu),
        (Choice::Gpu, text) | (Choice::Auto, text @ Some(_)) => Ok(Box::new(any(text)?)),
        (Choice::Auto, None) => match hardware()? {
            Some(gpu) => Ok(Box::new(gpu)),
            None => Ok(cpu),
        },
    }
}
