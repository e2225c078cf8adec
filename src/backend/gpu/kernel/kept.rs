//! Buffers that one tile has written and the next may: a driver takes long to find room for them, and to give it back.

use parking_lot::Mutex;

use super::device::empty;

/// Buffers that nothing uses for now: no more of them than tiles used at a time. They are there as long as the kernel is, unless
/// room is needed.
#[derive(Default)]
pub struct Kept(Mutex<Vec<wgpu::Buffer>>);

impl Kept {
    /// A buffer of at least so many bytes for just those uses, whatever it holds: the smallest that is kept. Where they are too small,
    /// a new one takes the place of the smallest.
    pub fn take(&self, device: &wgpu::Device, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.find(usage, |buffer| buffer.size() >= bytes).unwrap_or_else(|| {
            // The lock is free: a driver takes its time.
            drop(self.find(usage, |_| true));
            empty(device, bytes, usage)
        })
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
    pub fn clear(&self) {
        let kept = std::mem::take(&mut *self.0.lock());
        drop(kept);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::backend::gpu::kernel::Kernel;
    use crate::backend::gpu::shader::Arithmetic;

    #[test]
    fn the_smallest_that_is_large_enough_is_taken() {
        let kernel = Kernel::on_any_adapter(Arithmetic::Native);
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
        assert_eq!((larger.size(), sizes()), (128, vec![32, 64]), "the smallest is let go of");
        assert_eq!(kept.take(device, 4, uniform), other);
    }
}
