//! One trajectory followed to its verdict: transient, settling, observation.

use super::exponent::Exponent;
use super::loss::Loss;
use super::quiet::is_quiet;
use super::recurrence::Recurrence;
use super::schedule::Schedule;
use super::spread::Spread;
use crate::dynamics::{Contact, Event, Impact, Move, Moves, Stop, Tangent, Trajectory, Variation};
use crate::model::{Flight, Real, State};

/// The largest distance between strobe states of a motion that is called periodic, and from the mirror image of
/// one that is called symmetric; absolute for states of order one and less, relative above. Both back ends use it.
pub const RETURNED: f64 = 1e-4;
/// Periods for which a trajectory must have returned, in the transient, before it finishes early.
pub const SETTLING: u32 = 64;
/// The same for a trajectory that returns far closer still, to [`Real::AT_REST`].
pub const SETTLING_AT_REST: u32 = 16;
/// Periods for which a settled trajectory is still observed.
pub const SETTLED_OBSERVATION: u32 = 48;
/// Total logarithmic growth below which a tangent vector neither grows nor shrinks: the exponent is zero.
pub const NEUTRAL_GROWTH: f64 = 3.0;
/// Total logarithmic growth above which the exponent can be positive.
pub const CHAOTIC_GROWTH: f64 = 5.0;
/// Standard errors by which a positive exponent must exceed zero.
pub const SIGNIFICANCE: f64 = 3.0;

/// Where in its schedule a trajectory is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum Stage {
    /// Before the observation.
    Transient = 0,
    /// Being observed.
    Observation = 1,
    /// Observed to the end.
    Observed = 2,
    /// Proven to stay off the stops for ever.
    Quiet = 3,
    /// Given up: a non-finite state, or too many moves in one period.
    Failed = 4,
}

impl Stage {
    /// Every stage, in the order of the codes that the GPU gets generated from here.
    pub const ALL: [Stage; 5] =
        [Stage::Transient, Stage::Observation, Stage::Observed, Stage::Quiet, Stage::Failed];
}

/// A trajectory and everything that is noted about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer<T, const N: usize> {
    pub(super) trajectory: Trajectory<T, N>,
    pub(super) tangent: Tangent<T, N>,
    pub(super) recurrence: Recurrence<T, N>,
    pub(super) exponent: Exponent<T>,
    pub(super) spread: Spread<T, N>,
    /// Logarithmic growth of the tangent vector since the recurrence's anchor was set.
    pub(super) grown: T,
    pub(super) stage: Stage,
    /// Forcing periods since the start.
    pub(super) periods: u32,
    /// Forcing periods since the observation began.
    pub(super) observed: u32,
    /// Forcing periods of the observation.
    pub(super) observe: u32,
    /// Moves since the last strobe.
    moves: Moves,
    /// Impacts since the observation began.
    pub(super) impacts: u32,
    /// Impacts since the start.
    pub(super) impacts_total: u32,
    /// Largest |v1−| since the observation began.
    pub(super) peak: T,
    /// Whether the first mass rested on a stop since the observation began.
    pub(super) stuck: bool,
    /// What the impacts took and how long contacts held since the observation began.
    pub(super) loss: Loss<T>,
}

impl<T: Real, const N: usize> Observer<T, N> {
    /// Begins at forcing phase 0 with a state within the stops.
    pub fn new(flight: &Flight<T, N>, schedule: &Schedule, start: State<T, N>) -> Self {
        let trajectory = Trajectory::new(flight, start);
        let mut observer = Observer {
            trajectory,
            tangent: Tangent::seed(),
            recurrence: Recurrence::anchored(trajectory.point.state),
            exponent: Exponent::over(schedule.observe),
            spread: Spread::about(&trajectory.point),
            grown: T::zero(),
            stage: Stage::Transient,
            periods: 0,
            observed: 0,
            observe: schedule.observe,
            moves: Moves::default(),
            impacts: 0,
            impacts_total: 0,
            peak: T::zero(),
            stuck: false,
            loss: Loss::none(false),
        };
        if schedule.transient == 0 {
            observer.begin_observation(flight, schedule.observe);
        }
        observer
    }

    /// Follows the trajectory to its end.
    pub fn follow(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        self.follow_listening(flight, schedule, &mut |_: &Trajectory<T, N>, _: &Event<T>| ());
    }

