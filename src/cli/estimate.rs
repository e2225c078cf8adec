//! How long a plane will take, measured on some of its cells before the rest is begun.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::{Duration, Instant};

use impact_atlas::backend::{Backend, Watch};
use impact_atlas::model::Width;
use impact_atlas::plane::Plane;
use impact_atlas::sweep::{Swept, sample, spread};

use super::interrupt;
use super::progress::Progress;
use super::{CliError, Result, note, spans};

/// The most cells that are measured.
const MOST: u32 = 4096;

/// So many of them first where a device works on many at once.
const AT_ONCE: usize = 512;

/// No more than one cell in so many is measured.
const ONE_OF: u64 = 8;

/// Planes of fewer cells are not worth it.
const FEWEST: u64 = 64;

/// How long measuring should take …
const LONGEST: Duration = Duration::from_secs(1);

/// … and beyond the first cells no more than one part in so many of what it is estimated that all will take.
const PARTS: u32 = 64;

/// When those that are being measured are given up, each where its back end looks whether it should end. At most one cell in eight
/// is measured, so that all of them may take long then.
const DEADLINE: Duration = Duration::from_secs(2);

/// What will take longer than this is announced.
pub const WORTH_SAYING: Duration = Duration::from_secs(10);

/// Says how long a plane will take on a back end, if that is long.
pub fn of_plane<T: Swept>(what: &str, plane: &Plane<T>, backend: &dyn Backend) -> Result<()> {
    of_cells(what, [plane.x.count, plane.y.count], backend, |cells, watch| {
        sample(plane, backend, cells, watch).map(|found| found.len()).map_err(CliError::from)
    })
}

fn of_cells(
    what: &str,
    [columns, rows]: [u32; 2],
    backend: &dyn Backend,
    compute: impl Fn(&[u64], &dyn Watch) -> Result<usize>,
) -> Result<()> {
    let all = u64::from(columns) * u64::from(rows);
    if all < FEWEST {
        return Ok(());
    }
    let count = u32::try_from(all / ONE_OF).unwrap_or(MOST).min(MOST);
    let cells = spread(columns, rows, count);
    // A device works on many cells at once; a processor on as many as its threads have lanes, of f32 the most.
    let lanes = Width::widest().lanes::<f32>() * rayon::current_num_threads();
    let first = if backend.name() == "cpu" { lanes } else { AT_ONCE };
    if backend.name() != "cpu" {
        // A shader is compiled once, however many cells there are; drivers take seconds for it, or minutes.
        let _waiting = Progress::of_unknown("compiling the kernel");
        for cell in cells.chunks(1) {
            if compute(cell, &interrupt::Interruptible)? > 0 {
                break;
            }
        }
    }
    let began = Instant::now();
    let mut measured = 0;
    let mut parts: Vec<Part> = Vec::new();
    for some in doubling(&cells, first) {
        let announce = || {
            let least = Part { cells: some.len(), time: DEADLINE }.time_of(all);
            let (least, deadline) = (spans::words(least), spans::words(DEADLINE));
            let some = some.len();
            note(&format!("{what} may take {least} or more ({some} of {all} cells take over {deadline})"));
        };
        let began_with_these = Instant::now();
        let Some(_) = before(DEADLINE, announce, |watch| compute(some, watch))? else { return Ok(()) };
        measured += some.len();
        let part = Part { cells: some.len(), time: began_with_these.elapsed() };
        parts.push(part);
        // The next part is at least twice as large.
        let longest = LONGEST.min(part.time_of(all) / PARTS);
        if began.elapsed() + 2 * part.time > longest {
            break;
        }
    }
    let estimate = time_of_all(all, &parts);
    if estimate > WORTH_SAYING {
        let time = spans::words(estimate);
        note(&format!("{what} will take about {time} (measured on {measured} of {all} cells)"));
    }
    Ok(())
}

/// Cells that were measured at once.
#[derive(Clone, Copy, Debug)]
struct Part {
    cells: usize,
    time: Duration,
}

impl Part {
    /// How long so many cells take where each takes as long as one of these.
    fn time_of(self, cells: u64) -> Duration {
        self.time.mul_f64(cells as f64 / self.cells as f64)
    }
}

/// How long all cells take by parts of them, each larger than the one before. Towards the end of its cells most lanes wait for the
/// last of them, however many there are: that is left out of what one cell takes, as far as the first part and the last tell it,
/// but for no more than half of that, since the first may have to wait for more.
fn time_of_all(all: u64, parts: &[Part]) -> Duration {
    let (Some(first), Some(last)) = (parts.first(), parts.last()) else { return Duration::ZERO };
    let most = last.time_of(all);
    if last.cells <= first.cells {
        return most;
    }
    let further = Part { cells: last.cells - first.cells, time: last.time.saturating_sub(first.time) };
    further.time_of(all).clamp(most / 2, most)
}

