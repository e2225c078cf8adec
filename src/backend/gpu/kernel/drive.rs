//! The driver of every kernel: a tile dispatched in portions of bounded time until all of it is finished.

use bytemuck::Pod;
use pollster::block_on;

use super::Kernel;
use super::device::guarded;
use super::program::{Portion, Program};
use super::room::Batch;
use super::spent::{Spent, timed};
use super::tile::Tile;
use crate::analysis::constants::SQUARINGS;
use crate::backend::gpu::followed::Followed;
use crate::backend::gpu::layout::{Cells, NORMAL_TERMS};
use crate::backend::gpu::shader::Shape;
use crate::backend::{Result, Watch};
use crate::dynamics::constants::SQUEEZES;
use crate::model::Real;
use crate::model::vector::MOST;

/// How many seconds one dispatch should take; a display driver kills one of a few.
const PORTION: f64 = 0.2;
/// Moves of the first dispatch, before its speed is known.
const FIRST_BUDGET: u32 = 32;
/// How many times as many moves the next may have: each dispatch waits for the one before, and the time that a move takes differs
/// by a factor of a few at most.
const MOST_GROWTH: f64 = 16.0;
/// The most moves of one dispatch on hardware.
const HARDWARE_BUDGET: u32 = 1 << 14;
/// Loop iterations in one move: its own loop, every place where a series is summed, more of them the more contact normals there are,
/// and the impacts of a squeeze. Lanes that diverge go through all of them, one after the other. A test counts them in the shader.
pub const MOVE: u32 = 1 + 36 * <f32 as Real>::ORDER as u32 + SQUEEZES;
/// Loop iterations in which a dispatch fetches the constants of a cell.
pub const FETCH: u32 = ((MOST + 1) * NORMAL_TERMS) as u32;
/// Loop iterations of one dispatch on a software adapter, beside those: Mesa's stop every loop in silence after 65,535 iterations
/// of all the loops in an invocation. (The kernel counts a trajectory that was cut short as failed.)
const SOFTWARE_ITERATIONS: u32 = 65_535 - FETCH;

/// Loop iterations in what a strobe may ask for: the squares of a motion's monodromy matrix, for its largest multiplier and for
/// where its returns lead.
pub const SQUARES: u32 = 2 * (SQUARINGS + 1);

impl Kernel {
    /// Follows one of [`Kernel::batches`] with a kernel, in portions of bounded time; what is read of the results.
    pub(super) fn drive<F: Followed, D: Pod, R: Pod, V>(
        &self,
        Batch { jobs, known }: Batch<'_, F>,
        program: &Program<'_, D>,
        watch: &dyn Watch,
        read: impl FnOnce(&[R]) -> V,
    ) -> Result<V> {
        let compiled = self.library.get(&self.device, program.kernel, Shape::of(&jobs[0].job().system))?;
        let turn = self.turn();
        watch.check()?;
        let (mut cells, preparing) = timed(|| Cells::of(jobs, &known.compared()));
        let mut unfinished = std::mem::take(&mut cells.order);
        // Nothing waits for other threads while it has room. Constants are large: outside of a pool, one alone of those that are
        // prepared waits for it.
        let room = block_on(self.room.acquire());
        drop(turn);
        let holding =
            || Tile::new(self, compiled.clone(), program, &cells, jobs.len(), size_of::<R>() as u64);
        let (tile, transferring) = timed(|| self.with_room(holding));
        let tile = tile?;
        // The device has them.
        drop(cells);
        self.spend(Spent { preparing, transferring, ..Spent::default() });
        let most = if self.software { SOFTWARE_ITERATIONS / program.iterations } else { HARDWARE_BUDGET };
        let mut budget = FIRST_BUDGET.min(most);
        let mut begin = 1;
        while !unfinished.is_empty() {
            watch.check()?;
            let portion = Portion { count: unfinished.len() as u32, budget, begin };
            let before = unfinished.len();
            let dispatch = || tile.dispatch(self, program, portion, &unfinished);
            let (done, dispatching) = timed(|| guarded(&self.device, dispatch));
            let (left, kernel) = done??;
            unfinished = left;
            self.spend(Spent { dispatching, kernel, dispatches: 1, ..Spent::default() });
            watch.finished((before - unfinished.len()) as u64);
            // By the adapter's own clock a kernel does not wait for that of another tile; but a clock may be wrong.
            let took = kernel.unwrap_or(dispatching).max(dispatching / (2 * self.tiles_at_a_time) as f64);
            budget = next_budget(budget, took, most);
            begin = 0;
        }
        let results = tile.into_results(self);
        drop(room);
        let (found, reading) = timed(|| self.read(&results, (size_of::<R>() * jobs.len()) as u64, read));
        self.spend(Spent { reading, ..Spent::default() });
        let found = found?;
        self.kept.keep([results]);
        Ok(found)
    }
}

/// The moves of the next dispatch, so that it takes about [`PORTION`]; at most [`MOST_GROWTH`] times the last.
fn next_budget(budget: u32, took: f64, most: u32) -> u32 {
    let factor = (PORTION / took.max(1e-6)).clamp(0.1, MOST_GROWTH);
    ((f64::from(budget) * factor) as u32).clamp(1, most)
}