    /// Follows the trajectory to its end; `listen` is told of every event of the observation, with the trajectory
    /// just after it.
    #[inline(always)]
    pub fn follow_listening(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        listen: &mut impl FnMut(&Trajectory<T, N>, &Event<T>),
    ) {
        loop {
            match self.stage {
                Stage::Transient => {
                    self.follow_to_phase(flight, schedule, (), |_, ()| (), &mut |_, _| ());
                }
                Stage::Observation => {
                    let keep = |observer: &mut Self, tangent| observer.tangent = tangent;
                    self.follow_to_phase(flight, schedule, self.tangent, keep, listen);
                }
                Stage::Observed | Stage::Quiet | Stage::Failed => return,
            }
        }
    }

    /// Follows the trajectory to the next phase 0 or π, on copies;
    /// `keep` takes the variation back.
    #[inline(always)]
    fn follow_to_phase<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        mut variation: V,
        keep: impl Fn(&mut Self, V),
        listen: &mut impl FnMut(&Trajectory<T, N>, &Event<T>),
    ) {
        let mut trajectory = self.trajectory;
        loop {
            let taken = trajectory.advance(flight, &mut variation);
            if taken.event == Event::StepEnd {
                continue;
            }
            let at_phase = matches!(taken.event, Event::HalfPeriod | Event::Strobe);
            if at_phase {
                self.trajectory = trajectory;
                keep(self, variation);
            }
            listen(&trajectory, &taken.event);
            if self.stage == Stage::Observation {
                self.loss.note(flight, &trajectory, &taken.event);
            }
            self.note(flight, schedule, &taken);
            if at_phase || self.stage == Stage::Failed {
                return;
            }
        }
    }

    /// Whether it is at its end.
    #[inline(always)]
    pub(super) fn is_done(&self) -> bool {
        matches!(self.stage, Stage::Observed | Stage::Quiet | Stage::Failed)
    }

    /// Whether it makes so many moves in a forcing period that others beside it would wait.
    #[inline(always)]
    pub(super) fn keeps_others_waiting(&self) -> bool {
        self.moves.are_many()
    }

    /// The tangent, while it is carried along.
    pub(super) fn carried(&self) -> Option<&Tangent<T, N>> {
        (self.stage == Stage::Observation).then_some(&self.tangent)
    }

    /// Goes on until the trajectory is at the beginning of a step of free flight, or done; `warily` where the contact
    /// ahead is known not to be certain.
    pub(super) fn settle_down(&mut self, flight: &Flight<T, N>, schedule: &Schedule, mut warily: bool) {
        while !self.is_done() && (warily || !self.trajectory.begins_free_step()) {
            let taken = if self.stage == Stage::Observation {
                let mut tangent = self.tangent;
                let taken = self.move_on(flight, &mut tangent, warily);
                self.tangent = tangent;
                taken
            } else {
                self.move_on(flight, &mut (), warily)
            };
            if taken.event != Event::StepEnd {
                if self.stage == Stage::Observation {
                    self.loss.note(flight, &self.trajectory, &taken.event);
                }
                self.note(flight, schedule, &taken);
            }
            warily = false;
        }
    }

    #[inline(always)]
    fn move_on<V: Variation<T, N>>(
        &mut self,
        flight: &Flight<T, N>,
        variation: &mut V,
        warily: bool,
    ) -> Move<T> {
        if warily {
            self.trajectory.advance_warily(flight, variation)
        } else {
            self.trajectory.advance(flight, variation)
        }
    }

    /// Notes an impact from free flight to free flight.
    #[inline(always)]
    pub(super) fn pass_impact(&mut self, flight: &Flight<T, N>, schedule: &Schedule, taken: &Move<T>) {
        if self.stage == Stage::Observation
            && let Event::Impact(Impact { stop, velocity_before, velocity_after }) = taken.event
        {
            self.loss.take(flight, stop, velocity_before, velocity_after);
        }
        self.note(flight, schedule, taken);
    }

    /// Notes that the trajectory came to phase π before its observation: nothing is read there.
    #[inline(always)]
    pub(super) fn pass_half_period(&mut self) {
        self.moves.add();
    }

    /// Notes that the trajectory came to phase 0 or π in free flight.
    pub(super) fn arrive(&mut self, flight: &Flight<T, N>, schedule: &Schedule, event: Event<T>) {
        self.note(flight, schedule, &Move { time: T::zero(), contact: Contact::FREE, event });
    }

    #[inline(always)]
    pub(super) fn note(&mut self, flight: &Flight<T, N>, schedule: &Schedule, taken: &Move<T>) {
        self.moves.add();
        if !taken.contact.is_free() {
            self.stuck = true;
        }
        match taken.event {
            Event::Flight | Event::StepEnd | Event::Released(_) => {}
            Event::Impact(impact) => self.impact(impact.stop, impact.velocity_before, false),
            Event::Caught { impact, complete_chatter, beside } => {
                self.stuck = true;
                if impact.velocity_before != T::zero() {
                    self.impact(impact.stop, impact.velocity_before, complete_chatter);
                }
                for stop in beside.stops(flight) {
                    self.recurrence.count(stop, true);
                }
            }
            Event::HalfPeriod => {
                if self.stage == Stage::Observation {
                    self.recurrence.at_half_period(flight, &self.trajectory.point, T::of(RETURNED));
                }
            }
            Event::Strobe => self.strobe(flight, schedule),
        }
        if self.moves.are_too_many() {
            self.stage = Stage::Failed;
        }
    }

    #[inline(always)]
    fn impact(&mut self, stop: Stop, velocity: T, complete_chatter: bool) {
        self.recurrence.count(stop, complete_chatter);
        self.impacts += 1;
        self.impacts_total = self.impacts_total.saturating_add(1);
        let speed = velocity.abs();
        self.peak = if speed > self.peak { speed } else { self.peak };
    }

    #[inline(always)]
    fn strobe(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        let point = self.trajectory.point;
        self.moves.pass_period();
        self.periods += 1;
        if !point.state.is_finite() {
            self.stage = Stage::Failed;
            return;
        }
        for (k, normal) in flight.normals().iter().enumerate() {
            if self.trajectory.contact.is_clamped_along(k) {
                self.recurrence.count(Stop(normal.stop[0]), true);
                self.recurrence.count(Stop(normal.stop[1]), true);
            }
        }
        if self.stage == Stage::Transient {
            self.settle(flight, schedule);
        } else {
            self.observe(flight, schedule);
        }
    }

    /// A strobe of the transient: may it end here?
    #[inline(always)]
    fn settle(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        let point = self.trajectory.point;
        if !schedule.fixed_periods {
            if self.trajectory.contact.is_free() && is_quiet(flight, &point) {
                self.stage = Stage::Quiet;
                return;
            }
            self.recurrence.at_strobe(&point, T::of(T::SETTLED), schedule.max_period, false);
            let at_rest = self.recurrence.is_within(T::of(T::AT_REST));
            if self.recurrence.holds_for(if at_rest { SETTLING_AT_REST } else { SETTLING }) {
                let needed = SETTLED_OBSERVATION.max(4 * self.recurrence.n);
                self.begin_observation(flight, needed.min(schedule.observe));
                return;
            }
        }
        if self.periods >= schedule.transient {
            self.begin_observation(flight, schedule.observe);
        }
    }

    fn begin_observation(&mut self, flight: &Flight<T, N>, observe: u32) {
        let point = self.trajectory.point;
        self.stage = Stage::Observation;
        self.observe = observe;
        self.observed = 0;
        self.impacts = 0;
        self.peak = T::zero();
        self.stuck = false;
        self.loss = Loss::none(!self.trajectory.contact.is_free());
        // While a mass rests, nothing can deviate that it does not carry.
        self.tangent = Tangent::seed().caught(flight, self.trajectory.contact);
        self.recurrence = Recurrence::anchored(point.state);
        self.exponent = Exponent::over(observe);
        self.spread = Spread::about(&point);
        self.grown = T::zero();
    }

    /// A strobe of the observation.
    #[inline(always)]
    fn observe(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        let point = self.trajectory.point;
        self.observed += 1;
        let half = self.observe / 2;
        let growth = self.exponent.at_strobe(&mut self.tangent);
        self.recurrence.at_strobe(&point, T::of(RETURNED), schedule.max_period, self.observed >= half);
        self.grown = if self.recurrence.since == 0 { T::zero() } else { self.grown + growth };
        if self.observed <= 2 * half {
            self.spread.at_strobe(&point, self.observed > half);
        }
        if self.observed < self.observe {
            return;
        }
        let early = self.observe < schedule.observe;
        if early && !self.recurrence.holds_for(self.proof()) {
            // It had not settled after all: go on as if nothing had been seen.
            self.recurrence = Recurrence::anchored(point.state);
            self.stage = Stage::Transient;
            if self.periods >= schedule.transient {
                self.begin_observation(flight, schedule.observe);
            }
        } else {
            self.stage = Stage::Observed;
        }
    }

    /// Periods for which the state must have kept returning when the observation ends.
    pub(super) fn proof(&self) -> u32 {
        (self.observe / 4).min(SETTLING)
    }
}
