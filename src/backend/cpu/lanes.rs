//! Trajectories side by side in the registers of the processor, as many as it has room for.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, Sender};

use parking_lot::Mutex;
use rayon::Scope;

use super::each::each;
use super::follow::follow;
use crate::analysis::{Observer, Queue, Schedule, Seat, Verdict, follow_abreast};
use crate::backend::error::BackendError;
use crate::backend::job::Job;
use crate::backend::watch::Watch;
use crate::dynamics::Usage;
use crate::model::{AtWidth, ByFlow, Flight, Flights, Lanes, System, Width};

/// See [`follow_counted`].
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub fn follow_all(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<Vec<Verdict>, BackendError> {
    follow_counted(jobs, schedule, watch, width).map(|(verdicts, _)| verdicts)
}

/// Follows every job in f64, `width` trajectories at once on each thread of rayon's current pool; one by one where they have not
/// equally many coordinates. Says how well the lanes were used, too.
///
/// # Errors
/// [`BackendError::Cancelled`] when the watch asked for it.
pub fn follow_counted(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<(Vec<Verdict>, Usage), BackendError> {
    let n = jobs.first().map_or(0, |job| job.system.coordinates());
    let abreast = width != Width::One && jobs.iter().all(|job| job.system.coordinates() == n);
    match (abreast, n) {
        (true, 1) => spread::<1>(jobs, schedule, watch, width),
        (true, 2) => spread::<2>(jobs, schedule, watch, width),
        (true, 3) => spread::<3>(jobs, schedule, watch, width),
        (true, 4) => spread::<4>(jobs, schedule, watch, width),
        _ => {
            each(jobs, watch, |job| follow::<f64>(job, schedule)).map(|verdicts| (verdicts, Usage::default()))
        }
    }
}

/// Lets every thread take jobs from one queue.
fn spread<const N: usize>(
    jobs: &[Job],
    schedule: &Schedule,
    watch: &dyn Watch,
    width: Width,
) -> Result<(Vec<Verdict>, Usage), BackendError> {
    let taken = AtomicUsize::new(0);
    let usage = Mutex::new(Usage::default());
    let systems: Vec<&System> = jobs.iter().map(|job| &job.system).collect();
    let by_flow = ByFlow::of(&systems);
    let order = by_flow.order();
    let flights = Flights::<N>::of(by_flow);
    let threads = rayon::current_num_threads().min(jobs.len().div_ceil(width.lanes()));
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
struct Line<'a, 'scope, const N: usize> {
    jobs: &'scope [Job],
    flights: &'scope Flights<N>,
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
    left: Vec<Box<Seat<f64, N, usize>>>,
    /// Where what would keep the other lanes waiting is left for any thread that has nothing else to do.
    scope: &'a Scope<'scope>,
}

impl<const N: usize> Line<'_, '_, N> {
    fn follow(&mut self, width: Width) {
        width.compute(&mut *self);
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
        tell(&self.done, self.watch, index, follow::<f64>(&self.jobs[index], self.schedule));
    }
}

/// Says what a job came to; nobody listens any more only where all was given up.
fn tell(done: &Sender<(usize, Verdict)>, watch: &dyn Watch, index: usize, verdict: Verdict) {
    let _ = done.send((index, verdict));
    watch.finished(1);
}

impl<const N: usize> Queue<f64, N> for Line<'_, '_, N> {
    type Ticket = usize;

    fn next(&mut self) -> Option<Box<Seat<f64, N, usize>>> {
        let mut index = self.take()?;
        while self.jobs[index].system.normals() != self.normals {
            self.follow_alone(index);
            index = self.take()?;
        }
        let Job { system, start } = &self.jobs[index];
        let flow = self.flights.flow_of(index);
        let begun = |flight: &Flight<f64, N>| Observer::new(flight, self.schedule, start.state());
        // What a trajectory and its constants lie in is large: that of one that is done is taken again.
        let Some(mut seat) = self.left.pop() else {
            let flight = self.flights.get(index, system);
            return Some(Box::new(Seat::new(index, flow, flight, begun(&flight))));
        };
        self.flights.put(index, system, seat.ticket, &mut seat.flight);
        (seat.ticket, seat.flow, seat.observer) = (index, flow, begun(&seat.flight));
        Some(seat)
    }

    fn hand_over(&mut self, mut seat: Box<Seat<f64, N, usize>>) {
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

    fn done(&mut self, seat: Box<Seat<f64, N, usize>>) {
        let verdict = seat.observer.verdict(&seat.flight, self.jobs[seat.ticket].system.label_order());
        tell(&self.done, self.watch, seat.ticket, verdict);
        self.left.push(seat);
    }
}

/// Lanes at work on it.
impl<const N: usize> AtWidth for &mut Line<'_, '_, N> {
    type Output = ();

    #[inline(always)]
    fn call<L: Lanes<Real = f64>>(self, zero: L) {
        follow_abreast(zero, self.normals, self.schedule, self);
    }
}
