//! Trajectories in free flight side by side, one in each lane: clear steps together, contacts when several wait for one.

use super::crossing::{Crossing, crossing};
use super::leg::{Clearance, Clearances, Leg};
use super::point::Point;
use super::striking::energy_taken;
use super::tally::Tally;
use super::tangent::Tangent;
use super::trajectory::{MOST_KICKS, Trajectory};
use super::usage::Usage;
use crate::model::vector::MOST;
use crate::model::{Flight, Lanes, Mask, Real, State};

/// As many trajectories as there are lanes, each of them in free flight, or none in its lane.
///
/// What [`Trajectory::advance`] does to one of them happens here to all that are ready for it, operation by operation, so
/// that the bits are the same.
#[derive(Debug)]
pub struct Abreast<L: Lanes, const N: usize> {
    flight: Flight<L, N>,
    point: Point<L, N>,
    ahead: Point<L, N>,
    /// What the way there stays off, where a trajectory waits.
    clearances: Clearances<L::Mask>,
    tangent: Tangent<L, N>,
    offset: L,
    kicks: L,
    /// Steps to the next phase 0 or π.
    left: L,
    /// Steps from one of them to the other.
    half: L,
    /// Cosine of the last of them: 1 or −1.
    phase: L,
    /// 1 where a trajectory is at the beginning of a step, else 0.
    steps: L,
    /// 1 where the rest of the step does not clear the stops, else 0; the tangent is that of the end of the step there.
    waits: L,
    /// 1 where the tangent is carried along, else 0.
    carries: L,
    tally: Tally<L>,
    usage: Usage,
}

/// What a round of contacts led to, lane by lane (bit k for lane k).
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// The contact is not certain: it must be approached from the safe side.
    pub uncertain: u32,
    /// The step was completed after the impact, at phase 0, or at phase π of a lane that carries a tangent.
    pub phases: u32,
}

impl<L: Lanes, const N: usize> Abreast<L, N> {
    /// Empty lanes for cells of so many contact normals.
    pub fn new(zero: L, normals: usize) -> Self {
        let vector = [zero; N];
        let state = State { x: vector, v: vector };
        let point = Point { state, sin: zero, cos: zero };
        let never = zero.below(zero);
        Abreast {
            flight: Flight::blank(normals, zero),
            point,
            ahead: point,
            clearances: Clearances([Clearance { upper: never, lower: never }; MOST]),
            tangent: Tangent(state),
            offset: zero,
            kicks: zero,
            left: zero,
            half: zero,
            phase: zero,
            steps: zero,
            waits: zero,
            carries: zero,
            tally: Tally::none(zero),
            usage: Usage::default(),
        }
    }

    /// Puts the constants of a cell into a lane.
    pub fn prepare(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        self.flight.set_lane(lane, flight);
        self.half.set_lane(lane, L::Real::of(f64::from(flight.steps / 2)));
    }

    /// Puts a trajectory at the beginning of a step of free flight into a lane.
    pub fn seat(&mut self, lane: usize, flight: &Flight<L::Real, N>, trajectory: &Trajectory<L::Real, N>) {
        debug_assert!(trajectory.begins_free_step());
        let number = |value: f64| L::Real::of(value);
        self.point.set_lane(lane, &trajectory.point);
        self.offset.set_lane(lane, number(0.0));
        let half = flight.steps / 2;
        let left = half - trajectory.step % half;
        self.left.set_lane(lane, number(f64::from(left)));
        self.phase.set_lane(lane, number(if trajectory.step < half { 1.0 } else { -1.0 }));
        self.steps.set_lane(lane, number(1.0));
        self.waits.set_lane(lane, number(0.0));
    }

    /// Sums up in a lane what impacts come to from here, on top of what they came to before.
    pub fn begin_tally(&mut self, lane: usize, fastest: L::Real, energy: L::Real) {
        self.tally.begin(lane, fastest, energy);
    }

    /// What the impacts in a lane came to; they are counted anew from here.
    #[inline(always)]
    pub fn take_tally(&mut self, lane: usize) -> Tally<L::Real> {
        self.tally.take(lane, self.flight.count)
    }

