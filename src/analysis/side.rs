//! Trajectories side by side with their observers: those that carry a tangent along, or those that do not.

use pulp::NullaryFnOnce;

use super::queue::{Leaving, Queue, Seat, Source};
use super::schedule::Schedule;
use super::stage::Stage;
use crate::dynamics::Abreast;
use crate::model::{Lanes, Real};

/// Who sits in each lane.
type Seats<T, const N: usize, K> = Vec<Option<Box<Seat<T, N, K>>>>;

/// Lanes with who sits in them.
pub(super) struct Side<L: Lanes, const N: usize, Q: Queue<L::Real, N>> {
    /// The lanes.
    pub abreast: Box<Abreast<L, N>>,
    seats: Seats<L::Real, N, Q::Ticket>,
    /// The flow of the constants in each lane.
    flows: Vec<Option<u32>>,
    /// How many lanes are not empty.
    pub busy: u32,
    /// Whether this is where trajectories are observed.
    observed: bool,
}

impl<L: Lanes, const N: usize, Q: Queue<L::Real, N>> Side<L, N, Q> {
    /// Empty lanes for cells of so many contact normals.
    pub fn new(zero: L, normals: usize, observed: bool) -> Self {
        let seats = (0..L::WIDTH).map(|_| None).collect();
        let flows = vec![None; L::WIDTH];
        Side { abreast: Box::new(Abreast::new(zero, normals)), seats, flows, busy: 0, observed }
    }

    /// Gives every empty lane a trajectory, as far as there are any.
    pub fn fill_all(&mut self, schedule: &Schedule, source: &mut Source<'_, L::Real, N, Q>) {
        for lane in 0..L::WIDTH {
            if self.seats[lane].is_none() {
                self.fill(lane, schedule, source);
            }
        }
    }

    /// Whether its turn is over: enough wait to be observed; or lanes that observe are empty while the other side, `idle` where its
    /// lanes are empty, has something to do; or all is given up.
    pub fn gives_way(&self, source: &Source<'_, L::Real, N, Q>, idle: bool) -> bool {
        let over = if self.observed {
            self.busy < L::WIDTH as u32 && !(idle && source.is_empty(false))
        } else {
            source.has_enough()
        };
        over || source.is_given_up()
    }

    /// Gives an empty lane the next trajectory.
    #[inline(never)]
    fn fill(&mut self, lane: usize, schedule: &Schedule, source: &mut Source<'_, L::Real, N, Q>) {
        let Some(seat) = source.next(self.observed, schedule) else {
            self.abreast.vacate(lane);
            return;
        };
        if self.flows[lane].replace(seat.flow) == Some(seat.flow) {
            self.abreast.restop(lane, &seat.flight);
        } else {
            self.abreast.prepare(lane, &seat.flight);
        }
        self.seats[lane] = Some(seat);
        self.busy += 1;
        self.sit(lane, schedule);
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
        self.abreast.set_unseen(lane, &observer.unseen(flight, schedule));
    }

    /// Takes a lane's trajectory out, and gives the lane the next.
    #[inline(never)]
    fn exchange(
        &mut self,
        lane: usize,
        leaving: Leaving,
        schedule: &Schedule,
        source: &mut Source<'_, L::Real, N, Q>,
    ) {
        if let Some(seat) = self.seats[lane].take() {
            source.take(seat, leaving);
            self.busy -= 1;
            self.fill(lane, schedule, source);
        }
    }

    #[inline(always)]
    pub fn pass_phases(&mut self, phases: u32, schedule: &Schedule, source: &mut Source<'_, L::Real, N, Q>) {
        for lane in bits(phases) {
            L::Real::fused(AtPhase { side: self, lane, schedule, source });
        }
    }

    #[inline(always)]
    fn pass_phase(&mut self, lane: usize, schedule: &Schedule, source: &mut Source<'_, L::Real, N, Q>) {
        let Some(seat) = &mut self.seats[lane] else { return };
        if self.abreast.is_past_half(lane) {
            seat.observer.half_period(&seat.flight, &self.abreast.point(lane));
            return;
        }
        let observing = seat.observer.stage == Stage::Observation;
        seat.observer.trajectory.come_to_phase_zero(self.abreast.point(lane));
        let tally = self.abreast.take_tally(lane);
        seat.observer.catch_up(&seat.flight, schedule, &tally, || self.abreast.moments(lane));
        let many = seat.observer.keeps_others_waiting();
        let mut leapt = false;
        // Two calls, each of which is compiled for its own case.
        if observing {
            seat.observer.arrive(&seat.flight, schedule, Some(self.abreast.tangent(lane)));
        } else {
            leapt = seat.observer.arrive(&seat.flight, schedule, None);
        }
        if let Some(leaving) = source.leaving(&seat.observer, many, self.observed) {
            self.exchange(lane, leaving, schedule, source);
        } else if leapt {
            self.sit(lane, schedule);
        } else if observing || seat.observer.carried().is_some() {
            self.carry_on(lane, schedule);
        } else {
            self.abreast.set_unseen(lane, &seat.observer.unseen(&seat.flight, schedule));
        }
    }

    /// Follows a lane's trajectory by itself through what is rare, until it is in free flight again.
    #[inline(never)]
    pub fn go_warily(&mut self, lane: usize, schedule: &Schedule, source: &mut Source<'_, L::Real, N, Q>) {
        let Some(seat) = &mut self.seats[lane] else { return };
        seat.observer.trajectory = self.abreast.trajectory(lane, &seat.flight);
        let tally = self.abreast.take_tally(lane);
        seat.observer.catch_up(&seat.flight, schedule, &tally, || self.abreast.moments(lane));
        if seat.observer.stage == Stage::Observation {
            seat.observer.tangent = self.abreast.tangent(lane);
        }
        seat.observer.settle_down(&seat.flight, schedule, true);
        let slow = seat.observer.keeps_others_waiting();
        if let Some(leaving) = source.leaving(&seat.observer, slow, self.observed) {
            self.exchange(lane, leaving, schedule, source);
        } else {
            self.sit(lane, schedule);
        }
    }
}

/// A lane's trajectory at phase 0 or π; a type of its own, since what a closure does is not compiled with the instructions that
/// [`Real::fused`] asks for.
struct AtPhase<'a, 'b, L: Lanes, const N: usize, Q: Queue<L::Real, N>> {
    side: &'a mut Side<L, N, Q>,
    lane: usize,
    schedule: &'a Schedule,
    source: &'a mut Source<'b, L::Real, N, Q>,
}

impl<L: Lanes, const N: usize, Q: Queue<L::Real, N>> NullaryFnOnce for AtPhase<'_, '_, L, N, Q> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.side.pass_phase(self.lane, self.schedule, self.source);
    }
}

/// The lanes whose bit is set.
pub(super) fn bits(mut set: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        (set != 0).then(|| {
            let lane = set.trailing_zeros() as usize;
            set &= set - 1;
            lane
        })
    })
}
