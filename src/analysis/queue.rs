//! What trajectories side by side are: where they come from, what is kept of each, and who is told.

use super::observer::Observer;
use super::schedule::Schedule;
use crate::dynamics::Usage;
use crate::model::{Flight, Real};

/// What the lanes are to follow, and who is told.
pub trait Queue<T, const N: usize> {
    /// What tells one trajectory from another.
    type Ticket;

    /// The next trajectory: none when there is no more.
    fn next(&mut self) -> Option<Box<Seat<T, N, Self::Ticket>>>;

    /// A trajectory makes so many moves that the others would wait for it: it is to be followed to its end elsewhere.
    fn hand_over(&mut self, seat: Box<Seat<T, N, Self::Ticket>>);

    /// Everything is at its end.
    fn used(&mut self, usage: Usage);

    /// A trajectory is at its end; its seat may be taken by another.
    fn done(&mut self, seat: Box<Seat<T, N, Self::Ticket>>);
}

/// One lane's trajectory.
#[derive(Debug)]
pub struct Seat<T, const N: usize, K> {
    /// What tells it from the others.
    pub ticket: K,
    /// The number of its cell's flow: what it has in common with others are all constants but those of the stops.
    pub flow: u32,
    /// The constants of its cell.
    pub flight: Flight<T, N>,
    /// What has been noted about it.
    pub observer: Observer<T, N>,
}

impl<T, const N: usize, K> Seat<T, N, K> {
    /// For a trajectory that has yet to begin.
    pub fn new(ticket: K, flow: u32, flight: Flight<T, N>, observer: Observer<T, N>) -> Self {
        Seat { ticket, flow, flight, observer }
    }
}

/// Why a trajectory leaves its lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Leaving {
    /// It is at its end.
    Done,
    /// The others would wait for it.
    Slow,
    /// It is to be observed from here on, beside others that are.
    Observed,
}

impl Leaving {
    /// Whether one does, from a side where trajectories are `observed` or not; `slow` where the others would wait for it.
    #[inline(always)]
    pub fn of<T: Real, const N: usize>(
        observer: &Observer<T, N>,
        slow: bool,
        observed: bool,
    ) -> Option<Self> {
        if observer.is_done() {
            Some(Leaving::Done)
        } else if slow {
            Some(Leaving::Slow)
        } else {
            (!observed && observer.carried().is_some()).then_some(Leaving::Observed)
        }
    }
}

/// Where trajectories come from, and where they go.
pub(super) struct Source<'a, T, const N: usize, Q: Queue<T, N>> {
    pub queue: &'a mut Q,
    /// Those that are to be observed, at the beginning of a step of free flight.
    waiting: Vec<Box<Seat<T, N, Q::Ticket>>>,
    /// How many may wait.
    most: usize,
}

impl<'a, T: Real, const N: usize, Q: Queue<T, N>> Source<'a, T, N, Q> {
    /// Of a queue, where so many may wait.
    pub fn new(queue: &'a mut Q, most: usize) -> Self {
        Source { queue, waiting: Vec::new(), most }
    }

    /// The next trajectory that still flies, one that is observed or one that is not; those that do not fly are followed on the
    /// spot. None where there is none, or where enough wait to be observed.
    pub fn next(&mut self, observed: bool, schedule: &Schedule) -> Option<Box<Seat<T, N, Q::Ticket>>> {
        if observed {
            return self.waiting.pop();
        }
        while !self.is_full() {
            let mut seat = self.queue.next()?;
            seat.observer.settle_down(&seat.flight, schedule, false);
            if seat.observer.is_done() {
                self.queue.done(seat);
            } else if seat.observer.carried().is_some() {
                self.waiting.push(seat);
            } else {
                return Some(seat);
            }
        }
        None
    }

    /// Whether enough wait to be observed.
    pub fn is_full(&self) -> bool {
        self.waiting.len() >= self.most
    }

    /// Takes a trajectory that leaves its lane.
    pub fn take(&mut self, seat: Box<Seat<T, N, Q::Ticket>>, leaving: Leaving) {
        match leaving {
            Leaving::Done => self.queue.done(seat),
            Leaving::Slow => self.queue.hand_over(seat),
            Leaving::Observed => self.waiting.push(seat),
        }
    }
}
