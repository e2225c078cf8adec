//! Trajectories side by side in the registers of the processor, as many as it has room for.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};

use parking_lot::Mutex;
use rayon::Scope;

use super::follow::followed;
use crate::analysis::{Observer, Queue, Schedule, Seat, Verdict, follow_abreast};
use crate::backend::error::BackendError;
use crate::backend::job::Job;
use crate::backend::watch::Watch;
use crate::dynamics::Usage;
use crate::model::{AnyWidth, AtWidth, ByFlow, Flight, Flights, Lanes, Width};

/// Lets every thread take jobs from one queue, and follow as many at once as `width` has lanes. There is at least one job, and all of
/// them have N coordinates. Says how well the lanes were used, too.
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub(super) fn spread<T: AnyWidth, const N: usize>(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<(Vec<Verdict>, Usage), BackendError> {
    let taken = AtomicUsize::new(0);
    let usage = Mutex::new(Usage::default());
    let by_flow = ByFlow::of(jobs, |job| &job.system);
    let order = by_flow.order();
    let flights = Flights::<T, N>::of(by_flow);
    // A few are better followed by several threads whose lanes are half empty.
    let threads = rayon::current_num_threads().min(jobs.len().div_ceil(width.lanes::<T>().div_ceil(2)));
    let (sender, done) = mpsc::channel();
    let (taken, flights, order, used) = (&taken, &flights, &order[..], &usage);
    rayon::scope(|scope| {
        for _ in 0..threads {
            let done = sender.clone();
            let normals = jobs[0].system.normals();
            scope.spawn(move |scope| {
                let left = Vec::new();
                Line { jobs, flights, order, schedule, watch, taken, used, normals, done, left, scope }
                    .follow(width);
            });
        }
    });
    drop(sender);
    if watch.cancelled() {
        return Err(BackendError::Cancelled);
    }
    let mut verdicts: Vec<Option<Verdict>> = vec![None; jobs.len()];
    for (index, verdict) in done {
        verdicts[index] = Some(verdict);
    }
    let verdicts = verdicts.into_iter().collect::<Option<Vec<Verdict>>>().ok_or(BackendError::Cancelled)?;
    Ok((verdicts, usage.into_inner()))
}

/// What one thread takes from the jobs.
struct Line<'a, 'scope, T, const N: usize> {
    jobs: &'scope [Job],
    flights: &'scope Flights<T, N>,
    /// The jobs in the order in which they are taken: a lane has most constants of the next already.
    order: &'scope [u32],
    schedule: &'scope Schedule,
    watch: &'scope dyn Watch,
    /// Jobs that some thread has taken.
    taken: &'scope AtomicUsize,
    /// How well the lanes of all threads were used.
    used: &'scope Mutex<Usage>,
    /// Contact normals of the cells that fit.
    normals: usize,
    done: Sender<(usize, Verdict)>,
    /// Seats of trajectories that are done.
    left: Vec<Box<Seat<T, N, usize>>>,
    /// Where what would keep the other lanes waiting is left for any thread that has nothing else to do.
    scope: &'a Scope<'scope>,
}

impl<T: AnyWidth, const N: usize> Line<'_, '_, T, N> {
    fn follow(&mut self, width: Width) {
        width.compute::<T, _>(&mut *self);
        // What no lane took.
        while let Some(index) = self.take() {
            self.follow_alone(index);
        }
    }

    fn take(&self) -> Option<usize> {
        if self.watch.cancelled() {
            return None;
        }
        self.order.get(self.taken.fetch_add(1, Ordering::Relaxed)).map(|&index| index as usize)
    }

    fn follow_alone(&mut self, index: usize) {
        tell(&self.done, self.watch, index, followed::<T, N>(&self.jobs[index], self.schedule));
    }
}

/// Says what a job came to; nobody listens any more only where all was given up.
fn tell(done: &Sender<(usize, Verdict)>, watch: &dyn Watch, index: usize, verdict: Verdict) {
    let _ = done.send((index, verdict));
    watch.finished(1);
}

impl<T: AnyWidth, const N: usize> Queue<T, N> for Line<'_, '_, T, N> {
    type Ticket = usize;

    fn next(&mut self) -> Option<Box<Seat<T, N, usize>>> {
        let mut index = self.take()?;
        while self.jobs[index].system.normals() != self.normals {
            self.follow_alone(index);
            index = self.take()?;
        }
        let Job { system, start } = &self.jobs[index];
        let flow = self.flights.flow_of(index);
        let begun = |flight: &Flight<T, N>| Observer::new(flight, self.schedule, start.state());
        // What a trajectory and its constants lie in is large: that of one that is done is taken again.
        let Some(mut seat) = self.left.pop() else {
            let flight = self.flights.get(index, system);
            return Some(Box::new(Seat::new(index, flow, flight, begun(&flight))));
        };
        self.flights.put(index, system, seat.ticket, &mut seat.flight);
        (seat.ticket, seat.flow, seat.observer) = (index, flow, begun(&seat.flight));
        Some(seat)
    }

    fn hand_over(&mut self, mut seat: Box<Seat<T, N, usize>>) {
        let Line { jobs, schedule, watch, .. } = *self;
        let done = self.done.clone();
        self.scope.spawn(move |_| {
            if !watch.cancelled() {
                let Seat { ticket, flight, observer, .. } = &mut *seat;
                observer.follow(flight, schedule);
                let verdict = observer.verdict(flight, jobs[*ticket].system.label_order());
                tell(&done, watch, *ticket, verdict);
            }
        });
    }

    fn is_given_up(&self) -> bool {
        self.watch.cancelled()
    }

    fn used(&mut self, usage: Usage) {
        *self.used.lock() += usage;
    }

    fn done(&mut self, seat: Box<Seat<T, N, usize>>) {
        let verdict = seat.observer.verdict(&seat.flight, self.jobs[seat.ticket].system.label_order());
        tell(&self.done, self.watch, seat.ticket, verdict);
        self.left.push(seat);
    }
}

/// Lanes at work on it.
impl<T: AnyWidth, const N: usize> AtWidth<T> for &mut Line<'_, '_, T, N> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes<Real = T>>(self, zero: L) {
        follow_abreast(zero, self.normals, self.schedule, self);
    }
}