    /// Carries a tangent along in a lane, or none.
    pub fn set_tangent(&mut self, lane: usize, tangent: Option<&Tangent<L::Real, N>>) {
        self.carries.set_lane(lane, L::Real::of(if tangent.is_some() { 1.0 } else { 0.0 }));
        if let Some(tangent) = tangent {
            self.tangent.0.set_lane(lane, &tangent.0);
        }
    }

    /// Leaves a lane empty.
    pub fn vacate(&mut self, lane: usize) {
        self.steps.set_lane(lane, L::Real::of(0.0));
        self.waits.set_lane(lane, L::Real::of(0.0));
    }

    /// The trajectory in a lane, `flight` being its cell's.
    pub fn trajectory(&self, lane: usize, flight: &Flight<L::Real, N>) -> Trajectory<L::Real, N> {
        let left = self.left.lane(lane).widen() as u32;
        Trajectory::resumed(
            self.point.lane(lane),
            self.ahead.lane(lane),
            self.kicks.lane(lane).widen() as u32,
            self.last_phase(lane, flight) + flight.steps / 2 - left,
            self.offset.lane(lane),
            holds(self.waits.lane(lane)),
        )
    }

    /// The trajectory in a lane that has come to phase 0 or π: at the beginning of that step.
    pub fn trajectory_at_phase(&self, lane: usize, flight: &Flight<L::Real, N>) -> Trajectory<L::Real, N> {
        let point = self.point.lane(lane);
        Trajectory::resumed(point, point, 0, self.last_phase(lane, flight), L::Real::of(0.0), false)
    }

    /// The step at which the last of the phases 0 and π was that a lane's trajectory passed.
    fn last_phase(&self, lane: usize, flight: &Flight<L::Real, N>) -> u32 {
        if self.phase.lane(lane) > L::Real::of(0.0) { 0 } else { flight.steps / 2 }
    }

    /// The tangent in a lane, as its trajectory there is resumed with it.
    pub fn tangent(&self, lane: usize) -> Tangent<L::Real, N> {
        Tangent(self.tangent.0.lane(lane))
    }

    /// How well the lanes were used so far.
    pub fn usage(&self) -> Usage {
        self.usage
    }

    /// How many trajectories wait for a contact, and how many can step.
    #[inline(always)]
    pub fn waiting(&self) -> (u32, u32) {
        (holds(self.waits).bits().count_ones(), holds(self.steps).bits().count_ones())
    }

    /// One step of every trajectory that is at the beginning of one, where it clears the stops; the others wait from then
    /// on. The lanes that came to phase 0, or with a tangent to phase π.
    #[inline(always)]
    pub fn step(&mut self) -> u32 {
        let steps = holds(self.steps);
        let flight = &self.flight;
        let ahead = self.point.stepped(flight);
        let clearances = Leg { from: &self.point, to: &ahead, window: flight.h }.clearances(flight);
        let moves = steps.and(clearances.all(flight.count));
        self.clearances = Clearances::select(steps, &clearances, &self.clearances, flight.count);
        let carried = steps.and(holds(self.carries));
        if carried.bits() != 0 {
            let tangent = self.tangent.stepped_freely(flight).0;
            self.tangent.0 = State::select(carried, &tangent, &self.tangent.0);
        }
        let zero = self.left.all(0.0);
        let one = self.left.all(1.0);
        self.ahead = Point::select(steps, &ahead, &self.ahead);
        self.kicks = L::select(steps, zero, self.kicks);
        let stays = steps.and(moves.not());
        self.usage.step_slots += L::WIDTH as u64;
        self.usage.steps += u64::from(moves.bits().count_ones());
        self.waits = L::select(stays, one, self.waits);
        self.steps = L::select(stays, zero, self.steps);
        self.complete(moves)
    }

