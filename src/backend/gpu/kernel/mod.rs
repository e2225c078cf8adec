//! The kernel on its device: a tile of trajectories, dispatched in bounded portions until all are finished.

mod clock;
mod compiled;
mod control;
#[cfg(test)]
mod corrections;
mod device;
mod drive;
mod extent;
mod follow;
mod kept;
#[cfg(test)]
mod loops;
mod program;
mod reading;
mod room;
mod spent;
mod tile;
mod trace;

use parking_lot::{Mutex, MutexGuard};
use tokio::sync::Semaphore;

use super::adapters::Found;
use crate::backend::Result;
use crate::backend::gpu::shader::{Arithmetic, Residence, Space};
use crate::backend::in_flight::IN_FLIGHT;
use compiled::Library;
use device::device_error;
use kept::Kept;
pub use room::Batch;
pub use spent::Spent;
pub use trace::readings;

/// Trajectories of one tile.
const HARDWARE_TILE: usize = 1 << 18;
const SOFTWARE_TILE: usize = 1 << 15;

/// Tiles that are on hardware at a time: what the processor does for one takes longer than what a fast card does.
const ON_HARDWARE: usize = 3;

/// A device with the shaders compiled for it.
pub struct Kernel {
    device: wgpu::Device,
    queue: wgpu::Queue,
    library: Library,
    software: bool,
    tiles_at_a_time: usize,
    /// For the tiles that are on the device.
    room: Semaphore,
    /// For the tile that the processor prepares.
    turn: Mutex<()>,
    /// Of tiles that are done.
    kept: Kept,
    spent: Mutex<Spent>,
}

impl Kernel {
    /// Opens a device on the adapter.
    pub fn new(found: &Found, arithmetic: Arithmetic) -> Result<Self> {
        let offered = found.adapter.limits();
        let limits = wgpu::Limits {
            max_compute_workgroup_storage_size: offered.max_compute_workgroup_storage_size,
            max_storage_buffers_per_shader_stage: offered.max_storage_buffers_per_shader_stage,
            ..wgpu::Limits::default()
        };
        Kernel::within(limits, found, arithmetic)
    }

    /// The same, with a device that has no more room than that.
    pub fn within(required_limits: wgpu::Limits, found: &Found, arithmetic: Arithmetic) -> Result<Self> {
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("impact-atlas"),
            // Dispatches are timed without it too.
            required_features: found.adapter.features() & wgpu::Features::TIMESTAMP_QUERY,
            required_limits,
            ..wgpu::DeviceDescriptor::default()
        };
        let (device, queue) =
            pollster::block_on(found.adapter.request_device(&descriptor)).map_err(device_error)?;
        let software = found.report.is_software();
        let residence = if software { Residence::Private } else { Residence::Workgroup };
        let library = Library::new(residence, Space::of(software, &device.limits()), arithmetic);
        let tiles_at_a_time = if software { IN_FLIGHT } else { ON_HARDWARE };
        let room = Semaphore::new(tiles_at_a_time);
        let (turn, kept, spent) = (Mutex::default(), Kept::default(), Mutex::default());
        Ok(Kernel { device, queue, library, software, tiles_at_a_time, room, turn, kept, spent })
    }

    /// On the best adapter that there is; a software one will do.
    #[cfg(test)]
    fn on_any_adapter(arithmetic: Arithmetic) -> Self {
        let found = super::adapters::find(None).expect("an adapter");
        println!("{}", found.report);
        Kernel::new(&found, arithmetic).unwrap()
    }

    /// The same with the shaders of hardware.
    #[cfg(test)]
    pub fn with_shaders_of_hardware(self, arithmetic: Arithmetic) -> Self {
        Kernel { library: Library::new(Residence::Workgroup, Space::Uniform, arithmetic), ..self }
    }

    /// How many buffers are kept for tiles to come.
    #[cfg(test)]
    pub fn kept(&self) -> usize {
        self.kept.count()
    }

    /// Where time went since this was last asked.
    pub fn spent(&self) -> Spent {
        std::mem::take(&mut *self.spent.lock())
    }

    /// Adds to where time went.
    fn spend(&self, more: Spent) {
        *self.spent.lock() += more;
    }

    /// Waits for the turn to prepare cells. Prepared one tile after the other, each by all cores, the first is ready soonest, and the
    /// device need not wait for all that were begun. A thread of a pool does not wait: who has the turn may need it.
    pub(super) fn turn(&self) -> Option<MutexGuard<'_, ()>> {
        rayon::current_thread_index().is_none().then(|| self.turn.lock())
    }

    /// Tiles that are on the device together at most.
    pub fn tiles_at_a_time(&self) -> usize {
        self.tiles_at_a_time
    }

    /// Trajectories that are followed together at most.
    pub fn tile(&self) -> usize {
        if self.software { SOFTWARE_TILE } else { HARDWARE_TILE }
    }
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::thread;
    use std::time::Duration;

    use super::*;

    #[test]
    fn threads_of_their_own_wait_for_the_turn_and_those_of_a_pool_do_not() {
        let kernel = Kernel::on_any_adapter(Arithmetic::Native);
        let turn = kernel.turn();
        assert!(turn.is_some());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        assert!(pool.install(|| kernel.turn().is_none()));
        thread::scope(|scope| {
            let (sender, taken) = mpsc::channel();
            let kernel = &kernel;
            scope.spawn(move || sender.send(kernel.turn().is_some()));
            assert!(taken.recv_timeout(Duration::from_millis(100)).is_err(), "it is taken");
            drop(turn);
            assert_eq!(taken.recv(), Ok(true));
        });
    }
}
