//! Which jobs are followed together: a device binds no buffer beyond a size.
//!
//! A batch is what becomes a [`Tile`](super::tile::Tile) on the device: as a rule a whole tile of jobs.

use rayon::prelude::*;
use rustc_hash::FxHashSet;

use super::Kernel;
use super::spent::{Spent, timed};
use crate::backend::gpu::followed::Followed;
use crate::backend::gpu::shader::{self, Shape};
use crate::backend::{BackendError, Result};
use crate::model::{ByFlow, System};

/// Jobs that are followed together.
pub struct Batch<'j, F> {
    /// The jobs, all of one shape.
    pub jobs: &'j [F],
    /// Which of them are known to have their flow in common.
    pub known: ByFlow<'j>,
}

impl<'j, F: Followed> Batch<'j, F> {
    /// Some jobs.
    pub fn of(jobs: &'j [F]) -> Self {
        Batch { jobs, known: ByFlow::known(jobs, |job| &job.job().system) }
    }
}

impl Kernel {
    /// Jobs in tiles, in their order: as many together as the kernel takes at most, and as the device can bind what it keeps of
    /// each, which is told by the first of them, and so many bytes more of each.
    ///
    /// # Errors
    /// Where their kernel cannot be compiled.
    pub fn tiles<'j, F: Followed>(
        &self,
        kernel: shader::Kernel,
        jobs: &'j [F],
        more: u64,
    ) -> Result<Vec<&'j [F]>> {
        let Some(first) = jobs.first() else { return Ok(Vec::new()) };
        let compiled = self.library.get(&self.device, kernel, Shape::of(&first.job().system))?;
        Ok(jobs.chunks(self.tile().min(self.bound(compiled.state.max(more)))).collect())
    }

    /// A tile in batches, in their order, of which the device can bind the constants of all flows: one as a rule.
    ///
    /// # Errors
    /// Where the jobs differ in shape, or their kernel cannot be compiled.
    pub fn batches<'j, F: Followed>(
        &self,
        kernel: shader::Kernel,
        tile: &'j [F],
    ) -> Result<Vec<Batch<'j, F>>> {
        let Some(first) = tile.first() else { return Ok(Vec::new()) };
        let shape = Shape::of(&first.job().system);
        let most = self.bound(self.library.get(&self.device, kernel, shape)?.flight);
        let _turn = self.turn();
        let (batches, preparing) = timed(|| {
            let all = Batch::of(tile);
            check_shapes(&shape, &all.known.distinct)?;
            if all.known.distinct.len() <= most {
                return Ok(vec![all]);
            }
            Ok(split_by_groups(tile, &all.known.of_cell, most).into_iter().map(Batch::of).collect())
        });
        self.spend(Spent { preparing, ..Spent::default() });
        batches
    }

    /// How many records of so many bytes the device can bind; one at least.
    fn bound(&self, bytes: u64) -> usize {
        let binding = self.device.limits().max_storage_buffer_binding_size;
        usize::try_from(binding / bytes.max(1)).unwrap_or(usize::MAX).max(1)
    }
}

/// Checks that all of some systems have a shape.
///
/// # Errors
/// [`BackendError::Unsupported`] where one has another: a direction that turns parallel to another within a plane.
fn check_shapes(shape: &Shape, systems: &[&System]) -> Result<()> {
    if systems.par_iter().all(|system| Shape::of(system) == *shape) {
        return Ok(());
    }
    Err(BackendError::Unsupported(
        "the stops of these cells do not lie along the same number of directions everywhere: use --backend cpu"
            .to_owned(),
    ))
}

/// Items in parts of at most so many groups, of which each item has the number of its own.
fn split_by_groups<'i, I>(items: &'i [I], group_of: &[u32], most: usize) -> Vec<&'i [I]> {
    let (mut parts, mut first, mut there) = (Vec::new(), 0, FxHashSet::default());
    for (next, group) in group_of.iter().enumerate() {
        if there.len() == most && !there.contains(group) {
            parts.push(&items[first..next]);
            first = next;
            there.clear();
        }
        there.insert(group);
    }
    parts.push(&items[first..]);
    parts
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Setting;
    use crate::system::Family;

    #[test]
    fn systems_of_another_shape_are_refused() {
        let [one, two] = ["shaw-holmes", "luo-ma-lv"]
            .map(|name| System::new(Setting::defaults(Family::builtin(name))).unwrap());
        let shape = Shape::of(&one);
        assert!(check_shapes(&shape, &[&one, &one]).is_ok());
        let refused = check_shapes(&shape, &[&one, &two]);
        assert!(matches!(refused, Err(BackendError::Unsupported(why)) if why.contains("--backend cpu")));
    }

    #[test]
    fn parts_hold_so_many_groups_and_no_more() {
        let items = [1, 1, 1, 1, 1, 2, 2, 3, 4, 4, 5, 6];
        let parts = |most| split_by_groups(&items, &items, most);
        assert_eq!(parts(6), [&items[..]]);
        assert_eq!(parts(2), [&items[..7], &items[7..10], &items[10..]]);
        assert_eq!(parts(1).len(), 6);
        // In any order.
        let items = [1, 2, 1, 2, 3, 1];
        assert_eq!(split_by_groups(&items, &items, 2), [&[1, 2, 1, 2][..], &[3, 1]]);
        assert_eq!(split_by_groups(&[7], &[0], 1), [&[7]]);
    }
}
