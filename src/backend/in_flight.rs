//! Several tiles at a time: while one waits for a device, or for the last of its trajectories, another has the processor.

use std::iter;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::thread;

use parking_lot::Mutex;
use rayon::prelude::*;

/// How many at a time as a rule: what waits for one thing leaves room for one that does not.
pub(super) const IN_FLIGHT: usize = 2;

/// What work makes of each of some items, in their order. The items are begun in that order, `most` at a time, the next once
/// what came before is done with: on threads of rayon's pool where this is one of them, on threads of their own elsewhere, which
/// may wait.
///
/// # Errors
/// That of the first item that has one; only what was under way goes on to its end then.
pub(crate) fn in_flight<I, R, E>(
    most: usize,
    items: impl IntoIterator<Item = I, IntoIter: Send>,
    work: impl Fn(I) -> Result<R, E> + Sync,
) -> Result<Vec<R>, E>
where
    R: Send,
    E: Send,
{
    let items = items.into_iter();
    let is_one = items.size_hint().1.is_some_and(|most| most <= 1);
    let waiting = Mutex::new(Some((0_usize..).zip(items)));
    let follow = || {
        let mut done = Vec::new();
        loop {
            let Some((place, item)) = waiting.lock().as_mut().and_then(Iterator::next) else { break done };
            let result = catch_unwind(AssertUnwindSafe(|| work(item)));
            if !matches!(result, Ok(Ok(_))) {
                *waiting.lock() = None;
            }
            done.push((place, result));
        }
    };
    let mut done = match is_one {
        true => follow(),
        false => together(most, &follow).into_iter().flatten().collect(),
    };
    done.sort_unstable_by_key(|&(place, _)| place);
    done.into_iter().map(|(_, result)| result.unwrap_or_else(|panic| resume_unwind(panic))).collect()
}

/// The same, done by so many threads at once.
fn together<D: Send>(threads: usize, follow: &(impl Fn() -> D + Sync)) -> Vec<D> {
    if rayon::current_thread_index().is_some() {
        return (0..threads).into_par_iter().with_max_len(1).map(|_| follow()).collect();
    }
    thread::scope(|scope| {
        let others: Vec<_> = (1..threads).map(|_| scope.spawn(follow)).collect();
        let own = follow();
        let others =
            others.into_iter().map(|other| other.join().unwrap_or_else(|panic| resume_unwind(panic)));
        iter::once(own).chain(others).collect()
    })
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    use super::*;

    #[test]
    fn results_come_in_the_order_of_the_items() {
        for count in [0, 1, 2, 7, 100] {
            let squares = in_flight(IN_FLIGHT, 0..count, |i: usize| Ok::<_, ()>(i * i)).unwrap();
            assert!(squares.into_iter().eq((0..count).map(|i| i * i)), "{count}");
        }
    }

    #[test]
    fn on_a_thread_of_a_pool_all_is_done_by_the_pool() {
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let index = |_| Ok::<_, ()>(rayon::current_thread_index().map(|_| rayon::current_num_threads()));
            let found = pool.install(|| in_flight(IN_FLIGHT, 0..50, index)).unwrap();
            assert_eq!(found, [Some(threads); 50]);
        }
        assert_eq!(
            in_flight(IN_FLIGHT, 0..2, |_| Ok::<_, ()>(rayon::current_thread_index())),
            Ok(vec![None; 2])
        );
    }

    #[test]
    fn so_many_are_at_work_at_a_time_and_no_more() {
        for most in [2, 3, 5] {
            let (together, at_work) = (Barrier::new(most), AtomicUsize::new(0));
            let found = in_flight(most, 0..10 * most, |_| {
                let now = at_work.fetch_add(1, Ordering::SeqCst) + 1;
                // Comes back only once as many are here.
                together.wait();
                at_work.fetch_sub(1, Ordering::SeqCst);
                Ok::<_, ()>(now)
            });
            assert_eq!(found.unwrap().into_iter().max(), Some(most));
        }
    }

    #[test]
    fn the_first_error_ends_it() {
        let begun = AtomicUsize::new(0);
        let together = Barrier::new(IN_FLIGHT);
        let found = in_flight(IN_FLIGHT, 0..100, |i: usize| {
            begun.fetch_add(1, Ordering::SeqCst);
            if i < IN_FLIGHT {
                together.wait();
            }
            if i < 1 { Ok(i) } else { Err(i) }
        });
        assert_eq!(found, Err(1));
        assert!(begun.into_inner() <= 2 * IN_FLIGHT, "not all were begun");
    }

    #[test]
    fn a_panic_goes_on_where_it_was_asked_for() {
        for of in 0..2 {
            let (together, begun) = (Barrier::new(2), AtomicUsize::new(0));
            let found = catch_unwind(|| {
                in_flight(IN_FLIGHT, 0..10_000, |i: usize| {
                    begun.fetch_add(1, Ordering::SeqCst);
                    if i < 2 {
                        together.wait();
                    } else {
                        thread::sleep(Duration::from_millis(1));
                    }
                    assert!(i != of, "of {i}");
                    Ok::<_, ()>(())
                })
            });
            assert!(found.is_err() && begun.into_inner() < 10_000, "{of}");
        }
    }
}
