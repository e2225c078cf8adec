//! What is read back from the device, and room on it for that and for anything else.

use bytemuck::Pod;

use super::Kernel;
use super::device::{READBACK, guarded, mapped};
use crate::backend::Result;

impl Kernel {
    /// Makes something that needs room on the device, again without what is kept if there is none.
    pub(super) fn with_room<R>(&self, make: impl Fn() -> Result<R>) -> Result<R> {
        let made = || guarded(&self.device, &make).and_then(|made| made);
        made().or_else(|refused| {
            if self.kept.count() == 0 {
                return Err(refused);
            }
            self.kept.clear();
            made()
        })
    }

    /// What is read of the first bytes of a buffer of the device.
    pub(super) fn read<T: Pod, V>(
        &self,
        buffer: &wgpu::Buffer,
        bytes: u64,
        read: impl FnOnce(&[T]) -> V,
    ) -> Result<V> {
        let readback = self.with_room(|| Ok(self.kept.take(&self.device, bytes, READBACK)))?;
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
    use super::super::device::{device_error, empty};
    use super::*;
    use crate::backend::gpu::shader::Arithmetic;

    #[test]
    fn what_is_kept_makes_room_for_what_has_none() {
        let kernel = Kernel::on_any_adapter(Arithmetic::Native);
        let storage = wgpu::BufferUsages::STORAGE;
        // A device without room for two of them.
        let make = || {
            let too_large = kernel.device.limits().max_buffer_size + 1;
            let bytes = if kernel.kept.count() == 0 { 64 } else { too_large };
            Ok(empty(&kernel.device, bytes, storage))
        };
        assert_eq!(kernel.with_room(make).unwrap().size(), 64);
        kernel.kept.keep([empty(&kernel.device, 4, storage)]);
        assert_eq!(kernel.with_room(make).unwrap().size(), 64);
        assert_eq!(kernel.kept.count(), 0);
        kernel.kept.keep([empty(&kernel.device, 4, storage)]);
        // An error that is told is one as well as what the device refuses.
        let told = || if kernel.kept.count() == 0 { Ok(()) } else { Err(device_error("no room")) };
        assert!(kernel.with_room(told).is_ok());
        let too_large = || Ok(empty(&kernel.device, kernel.device.limits().max_buffer_size + 1, storage));
        assert!(kernel.with_room(too_large).is_err());
    }
}
