//! Buffers that one tile has written and the next may: a driver takes long to find room for them, and to give it back.

use bytemuck::Pod;
use parking_lot::Mutex;

use super::Kernel;
use super::device::{READBACK, empty, guarded, mapped};
use crate::backend::Result;

/// Buffers that nothing uses for now: no more of them than tiles used at a time. They are there as long as the kernel is, unless
/// room is needed.
#[derive(Default)]
pub struct Kept(Mutex<Vec<wgpu::Buffer>>);

impl Kept {
    /// A buffer of at least so many bytes for just those uses, whatever it holds: the smallest that is kept. Where they are too small,
    /// a new one takes the place of the smallest.
    pub fn take(&self, device: &wgpu::Device, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let fits = |buffer: &wgpu::Buffer| buffer.size() >= bytes;
        match self.find(usage, fits).or_else(|| self.find(usage, |_| true)) {
            Some(buffer) if fits(&buffer) => buffer,
            // The lock is free: a driver takes its time.
            too_small => {
                drop(too_small);
                empty(device, bytes, usage)
            }
        }
    }

    /// Takes the smallest that is kept for those uses, of some.
    fn find(&self, usage: wgpu::BufferUsages, fits: impl Fn(&wgpu::Buffer) -> bool) -> Option<wgpu::Buffer> {
        let mut kept = self.0.lock();
        let found = kept.iter().enumerate().filter(|(_, buffer)| buffer.usage() == usage && fits(buffer));
        let (place, _) = found.min_by_key(|(_, buffer)| buffer.size())?;
        Some(kept.swap_remove(place))
    }

    /// Keeps buffers that are in order: of those that a device refused none may come here.
    pub fn keep(&self, buffers: impl IntoIterator<Item = wgpu::Buffer>) {
        self.0.lock().extend(buffers);
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.lock().len()
    }

    /// Lets go of all of them.
    fn clear(&self) {
        let kept = std::mem::take(&mut *self.0.lock());
        drop(kept);
    }
}

impl Kernel {
    /// Makes something that needs room on the device, again without what is kept if there is none.
    pub(super) fn with_room<R>(&self, make: impl Fn() -> R) -> Result<R> {
        guarded(&self.device, &make).or_else(|refused| {
            if self.kept.count() == 0 {
                return Err(refused);
            }
            self.kept.clear();
            guarded(&self.device, &make)
        })
    }

    /// What is read of the first bytes of a buffer of the device.
    pub(super) fn read<T: Pod, V>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        read: impl FnOnce(&[T]) -> V,
    ) -> Result<V> {
        let readback = self.with_room(|| self.kept.take(&self.device, bytes, READBACK))?;
        let value = guarded(&self.device, || {
            let mut encoder = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            encoder.copy_buffer_to_buffer(buffer, 0, &readback, 0, bytes);
            let submitted = self.queue.submit([encoder.finish()]);
            mapped(&self.device, &readback, bytes, &submitted, read)
        })??;
        self.kept.keep([readback]);
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::gpu::adapters;
    use crate::backend::gpu::shader::Arithmetic;

    fn kernel() -> Kernel {
        let found = adapters::find(None).expect("an adapter");
        println!("{}", found.report);
        Kernel::new(&found, Arithmetic::Native).unwrap()
    }

    #[test]
    fn the_smallest_that_is_large_enough_is_taken() {
        let kernel = kernel();
        let (kept, device) = (&kernel.kept, &kernel.device);
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
        assert_eq!((larger.size(), sizes()), (128, vec![32, 64]), "the smallest is let go of");
        assert_eq!(kept.take(device, 4, uniform), other);
    }

    #[test]
    fn what_is_kept_makes_room_for_what_has_none() {
        let kernel = kernel();
        let storage = wgpu::BufferUsages::STORAGE;
        // A device without room for two of them.
        let make = || {
            let too_large = kernel.device.limits().max_buffer_size + 1;
            let bytes = if kernel.kept.count() == 0 { 64 } else { too_large };
            empty(&kernel.device, bytes, storage)
        };
        assert_eq!(kernel.with_room(make).unwrap().size(), 64);
        kernel.kept.keep([empty(&kernel.device, 4, storage)]);
        assert_eq!(kernel.with_room(make).unwrap().size(), 64);
        assert_eq!(kernel.kept.count(), 0);
        kernel.kept.keep([empty(&kernel.device, 4, storage)]);
        let too_large = || empty(&kernel.device, kernel.device.limits().max_buffer_size + 1, storage);
        assert!(kernel.with_room(too_large).is_err());
    }
}
