//! Which jobs are followed together: a device binds no buffer beyond a size.

use std::hash::Hash;
use std::sync::Arc;

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::Kernel;
use crate::backend::gpu::shader::{self, Shape};
use crate::backend::{BackendError, Job, Result};

impl Kernel {
    /// Jobs in tiles, in their order: as many together as the kernel takes at most, and as the device can bind what it keeps of
    /// each, the constants of their flows, and so many bytes more of each.
    ///
    /// # Errors
    /// Where the jobs differ in shape, or their kernel cannot be compiled.
    pub fn tiles<'j, J: Sync>(
        &self,
        kernel: shader::Kernel,
        jobs: &'j [J],
        job: impl Fn(&J) -> &Job + Sync,
        more: u64,
    ) -> Result<Vec<&'j [J]>> {
        let Some(first) = jobs.first() else { return Ok(Vec::new()) };
        let shape = Shape::of(&job(first).system);
        check_shapes(&shape, jobs.par_iter().with_min_len(AT_ONCE).map(&job))?;
        let compiled = self.library.get(&self.device, kernel, shape)?;
        let binding = self.device.limits().max_storage_buffer_binding_size;
        let room = |bytes: u64| usize::try_from(binding / bytes.max(1)).unwrap_or(usize::MAX).max(1);
        let (cells, flows) = (self.tile().min(room(compiled.state.max(more))), room(compiled.flight));
        Ok(split(jobs, cells, flows, |j| Arc::as_ptr(job(j).system.of_flow()).addr()))
    }
}

/// Jobs that are worth a thread's turn.
const AT_ONCE: usize = 1 << 10;

/// Checks that all of some jobs have a shape.
///
/// # Errors
/// [`BackendError::Unsupported`] where one has another: a direction that turns parallel to another within a plane.
fn check_shapes<'j>(shape: &Shape, jobs: impl ParallelIterator<Item = &'j Job>) -> Result<()> {
    if jobs.all(|job| Shape::of(&job.system) == *shape) {
        return Ok(());
    }
    Err(BackendError::Unsupported(
        "the stops of these cells do not lie along the same number of directions everywhere: use --backend cpu"
            .to_owned(),
    ))
}

/// Items in parts of at most so many, and of at most so many groups: those with the same key.
fn split<J: Sync, K: Eq + Hash + Send>(
    items: &[J],
    most: usize,
    groups: usize,
    key: impl Fn(&J) -> K + Sync,
) -> Vec<&[J]> {
    items.chunks(most).flat_map(|items| split_by_groups(items, groups, &key)).collect()
}

/// Whether some items are of at most so many groups.
fn are_few<K: Eq + Hash + Send>(keys: impl ParallelIterator<Item = K>, groups: usize) -> bool {
    let few = |there: FxHashSet<K>| (there.len() <= groups).then_some(there);
    let told = keys.try_fold(FxHashSet::default, |mut there, key| {
        there.insert(key);
        few(there)
    });
    let all = told.try_reduce(FxHashSet::default, |mut there, more| {
        there.extend(more);
        few(there)
    });
    all.is_some()
}

/// Items in parts of at most so many groups.
fn split_by_groups<J: Sync, K: Eq + Hash + Send>(
    items: &[J],
    groups: usize,
    key: impl Fn(&J) -> K + Sync,
) -> Vec<&[J]> {
    let (mut parts, mut first, mut there) = (Vec::new(), 0, FxHashSet::default());
    if items.len() > groups && !are_few(items.par_iter().with_min_len(AT_ONCE).map(&key), groups) {
        for (next, item) in items.iter().enumerate() {
            let key = key(item);
            if there.len() == groups && !there.contains(&key) {
                parts.push(&items[first..next]);
                first = next;
                there.clear();
            }
            there.insert(key);
        }
    }
    parts.push(&items[first..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_are_counted_in_parts_as_in_one() {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().unwrap();
        // Each part of them has few groups, all together have ten.
        let keys = || (0..10_000).into_par_iter().with_max_len(500).map(|i| i / 1_000);
        let few = |groups| pool.install(|| are_few(keys(), groups));
        assert!(few(10) && few(11) && !few(9) && !few(1));
    }

    #[test]
    fn parts_hold_so_many_items_and_groups_and_no_more() {
        let items = [1, 1, 1, 1, 1, 2, 2, 3, 4, 4, 5, 6];
        let parts = |most, groups| split(&items, most, groups, |item| *item);
        assert_eq!(parts(100, 100), [&items[..]]);
        assert_eq!(parts(12, 6), [&items[..]]);
        assert_eq!(parts(3, 100), [&items[..3], &items[3..6], &items[6..9], &items[9..]]);
        assert_eq!(parts(100, 2), [&items[..7], &items[7..10], &items[10..]]);
        assert_eq!(parts(6, 2), [&items[..6], &items[6..8], &items[8..11], &items[11..]]);
        assert_eq!(parts(100, 1).len(), 6);
        assert_eq!(parts(1, 100).len(), 12);
        // In any order.
        assert_eq!(split(&[1, 2, 1, 2, 3, 1], 100, 2, |item| *item), [&[1, 2, 1, 2][..], &[3, 1]]);
        assert_eq!(split(&[7], 1, 1, |item| *item), [&[7]]);
    }
}
