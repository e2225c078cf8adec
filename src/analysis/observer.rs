//! One trajectory followed to its verdict: transient, settling, observation.

use super::exponent::Exponent;
use super::loss::Loss;
use super::observation::Observation;
use super::recurrence::Recurrence;
use super::schedule::Schedule;
use super::spread::Spread;
use super::stage::Stage;
use super::turn::Turn;
use crate::dynamics::{Contact, Event, Moves, Tangent, Trajectory};
use crate::model::{Flight, Real, State};

/// How often a trajectory may leap, or measure the map of a turn in order to: what that does not lead to is waited for.
pub const MOST_LEAPS: u32 = 6;

/// A trajectory and everything that is noted about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Observer<T, const N: usize> {
    pub(super) trajectory: Trajectory<T, N>,
    pub(super) tangent: Tangent<T, N>,
    pub(super) recurrence: Recurrence<T, N>,
    pub(super) exponent: Exponent<T>,
    /// The linear map of a motion that has settled, or of one that returns.
    pub(super) turn: Turn<T, N>,
    /// How often it may still leap to where its returns lead, or measure a turn in order to.
    pub(super) leaps: u32,
    pub(super) spread: Spread<T, N>,
    /// Logarithmic growth of the tangent vector from when the recurrence's anchor was set to when it was measured last.
    pub(super) grown: T,
    /// Whether the tangent vector was lost altogether since the observation began: the exponent is −∞.
    pub(super) lost: bool,
    /// The same since the recurrence's anchor was set.
    pub(super) lately_lost: bool,
    pub(super) stage: Stage,
    /// Forcing periods since the start.
    pub(super) periods: u32,
    /// Forcing periods since the observation began.
    pub(super) observed: u32,
    /// Forcing periods of the observation.
    pub(super) observe: u32,
    /// Moves since the last strobe; steps and passing phase π are none.
    pub(super) moves: Moves,
    /// Impacts since the observation began.
    pub(super) impacts: u32,
    /// Impacts since the start.
    pub(super) impacts_total: u32,
    /// Largest |d·v−| since the observation began, of any stop.
    pub(super) peak: T,
    /// Whether a mass rested on a stop since the observation began.
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
            turn: Turn::none(),
            leaps: MOST_LEAPS,
            spread: Spread::about(&trajectory.point.state),
            grown: T::zero(),
            lost: false,
            lately_lost: false,
            stage: Stage::Transient,
            periods: 0,
            observed: 0,
            observe: schedule.observe,
            moves: Moves::default(),
            impacts: 0,
            impacts_total: 0,
            peak: T::zero(),
            stuck: false,
            loss: Loss::none(Contact::FREE),
        };
        if schedule.transient == 0 {
            observer.begin_observation(flight, Observation::over(schedule.observe));
        }
        observer
    }

    /// Follows the trajectory to its end.
    pub fn follow(&mut self, flight: &Flight<T, N>, schedule: &Schedule) {
        self.follow_listening(flight, schedule, &mut |_: &Trajectory<T, N>, _: &Event<T>| ());
    }

    /// Follows the trajectory to its end; `listen` is told of every event of the observation, with the trajectory
    /// just after it, whose point is [`Trajectory::present`].
    #[inline(always)]
    pub fn follow_listening(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        listen: &mut impl FnMut(&Trajectory<T, N>, &Event<T>),
    ) {
        while !self.is_done() {
            self.follow_to_phase(flight, schedule, listen);
        }
    }

    /// Follows the trajectory to the next phase 0 or π, on copies.
    #[inline(always)]
    fn follow_to_phase(
        &mut self,
        flight: &Flight<T, N>,
        schedule: &Schedule,
        listen: &mut impl FnMut(&Trajectory<T, N>, &Event<T>),
    ) {
        let (mut trajectory, mut tangent) = (self.trajectory, self.tangent);
        let observing = self.stage == Stage::Observation;
        loop {
            let taken = trajectory.advance_blindly(flight, carried(&mut tangent, observing));
            if taken.event == Event::StepEnd {
                continue;
            }
            let at_phase = matches!(taken.event, Event::HalfPeriod | Event::Strobe);
            if at_phase {
                (self.trajectory, self.tangent) = (trajectory, tangent);
            }
            if observing {
                listen(&trajectory, &taken.event);
                self.loss.note(flight, &trajectory, &taken);
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
        self.stage.is_over()
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
            let tangents = carried(&mut self.tangent, self.stage == Stage::Observation);
            let taken = if warily {
                self.trajectory.approach(flight, tangents)
            } else {
                self.trajectory.advance_blindly(flight, tangents)
            };
            if taken.event != Event::StepEnd {
                if self.stage == Stage::Observation {
                    self.loss.note(flight, &self.trajectory, &taken);
                }
                self.note(flight, schedule, &taken);
            }
            warily = false;
        }
    }
}

/// What a trajectory carries along: its tangent while it is observed, else nothing.
#[inline(always)]
fn carried<T, const N: usize>(tangent: &mut Tangent<T, N>, observed: bool) -> &mut [Tangent<T, N>] {
    if observed { std::slice::from_mut(tangent) } else { &mut [] }
}
