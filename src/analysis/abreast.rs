//! Observers side by side: each lane follows one to its verdict, then takes the next.

use pulp::NullaryFnOnce;

use super::observer::Observer;
use super::schedule::Schedule;
use super::stage::Stage;
use crate::dynamics::{Abreast, Usage};
use crate::model::{Flight, Lanes, Real};

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

/// Contacts are looked for when five of eight trajectories wait for one, three of four.
const WAITING: u32 = 5;
/// See [`WAITING`].
const OF_ALL: u32 = 8;
/// Steps that are tried on the GPU between two contacts.
pub const CLEAR_STEPS: u32 = 4;
/// Rounds of steps and contacts on the GPU before what is rare is looked at.
pub const ROUNDS: u32 = 16;
/// Turns of such rounds on the GPU, each up to phase 0 at the latest, before lanes with something rare have waited enough.
pub const TURNS: u32 = 8;

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

/// Follows everything in a queue, in as many lanes as `zero` has, each trajectory exactly as [`Observer::follow`] does;
/// all cells have `normals` contact normals.
#[inline(always)]
pub fn follow_abreast<L: Lanes, const N: usize, Q: Queue<L::Real, N>>(
    zero: L,
    normals: usize,
    schedule: &Schedule,
    queue: &mut Q,
) {
    let mut lanes = Lane::<L, N, Q>::all(zero, normals, queue, schedule);
    while lanes.busy > 0 {
        let phases = lanes.abreast.fly((WAITING * lanes.busy).div_ceil(OF_ALL));
        if phases > 0 {
            lanes.pass_phases(phases, schedule, queue);
            continue;
        }
        let round = lanes.abreast.cross();
        lanes.pass_phases(round.phases, schedule, queue);
        for lane in bits(round.uncertain) {
            lanes.go_warily(lane, schedule, queue);
        }
    }
    queue.used(lanes.abreast.usage());
}

/// Who sits in each lane.
type Seats<T, const N: usize, K> = Vec<Option<Box<Seat<T, N, K>>>>;

/// The lanes with who sits in them.
struct Lane<L: Lanes, const N: usize, Q: Queue<L::Real, N>> {
    abreast: Box<Abreast<L, N>>,
    seats: Seats<L::Real, N, Q::Ticket>,
    /// The flow of the constants in each lane.
    flows: Vec<Option<u32>>,
    busy: u32,
}

impl<L: Lanes, const N: usize, Q: Queue<L::Real, N>> Lane<L, N, Q> {
    fn all(zero: L, normals: usize, queue: &mut Q, schedule: &Schedule) -> Self {
        let seats = (0..L::WIDTH).map(|_| None).collect();
        let flows = vec![None; L::WIDTH];
        let mut lanes = Lane { abreast: Box::new(Abreast::new(zero, normals)), seats, flows, busy: 0 };
        (0..L::WIDTH).for_each(|lane| lanes.fill(lane, schedule, queue));
        lanes
    }

    /// Gives an empty lane the next trajectory that still flies; those that do not are followed on the spot.
    #[inline(never)]
    fn fill(&mut self, lane: usize, schedule: &Schedule, queue: &mut Q) {
        while let Some(mut seat) = queue.next() {
            seat.observer.settle_down(&seat.flight, schedule, false);
            if seat.observer.is_done() {
                queue.done(seat);
                continue;
            }
            if self.flows[lane].replace(seat.flow) == Some(seat.flow) {
                self.abreast.restop(lane, &seat.flight);
            } else {
                self.abreast.prepare(lane, &seat.flight);
            }
            self.seats[lane] = Some(seat);
            self.busy += 1;
            self.sit(lane, schedule);
            return;
        }
        self.abreast.vacate(lane);
    }

    /// Puts a lane's trajectory, at the beginning of a step of free flight, among the others.
    fn sit(&mut self, lane: usize, schedule: &Schedule) {
        let Some(seat) = &mut self.seats[lane] else { return };
        self.abreast.seat(lane, &seat.flight, &seat.observer.trajectory);
        self.carry_on(lane, schedule);
    }

