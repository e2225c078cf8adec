//! The adapter's own clock.

use super::device::{READBACK, empty, mapped};
use crate::backend::Result;

/// Two readings.
const BYTES: u64 = 2 * size_of::<u64>() as u64;

/// The adapter's clock, read at the beginning and at the end of a dispatch.
pub struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    readback: wgpu::Buffer,
    /// Nanoseconds in a tick.
    tick: f32,
}

impl Clock {
    /// A clock, where the device offers one.
    pub fn of(device: &wgpu::Device, queue: &wgpu::Queue) -> Option<Self> {
        device.features().contains(wgpu::Features::TIMESTAMP_QUERY).then(|| Clock {
            queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                label: None,
                ty: wgpu::QueryType::Timestamp,
                count: 2,
            }),
            resolved: empty(device, BYTES, wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC),
            readback: empty(device, BYTES, READBACK),
            tick: queue.get_timestamp_period(),
        })
    }

    /// That a pass is to be timed.
    pub fn writes(&self) -> wgpu::ComputePassTimestampWrites<'_> {
        wgpu::ComputePassTimestampWrites {
            query_set: &self.queries,
            beginning_of_pass_write_index: Some(0),
            end_of_pass_write_index: Some(1),
        }
    }

    /// Brings back what was read, with what else is handed over.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
        encoder.copy_buffer_to_buffer(&self.resolved, 0, &self.readback, 0, BYTES);
    }

    /// The seconds of the last pass.
    pub fn took(&self, device: &wgpu::Device, submitted: &wgpu::SubmissionIndex) -> Result<f64> {
        let between = |readings: &[u64]| readings[1].saturating_sub(readings[0]);
        let ticks = mapped(device, &self.readback, BYTES, submitted, between)?;
        Ok(ticks as f64 * f64::from(self.tick) * 1e-9)
    }
}