    /// The contacts of all trajectories that wait for one, and the rest of their step where it clears the stops.
    #[inline(always)]
    pub fn cross(&mut self) -> Round {
        let waits = holds(self.waits);
        let carries = holds(self.carries);
        let flight = &self.flight;
        let window = flight.h - self.offset;
        let met = crossing(&Leg { from: &self.point, to: &self.ahead, window }, &self.clearances, flight);
        let few = self.kicks.below(window.all(f64::from(MOST_KICKS)));
        let struck = waits.and(met.certain).and(few);
        let one = window.all(1.0);
        if struck.and(carries).bits() != 0 {
            let u = (window - met.time) * flight.inverse_h;
            let mut back = self.tangent.0;
            for (normal, &here) in flight.normals.iter().zip(&met.normals).take(flight.count) {
                if here.bits() != 0 {
                    back = State::select(here, &normal.look_back(u), &back);
                }
            }
            let tangent = self.tangent.struck_ahead(flight, &back, &met.impact);
            self.tangent.0 = State::select(struck.and(carries), &tangent.0, &self.tangent.0);
        }
        self.point = Point::select(struck, &met.point, &self.point);
        self.ahead = Point::select(struck, &met.ahead, &self.ahead);
        self.kicks = L::select(struck, self.kicks + one, self.kicks);
        self.offset = L::select(struck, self.offset + met.time, self.offset);
        let rest = flight.h - self.offset;
        self.clearances = Leg { from: &self.point, to: &self.ahead, window: rest }.clearances(flight);
        let moves = struck.and(self.clearances.all(flight.count));
        self.waits = L::select(moves, window.all(0.0), self.waits);
        self.steps = L::select(moves, one, self.steps);
        self.offset = L::select(moves, window.all(0.0), self.offset);
        self.count(struck, carries, &met);
        let uncertain = waits.and(struck.not()).bits();
        self.usage.contact_slots += L::WIDTH as u64;
        self.usage.contacts += u64::from(struck.bits().count_ones());
        self.usage.fallbacks += u64::from(uncertain.count_ones());
        Round { uncertain, phases: self.complete(moves) }
    }

    /// Counts the impacts of some lanes, and sums up what they take where that is observed.
    #[inline(always)]
    fn count(&mut self, struck: L::Mask, observed: L::Mask, met: &Crossing<L, N>) {
        let Tally { impacts, fastest, energy } = &mut self.tally;
        let before = met.impact.velocity;
        let one = before.all(1.0);
        let mut mass = before.all(0.0);
        for (k, [upper, lower]) in impacts.iter_mut().enumerate().take(self.flight.count) {
            let here = struck.and(met.normals[k]);
            *upper = L::select(here.and(met.upper), *upper + one, *upper);
            *lower = L::select(here.and(met.upper.not()), *lower + one, *lower);
            mass = L::select(met.normals[k], self.flight.normals[k].mass, mass);
        }
        *fastest = L::select(struck, before.magnitude().larger(*fastest), *fastest);
        let taken = energy_taken(mass, before, met.rebound);
        *energy = L::select(struck.and(observed), *energy + taken, *energy);
    }

    /// Ends the step of some lanes; at phases 0 and π the forcing phasor is exact. Those that come to phase 0, or with a tangent
    /// to phase π: without one nothing is read there.
    #[inline(always)]
    fn complete(&mut self, moves: L::Mask) -> u32 {
        self.point = Point::select(moves, &self.ahead, &self.point);
        self.left = L::select(moves, self.left - self.left.all(1.0), self.left);
        let arrived = moves.and(self.left.below(self.left.all(0.5)));
        if arrived.bits() == 0 {
            return 0;
        }
        self.phase = L::select(arrived, -self.phase, self.phase);
        self.point.sin = L::select(arrived, self.left.all(0.0), self.point.sin);
        self.point.cos = L::select(arrived, self.phase, self.point.cos);
        self.left = L::select(arrived, self.half, self.left);
        arrived.and(self.phase.all(0.0).below(self.phase).or(holds(self.carries))).bits()
    }
}

/// Where a flag is 1.
#[inline(always)]
fn holds<L: Lanes>(flag: L) -> L::Mask {
    flag.all(0.5).below(flag)
}

impl<L: Lanes, const N: usize> Point<L, N> {
    fn lane(&self, lane: usize) -> Point<L::Real, N> {
        Point { state: self.state.lane(lane), sin: self.sin.lane(lane), cos: self.cos.lane(lane) }
    }

    fn set_lane(&mut self, lane: usize, point: &Point<L::Real, N>) {
        self.state.set_lane(lane, &point.state);
        self.sin.set_lane(lane, point.sin);
        self.cos.set_lane(lane, point.cos);
    }
}
