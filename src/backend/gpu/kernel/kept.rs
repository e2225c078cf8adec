//! Buffers that one tile has written and the next may: a driver takes long to find room for them, and to give it back.

use bytemuck::Pod;
use parking_lot::Mutex;

use super::Kernel;
use super::device::{READBACK, empty, guarded, mapped};
use crate::backend::Result;

/// Buffers that nothing uses for now: no more of them than were used at a time.
#[derive(Default)]
pub struct Kept(Mutex<Vec<wgpu::Buffer>>);

impl Kept {
    /// A buffer of at least so many bytes for just those uses, whatever it holds: the smallest that is kept, or a new one where they
    /// are too small. Those are let go of then.
    pub fn take(&self, device: &wgpu::Device, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let mut kept = self.0.lock();
        let is_for_it = |buffer: &wgpu::Buffer| buffer.usage() == usage;
        let fits = |(_, buffer): &(usize, &wgpu::Buffer)| is_for_it(buffer) && buffer.size() >= bytes;
        let nearest = kept.iter().enumerate().filter(fits).min_by_key(|(_, buffer)| buffer.size());
        if let Some((place, _)) = nearest {
            return kept.swap_remove(place);
        }
        kept.retain(|buffer| !is_for_it(buffer));
        empty(device, bytes, usage)
    }

    /// Keeps buffers that are in order: of those that a device refused none may come here.
    pub fn keep(&self, buffers: impl IntoIterator<Item = wgpu::Buffer>) {
        self.0.lock().extend(buffers);
    }
}

impl Kernel {
    /// What is read of the first bytes of a buffer of the device.
    pub(super) fn read<T: Pod, V>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        read: impl FnOnce(&[T]) -> V,
    ) -> Result<V> {
        let (value, readback) = guarded(&self.device, || {
            let readback = self.kept.take(&self.device, bytes, READBACK);
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &readback, 0, bytes);
            let submitted = self.queue.submit([encoder.finish()]);
            mapped(&self.device, &readback, bytes, &submitted, read).map(|value| (value, readback))
        })??;
        self.kept.keep([readback]);
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::gpu::adapters;
    use crate::backend::gpu::kernel::Kernel;
    use crate::backend::gpu::shader::Arithmetic;

    #[test]
    fn the_smallest_that_is_large_enough_is_taken() {
        let found = adapters::find(None).expect("an adapter");
        println!("{}", found.report);
        let kernel = Kernel::new(&found, Arithmetic::Native).unwrap();
        let (kept, device) = (Kept::default(), &kernel.device);
        let (storage, uniform) = (wgpu::BufferUsages::STORAGE, wgpu::BufferUsages::UNIFORM);
        let sizes = || -> Vec<u64> { kept.0.lock().iter().map(wgpu::Buffer::size).collect() };
        let [large, small] = [64, 16].map(|bytes| kept.take(device, bytes, storage));
        let other = kept.take(device, 32, uniform);
        kept.keep([large.clone(), small.clone(), other.clone()]);
        assert_eq!(kept.take(device, 12, storage), small);
        assert_eq!(kept.take(device, 12, storage), large, "it is the only one left");
        assert_eq!(sizes(), [32], "what was taken is not kept");
        kept.keep([small, large]);
        let larger = kept.take(device, 128, storage);
        assert_eq!((larger.size(), sizes()), (128, vec![32]), "what is too small is let go of");
        assert_eq!(kept.take(device, 4, uniform), other);
    }
}
