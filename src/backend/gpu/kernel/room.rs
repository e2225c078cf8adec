//! Which jobs are followed together: a device binds no buffer beyond a size.

use std::sync::Arc;

use super::Kernel;
use crate::backend::gpu::shader::{self, Shape};
use crate::backend::{Job, Result};

impl Kernel {
    /// Jobs in tiles, in their order: as many together as the kernel takes at most, and as the device can bind what it keeps of
    /// each, the constants of their flows, and so many bytes more of each.
    ///
    /// # Errors
    /// Where the kernel cannot be compiled.
    pub fn tiles<'j, J>(
        &self,
        kernel: shader::Kernel,
        jobs: &'j [J],
        job: impl Fn(&J) -> &Job,
        more: u64,
    ) -> Result<Vec<&'j [J]>> {
        let Some(first) = jobs.first() else { return Ok(Vec::new()) };
        let compiled = self.library.get(&self.device, kernel, Shape::of(&job(first).system))?;
        let binding = self.device.limits().max_storage_buffer_binding_size;
        let room = |bytes: u64| usize::try_from(binding / bytes.max(1)).unwrap_or(usize::MAX).max(1);
        let (cells, flows) = (self.tile().min(room(compiled.state.max(more))), room(compiled.flight));
        let shares = |a: &J, b: &J| Arc::ptr_eq(job(a).system.of_flow(), job(b).system.of_flow());
        Ok(split(jobs, cells, flows, shares))
    }
}

/// Items in parts of at most so many, and of at most so many groups: runs of items of which each has something in common with
/// the one before it.
fn split<J>(items: &[J], most: usize, groups: usize, shares: impl Fn(&J, &J) -> bool) -> Vec<&[J]> {
    let (mut parts, mut first, mut begun) = (Vec::new(), 0, 1);
    for next in 1..items.len() {
        let another = usize::from(!shares(&items[next - 1], &items[next]));
        if next - first == most || begun + another > groups {
            parts.push(&items[first..next]);
            (first, begun) = (next, 1);
        } else {
            begun += another;
        }
    }
    parts.push(&items[first..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_hold_so_many_items_and_groups_and_no_more() {
        let items = [1, 1, 1, 1, 1, 2, 2, 3, 4, 4, 5, 6];
        let parts = |most, groups| split(&items, most, groups, |a, b| a == b);
        assert_eq!(parts(100, 100), [&items[..]]);
        assert_eq!(parts(12, 6), [&items[..]]);
        assert_eq!(parts(3, 100), [&items[..3], &items[3..6], &items[6..9], &items[9..]]);
        assert_eq!(parts(100, 2), [&items[..7], &items[7..10], &items[10..]]);
        assert_eq!(parts(6, 2), [&items[..6], &items[6..8], &items[8..11], &items[11..]]);
        assert_eq!(parts(100, 1).len(), 6);
        assert_eq!(parts(1, 100).len(), 12);
        assert_eq!(split(&[7], 1, 1, |a, b| a == b), [&[7]]);
    }
}