    /// Lets a lane carry along, sum up, halt for and pass unseen what its observer asks for.
    #[inline(always)]
    fn carry_on(&mut self, lane: usize, schedule: &Schedule) {
        let Some(Seat { flight, observer, .. }) = self.seats[lane].as_deref() else { return };
        self.abreast.set_tangent(lane, observer.carried());
        self.abreast.set_halt(lane, observer.awaits_mirror(flight));
        self.abreast.begin_tally(lane, observer.peak, observer.loss.energy, observer.moves);
        self.abreast.set_unseen(lane, &observer.unseen(schedule));
    }

    /// Takes a lane's trajectory back where it is done, and gives the lane the next.
    #[inline(never)]
    fn finish(&mut self, lane: usize, schedule: &Schedule, queue: &mut Q) {
        if let Some(seat) = self.seats[lane].take() {
            queue.done(seat);
            self.busy -= 1;
            self.fill(lane, schedule, queue);
        }
    }

    /// Lets a lane's trajectory be followed elsewhere, and gives the lane the next.
    #[inline(never)]
    fn hand_over(&mut self, lane: usize, schedule: &Schedule, queue: &mut Q) {
        if let Some(seat) = self.seats[lane].take() {
            queue.hand_over(seat);
            self.busy -= 1;
            self.fill(lane, schedule, queue);
        }
    }

    #[inline(always)]
    fn pass_phases(&mut self, phases: u32, schedule: &Schedule, queue: &mut Q) {
        for lane in bits(phases) {
            L::Real::fused(AtPhase { lanes: self, lane, schedule, queue });
        }
    }

    #[inline(always)]
    fn pass_phase(&mut self, lane: usize, schedule: &Schedule, queue: &mut Q) {
        let Some(seat) = &mut self.seats[lane] else { return };
        if self.abreast.is_past_half(lane) {
            seat.observer.half_period(&seat.flight, &self.abreast.point(lane));
            return;
        }
        let observing = seat.observer.stage == Stage::Observation;
        seat.observer.trajectory.come_to_phase_zero(self.abreast.point(lane));
        seat.observer.catch_up(&seat.flight, schedule, &self.abreast.take_tally(lane));
        let many = seat.observer.keeps_others_waiting();
        let mut leapt = false;
        // Two calls, each of which is compiled for its own case.
        if observing {
            seat.observer.arrive(&seat.flight, schedule, Some(self.abreast.tangent(lane)));
        } else {
            leapt = seat.observer.arrive(&seat.flight, schedule, None);
        }
        if seat.observer.is_done() {
            self.finish(lane, schedule, queue);
        } else if many {
            self.hand_over(lane, schedule, queue);
        } else if leapt {
            self.sit(lane, schedule);
        } else if observing || seat.observer.carried().is_some() {
            self.carry_on(lane, schedule);
        } else {
            self.abreast.set_unseen(lane, &seat.observer.unseen(schedule));
        }
    }

    /// Follows a lane's trajectory by itself through what is rare, until it is in free flight again.
    #[inline(never)]
    fn go_warily(&mut self, lane: usize, schedule: &Schedule, queue: &mut Q) {
        let Some(seat) = &mut self.seats[lane] else { return };
        seat.observer.trajectory = self.abreast.trajectory(lane, &seat.flight);
        seat.observer.catch_up(&seat.flight, schedule, &self.abreast.take_tally(lane));
        if seat.observer.stage == Stage::Observation {
            seat.observer.tangent = self.abreast.tangent(lane);
        }
        seat.observer.settle_down(&seat.flight, schedule, true);
        if seat.observer.is_done() {
            self.finish(lane, schedule, queue);
        } else if seat.observer.keeps_others_waiting() {
            self.hand_over(lane, schedule, queue);
        } else {
            self.sit(lane, schedule);
        }
    }
}

/// A lane's trajectory at phase 0 or π; a type of its own, since what a closure does is not compiled with the instructions that
/// [`Real::fused`] asks for.
struct AtPhase<'a, L: Lanes, const N: usize, Q: Queue<L::Real, N>> {
    lanes: &'a mut Lane<L, N, Q>,
    lane: usize,
    schedule: &'a Schedule,
    queue: &'a mut Q,
}

impl<L: Lanes, const N: usize, Q: Queue<L::Real, N>> NullaryFnOnce for AtPhase<'_, L, N, Q> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.lanes.pass_phase(self.lane, self.schedule, self.queue);
    }
}

/// The lanes whose bit is set.
fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (set != 0).then(|| {
            let lane = set.trailing_zeros() as usize;
            set &= set - 1;
            lane
        })
    })
}
