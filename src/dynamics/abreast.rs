//! Trajectories in free flight side by side, one in each lane.

use super::along::{Along, Alongs, Met};
use super::clock::Clock;
use super::moments::Moments;
use super::moves::Moves;
use super::passing::{Passing, Unseen};
use super::point::Point;
use super::tally::Tally;
use super::tangent::Tangent;
use super::trajectory::Trajectory;
use super::usage::Usage;
use crate::model::{Flight, Lanes, Mask, Real, State};

/// As many trajectories as there are lanes, each of them in free flight, or none in its lane.
///
/// What [`Trajectory::advance`] does to one of them happens here to all that are ready for it, operation by operation, so
/// that the bits are the same. Its rounds have a file of their own; what else there is asks for lanes by these methods.
#[derive(Debug)]
pub struct Abreast<L: Lanes, const N: usize> {
    pub(super) flight: Flight<L, N>,
    /// The beginning of the step under way.
    pub(super) point: Point<L, N>,
    /// The end of the step under way, where something was met in it.
    pub(super) ahead: Point<L, N>,
    /// Where it is along each normal then: `point` is the beginning of the step still.
    pub(super) along: Alongs<L>,
    /// The number of the normal that was met last.
    pub(super) met: L,
    pub(super) tangent: Tangent<L, N>,
    pub(super) offset: L,
    /// Impacts in the step under way; where there was none it is at its beginning, and its end is found again for a contact.
    pub(super) kicks: L,
    pub(super) clock: Clock<L>,
    /// Where a trajectory is at the beginning of a step.
    pub(super) steps: L::Mask,
    /// Where the rest of the step does not clear the stops; the tangent is that of the end of the step there.
    pub(super) waits: L::Mask,
    /// Where the tangent is carried along.
    pub(super) carries: L::Mask,
    /// Where the trajectory is to be seen at phase π too.
    pub(super) halts: L::Mask,
    pub(super) passing: Passing<L, N>,
    pub(super) tally: Tally<L>,
    pub(super) usage: Usage,
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
            along: Alongs::all(Along { place: zero, speed: zero }, normals),
            met: zero,
            tangent: Tangent(state),
            offset: zero,
            kicks: zero,
            clock: Clock::stopped(zero),
            steps: never,
            waits: never,
            carries: never,
            halts: never,
            passing: Passing::none(zero),
            tally: Tally::none(zero),
            usage: Usage::default(),
        }
    }

    /// Puts the constants of a cell into a lane.
    pub fn prepare(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        self.flight.set_lane(lane, flight);
        self.clock.prepare(lane, flight.steps);
    }

    /// Puts the stops of a cell into a lane that has the constants of another with the same flow.
    pub fn restop(&mut self, lane: usize, flight: &Flight<L::Real, N>) {
        self.flight.restop_lane(lane, flight);
    }

    /// Puts a trajectory at the beginning of a step of free flight into a lane.
    pub fn seat(&mut self, lane: usize, flight: &Flight<L::Real, N>, trajectory: &Trajectory<L::Real, N>) {
        debug_assert!(trajectory.begins_free_step());
        let number = |value: f64| L::Real::of(value);
        self.point.set_lane(lane, &trajectory.point);
        self.offset.set_lane(lane, number(0.0));
        self.kicks.set_lane(lane, number(0.0));
        self.clock.set_lane(lane, flight.steps, trajectory.step);
        self.steps.set_lane(lane, true);
        self.waits.set_lane(lane, false);
    }

    /// Sums up in a lane what impacts come to from here, on top of what they came to before.
    #[inline(always)]
    pub fn begin_tally(&mut self, lane: usize, fastest: L::Real, energy: L::Real, moves: Moves) {
        self.tally.begin(lane, fastest, energy, L::Real::of(f64::from(moves.count())));
    }

    /// What the impacts in a lane came to, and how often it passed phase 0 unseen; all that is counted anew from here.
    #[inline(always)]
    pub fn take_tally(&mut self, lane: usize) -> Tally<L::Real> {
        self.tally.take(lane, self.flight.count)
    }

    /// Carries a tangent along in a lane, or none.
    #[inline(always)]
    pub fn set_tangent(&mut self, lane: usize, tangent: Option<&Tangent<L::Real, N>>) {
        self.carries.set_lane(lane, tangent.is_some());
        if let Some(tangent) = tangent {
            self.tangent.0.set_lane(lane, &tangent.0);
        }
    }

    /// Sees a lane at phase π too, or at phase 0 alone.
    #[inline(always)]
    pub fn set_halt(&mut self, lane: usize, halts: bool) {
        self.halts.set_lane(lane, halts);
    }

    /// Lets a lane pass phase 0 unseen from here on, so often.
    #[inline(always)]
    pub fn set_unseen(&mut self, lane: usize, unseen: &Unseen<L::Real, N>) {
        self.passing.set_lane(lane, unseen);
    }

    /// What a lane's states at phase 0 scatter by, those that it passed unseen among them.
    pub fn moments(&self, lane: usize) -> Moments<L::Real, N> {
        self.passing.moments(lane)
    }

    /// Leaves a lane empty.
    pub fn vacate(&mut self, lane: usize) {
        self.steps.set_lane(lane, false);
        self.waits.set_lane(lane, false);
    }

    /// The trajectory in a lane that waits for a contact, `flight` being its cell's.
    pub fn trajectory(&self, lane: usize, flight: &Flight<L::Real, N>) -> Trajectory<L::Real, N> {
        debug_assert!((self.waits.bits() >> lane) & 1 == 1);
        let normal = self.met.lane(lane).widen() as usize;
        Trajectory::resumed(
            self.point.lane(lane),
            (self.ahead.lane(lane), self.kicks.lane(lane).widen() as u32),
            self.clock.step(lane, flight.steps),
            self.offset.lane(lane),
            Met { normal, along: self.along.lane(lane) },
        )
    }

    /// The point in a lane.
    #[inline(always)]
    pub fn point(&self, lane: usize) -> Point<L::Real, N> {
        self.point.lane(lane)
    }

    /// Whether the last of the phases 0 and π that a lane's trajectory passed was π.
    #[inline(always)]
    pub fn is_past_half(&self, lane: usize) -> bool {
        self.clock.is_past_half(lane)
    }

    /// The tangent in a lane, as its trajectory there is resumed with it.
    #[inline(always)]
    pub fn tangent(&self, lane: usize) -> Tangent<L::Real, N> {
        Tangent(self.tangent.0.lane(lane))
    }

    /// How well the lanes were used so far.
    pub fn usage(&self) -> Usage {
        self.usage
    }
}
