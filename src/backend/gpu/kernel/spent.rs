//! What the time of a device's work goes into.

use std::ops::AddAssign;
use std::time::Instant;

use serde::Serialize;

use super::device::fetch;
use crate::backend::BackendError;

/// Where time went, in seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Spent {
    /// Preparing the constants of cells, on the processor.
    pub preparing: f64,
    /// Bringing them to the adapter.
    pub transferring: f64,
    /// From handing a dispatch over until it is done and the list of what is unfinished is back.
    pub dispatching: f64,
    /// In the kernel itself, by the adapter's own clock; none where it offers none.
    pub kernel: Option<f64>,
    /// Reading the results back.
    pub reading: f64,
    /// Dispatches.
    pub dispatches: u64,
}

impl AddAssign for Spent {
    fn add_assign(&mut self, other: Self) {
        self.preparing += other.preparing;
        self.transferring += other.transferring;
        self.dispatching += other.dispatching;
        self.kernel = match (self.kernel, other.kernel) {
            (None, None) => None,
            (a, b) => Some(a.unwrap_or(0.0) + b.unwrap_or(0.0)),
        };
        self.reading += other.reading;
        self.dispatches += other.dispatches;
    }
}

/// What a piece of work gives, and the seconds that it takes.
pub fn timed<R>(work: impl FnOnce() -> R) -> (R, f64) {
    let began = Instant::now();
    let result = work();
    (result, began.elapsed().as_secs_f64())
}

/// The adapter's clock, read at the beginning and at the end of a dispatch.
pub struct Clock {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
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
            resolved: device.create_buffer(&wgpu::BufferDescriptor {
                label: None,
                size: 16,
                usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            }),
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

    /// Puts what was read where it can be fetched.
    pub fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        encoder.resolve_query_set(&self.queries, 0..2, &self.resolved, 0);
    }

    /// The seconds of the last pass.
    pub fn took(&self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<f64, BackendError> {
        let readings: Vec<u64> = fetch(device, queue, &self.resolved)?;
        let ticks = readings[1].saturating_sub(readings[0]);
        Ok(ticks as f64 * f64::from(self.tick) * 1e-9)
    }
}
