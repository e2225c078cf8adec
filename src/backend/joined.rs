//! Lists that are found several at a time, in one list.

use std::collections::BTreeMap;

use parking_lot::Mutex;
use rayon::prelude::*;

use super::in_flight::in_flight;

/// The lists that work makes of each of some items, one after the other in the order of the items, of so many elements altogether.
/// The work is done as by [`in_flight`]; meanwhile what is there is put together.
///
/// # Errors
/// As [`in_flight`].
pub(super) fn joined_in_flight<I: Send, R: Send, E: Send>(
    most: usize,
    length: usize,
    items: Vec<I>,
    work: impl Fn(I) -> Result<Vec<R>, E> + Sync,
) -> Result<Vec<R>, E> {
    let joined = Joined::of(length);
    in_flight(most, items.into_iter().enumerate(), |(place, item)| {
        joined.put(place, work(item)?);
        Ok(())
    })?;
    Ok(joined.into_whole())
}

/// Lists that come in any order.
struct Joined<R> {
    /// Of all of them together.
    length: usize,
    /// Those whose turn has not come.
    waiting: Mutex<BTreeMap<usize, Vec<R>>>,
    begun: Mutex<Begun<R>>,
}

/// Lists that are one.
struct Begun<R> {
    whole: Vec<R>,
    /// The place of the list that comes next.
    next: usize,
}

impl<R: Send> Joined<R> {
    /// Of so many elements; none is there.
    fn of(length: usize) -> Self {
        let begun = Begun { whole: Vec::new(), next: 0 };
        Joined { length, waiting: Mutex::default(), begun: Mutex::new(begun) }
    }

    /// Takes the list at a place. Nobody waits: where another puts lists together it may leave this one to whoever comes next.
    fn put(&self, place: usize, list: Vec<R>) {
        self.waiting.lock().insert(place, list);
        if let Some(mut begun) = self.begun.try_lock() {
            self.join(&mut begun);
        }
    }

    /// Puts together what is there.
    fn join(&self, Begun { whole, next }: &mut Begun<R>) {
        loop {
            // The lock is free again before anything is moved.
            let list = self.waiting.lock().remove(next);
            let Some(list) = list else { break };
            if whole.is_empty() && list.len() == self.length {
                *whole = list;
            } else {
                whole.reserve_exact(self.length.saturating_sub(whole.len()));
                whole.par_extend(list);
            }
            *next += 1;
        }
    }

    /// All of them.
    fn into_whole(self) -> Vec<R> {
        self.join(&mut self.begun.lock());
        self.begun.into_inner().whole
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Barrier;

    use super::*;

    #[test]
    fn lists_come_in_the_order_of_the_items() {
        for lengths in [vec![], vec![5], vec![0], vec![3, 0, 4, 1], vec![1; 100], vec![0, 7]] {
            let items: Vec<(usize, usize)> = lengths
                .iter()
                .scan(0, |first, &length| {
                    *first += length;
                    Some((*first - length, length))
                })
                .collect();
            let length = lengths.iter().sum();
            for most in [1, 3] {
                let work = |(first, length): (usize, usize)| Ok::<_, ()>((first..first + length).collect());
                let found = joined_in_flight(most, length, items.clone(), work).unwrap();
                assert!(found.into_iter().eq(0..length), "{lengths:?}, {most} at a time");
            }
        }
    }

    #[test]
    fn a_list_that_comes_late_keeps_its_place() {
        // The first is done once the second has been put, which is when the third begins.
        let third_begins = Barrier::new(2);
        let found = joined_in_flight(2, 6, vec![0, 1, 2], |i| {
            if i != 1 {
                third_begins.wait();
            }
            Ok::<_, ()>(vec![2 * i, 2 * i + 1])
        });
        assert_eq!(found, Ok(vec![0, 1, 2, 3, 4, 5]));
    }

    #[test]
    fn an_error_is_that_of_the_item() {
        let found = joined_in_flight(2, 3, vec![0, 1, 2], |i| if i == 1 { Err(i) } else { Ok(vec![i]) });
        assert_eq!(found, Err(1));
    }

    #[test]
    fn what_is_put_while_others_are_put_together_is_not_lost() {
        let joined = Joined::of(3);
        joined.put(2, vec![2]);
        joined.put(1, vec![1]);
        let busy = joined.begun.lock();
        joined.put(0, vec![0]);
        assert!(busy.whole.is_empty());
        drop(busy);
        assert_eq!(joined.into_whole(), [0, 1, 2]);
    }
}