/// A watch that ends a run once it is late.
#[derive(Debug)]
struct WhileInTime<'a>(&'a AtomicBool);

impl Watch for WhileInTime<'_> {
    fn cancelled(&self) -> bool {
        interrupt::requested() || self.0.load(Ordering::Acquire)
    }
}

/// Runs something until the deadline; then, at once, `announce`s that it takes longer, and gives nothing as soon as it ends,
/// which it does where it looks at its watch.
fn before<T>(
    deadline: Duration,
    announce: impl FnOnce() + Send,
    run: impl FnOnce(&WhileInTime) -> Result<T>,
) -> Result<Option<T>> {
    let is_late = AtomicBool::new(false);
    let result = thread::scope(|scope| {
        let (done, wait) = mpsc::channel::<()>();
        let is_late = &is_late;
        scope.spawn(move || {
            if wait.recv_timeout(deadline) == Err(RecvTimeoutError::Timeout) {
                if !interrupt::requested() {
                    announce();
                }
                is_late.store(true, Ordering::Release);
            }
        });
        let result = run(&WhileInTime(is_late));
        drop(done);
        result
    });
    interrupt::check()?;
    match result {
        Ok(_) | Err(CliError::Interrupted) if is_late.load(Ordering::Acquire) => Ok(None),
        result => result.map(Some),
    }
}

/// Parts of some cells, `first` of them in the first, each part at least twice as large as the one before.
fn doubling(cells: &[u64], first: usize) -> impl Iterator<Item = &[u64]> {
    let (mut rest, mut size) = (cells, first);
    std::iter::from_fn(move || {
        let count = if rest.len() < 3 * size { rest.len() } else { size };
        let (some, others) = rest.split_at(count);
        (rest, size) = (others, 2 * size);
        (count > 0).then_some(some)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_takes_too_long_is_announced_and_given_up() {
        let (limit, mut announced) = (Duration::from_millis(50), 0);
        let in_time = before(Duration::from_secs(1000), || announced += 1, |_| Ok(7));
        assert_eq!((in_time.unwrap(), announced), (Some(7), 0));
        let given_up = before(
            limit,
            || announced += 1,
            |watch| {
                while !watch.cancelled() {
                    thread::yield_now();
                }
                // The watch may be looked at before the announcement is made.
                thread::sleep(limit);
                Err::<(), _>(CliError::Interrupted)
            },
        );
        assert_eq!((given_up.unwrap(), announced), (None, 1));
        // What does not look at the watch is announced all the same; another error stays one.
        let late = before(
            limit,
            || announced += 1,
            |_| {
                thread::sleep(3 * limit);
                Ok(7)
            },
        );
        assert_eq!((late.unwrap(), announced), (None, 2));
        let failed = before(limit, || announced += 1, |_| Err::<(), _>(CliError::input(std::fmt::Error)));
        assert!(matches!(failed, Err(CliError::Input(_))));
        assert_eq!(announced, 2);
    }

    #[test]
    fn what_any_number_of_cells_waits_for_is_not_counted_for_each() {
        let part = |cells: usize, millis: u64| Part { cells, time: Duration::from_millis(millis) };
        let seconds = |parts: &[Part]| time_of_all(1_000_000, parts).as_secs_f64();
        assert_eq!(seconds(&[]), 0.0);
        assert_eq!(seconds(&[part(1000, 20)]), 20.0, "one part says no more");
        // 20 ms, and 20 µs for each cell; what lies between does not count.
        assert_eq!(seconds(&[part(1000, 40), part(2000, 999), part(5000, 120)]), 20.0);
        assert_eq!(seconds(&[part(1000, 20), part(5000, 100)]), 20.0);
        assert_eq!(seconds(&[part(1000, 90), part(5000, 100)]), 10.0, "the first waited for more");
        assert_eq!(seconds(&[part(1000, 10), part(5000, 100)]), 20.0, "the last was held up");
    }

    #[test]
    fn each_part_is_at_least_twice_the_one_before_and_none_is_missing() {
        for (all, first, sizes) in [
            (512, 32, vec![32, 64, 128, 288]),
            (512, 512, vec![512]),
            (95, 32, vec![95]),
            (96, 32, vec![32, 64]),
        ] {
            let cells: Vec<u64> = (0..all).collect();
            let parts: Vec<&[u64]> = doubling(&cells, first).collect();
            assert_eq!(parts.iter().map(|part| part.len()).collect::<Vec<_>>(), sizes);
            assert_eq!(parts.concat(), cells);
        }
    }
}
