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

    /// Whether nobody waits for what is followed any more.
    fn is_given_up(&self) -> bool;

    /// Everything is at its end, or given up.
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
    /// It is observed from here on, or no longer.
    ChangesOver,
}

/// Trajectories at the beginning of a step of free flight.
type Waiting<T, const N: usize, K> = Vec<Box<Seat<T, N, K>>>;

/// Where trajectories come from, and where they go.
pub(super) struct Source<'a, T, const N: usize, Q: Queue<T, N>> {
    /// Those that are to begin.
    pub queue: &'a mut Q,
    /// Whether there are none any more.
    exhausted: bool,
    /// Those that wait to change over: to where trajectories are not observed, and to where they are.
    waiting: [Waiting<T, N, Q::Ticket>; 2],
    /// How many that are to be observed are enough.
    enough: usize,
}

impl<'a, T: Real, const N: usize, Q: Queue<T, N>> Source<'a, T, N, Q> {
    /// Of a queue.
    pub fn new(queue: &'a mut Q, enough: usize) -> Self {
        Source { queue, exhausted: false, waiting: [Vec::new(), Vec::new()], enough }
    }

    /// The next trajectory for a side; those that do not fly at all are followed on the spot. None where there is none, or where
    /// enough wait for the other side.
    pub fn next(&mut self, observed: bool, schedule: &Schedule) -> Option<Box<Seat<T, N, Q::Ticket>>> {
        let waiting = self.waiting[usize::from(observed)].pop();
        if observed || waiting.is_some() {
            return waiting;
        }
        while !self.has_enough() {
            let Some(mut seat) = self.queue.next() else {
                self.exhausted = true;
                return None;
            };
            seat.observer.settle_down(&seat.flight, schedule, false);
            match self.leaving(&seat.observer, false, observed) {
                Some(leaving) => self.take(seat, leaving),
                None => return Some(seat),
            }
        }
        None
    }

    /// Whether nobody waits any more for what is left.
    pub fn is_given_up(&self) -> bool {
        self.exhausted && self.queue.is_given_up()
    }

    /// Whether enough wait to be observed.
    pub fn has_enough(&self) -> bool {
        self.waiting[1].len() >= self.enough
    }

    /// Whether there is nothing for a side any more, but for what the other side may bring.
    pub fn is_empty(&self, observed: bool) -> bool {
        self.waiting[usize::from(observed)].is_empty() && (observed || self.exhausted)
    }

    /// Whether one leaves its lane on a side where trajectories are `observed` or not; `slow` where the others would wait for it.
    /// Where no more begin, those that are left stay in their lanes.
    #[inline(always)]
    pub fn leaving(&self, observer: &Observer<T, N>, slow: bool, observed: bool) -> Option<Leaving> {
        if observer.is_done() {
            Some(Leaving::Done)
        } else if slow {
            Some(Leaving::Slow)
        } else {
            (!self.exhausted && observer.carried().is_some() != observed).then_some(Leaving::ChangesOver)
        }
    }

    /// Takes a trajectory that leaves its lane.
    pub fn take(&mut self, seat: Box<Seat<T, N, Q::Ticket>>, leaving: Leaving) {
        match leaving {
            Leaving::Done => self.queue.done(seat),
            Leaving::Slow => self.queue.hand_over(seat),
            Leaving::ChangesOver => {
                self.waiting[usize::from(seat.observer.carried().is_some())].push(seat);
            }
        }
    }
}
