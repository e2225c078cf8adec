//! A trajectory under control: what each of its moves and its returns to σ changes.

use super::action::{Action, Seen};
use super::components::Components;
use super::deviation::Deviations;
use super::memory::{Counts, Memory, added};
use super::methods::Controller;
use super::progress::Progress;
use super::schedule::ControlSchedule;
use super::section_point::SectionPoint;
use super::surface::Surface;
use super::values::SectionValues;
use super::witness::{Return, Witness};
use crate::analysis::{Exponent, INFINITELY_MANY, Spread};
use crate::dynamics::{Event, Impact, Move, Moves, Tangent, Trajectory};
use crate::model::vector::MOST;
use crate::model::{Flight, Real};

/// Forcing periods without an impact at the section's stop after which σ counts as never reached.
pub const LONGEST_PASSAGE: u32 = 1000;

/// Iterates for which a settled motion must have kept returning before it finishes early.
pub const SETTLING: u32 = 64;

/// A trajectory under control, of a system with N coordinates: it flies in M, one of which may be the force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controlled<T, const N: usize, const M: usize> {
    /// The trajectory.
    pub trajectory: Trajectory<T, M>,
    pub(super) tangent: Tangent<T, M>,
    pub(super) surface: Surface,
    pub(super) controller: Controller<T>,
    /// The last points on σ.
    pub memory: Memory<T, N>,
    deviations: Deviations<T, N>,
    pub(super) exponent: Exponent<T>,
    pub(super) spread: Spread<T, N>,
    /// Where it is in its schedule.
    pub progress: Progress,
    /// Returns to σ so far.
    pub(super) iterates: u32,
    /// Iterates observed so far.
    pub(super) observed: u32,
    /// Forcing periods of the observed iterates.
    pub(super) observed_turns: T,
    /// Forcing periods since the start.
    pub(super) periods: u32,
    /// Forcing periods since the last return.
    passage: u32,
    /// Moves since the last strobe or correction.
    pub(super) moves: Moves,
    /// Impacts at each stop since the last return.
    pub(super) at_stops: Counts,
    /// The mirror image of the last impact at the twin of the section's stop.
    pub(super) mirrored: SectionPoint<T, N>,
    pub(super) impacts: u32,
    pub(super) impacts_total: u32,
    pub(super) peak: T,
    /// 1 + the returns before a mass last rested on a stop; 0 if none ever did.
    pub(super) stuck: u32,
    /// Whether control has erased a deviation altogether: the motion has no exponent then.
    pub(super) erased: bool,
    pub(super) escapes: u32,
    pub(super) effort: T,
    pub(super) signal: T,
}

impl<T: Real, const N: usize, const M: usize> Controlled<T, N, M> {
    /// Begins with a trajectory; `surface` is that of the controller's stop.
    pub fn new(
        trajectory: Trajectory<T, M>,
        surface: Surface,
        controller: Controller<T>,
        schedule: &ControlSchedule,
    ) -> Self {
        Controlled {
            trajectory,
            tangent: Tangent::seed(),
            surface,
            controller,
            memory: Memory::new(schedule.max_period),
            deviations: Deviations::seed(),
            exponent: Exponent::over(schedule.observed()),
            spread: Spread::about(&trajectory.point.state.first()),
            progress: Progress::Settling,
            iterates: 0,
            observed: 0,
            observed_turns: T::zero(),
            periods: 0,
            passage: 0,
            moves: Moves::default(),
            at_stops: [0; MOST],
            mirrored: SectionPoint::zero(),
            impacts: 0,
            impacts_total: 0,
            peak: T::zero(),
            stuck: 0,
            erased: false,
            escapes: 0,
            effort: T::zero(),
            signal: T::zero(),
        }
    }

    /// Applies the force that the controller sets at the present point, and nothing else.
    pub fn force(&mut self, flight: &Flight<T, M>) {
        let section = SectionPoint::of(flight, &self.surface, &self.trajectory);
        let turns = T::zero();
        let seen = Seen { section, turns, periods: 0, controlled: 0, memory: &self.memory };
        let action = self.controller.act(&seen);
        self.set_force(flight, &action);
    }

    #[inline(always)]
    pub(super) fn note(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        taken: &Move<T>,
        witness: &mut impl Witness<T>,
    ) {
        self.moves.add();
        if !taken.contact.is_free() && !taken.contact.is_clamped_only() {
            self.stuck = self.iterates + 1;
        }
        match taken.event {
            Event::Impact(impact) => self.impact(flight, schedule, &impact, false, witness),
            Event::Caught { impact, complete_chatter, beside, .. } => {
                self.stuck = self.iterates + 1;
                // Before the return: they belong to it.
                for stop in beside.stops(flight) {
                    self.at_stops[stop.index()] = u32::from(INFINITELY_MANY);
                }
                self.impact(flight, schedule, &impact, complete_chatter, witness);
            }
            Event::Strobe => self.strobe(),
            Event::Flight | Event::StepEnd | Event::HalfPeriod | Event::Released(_) => {}
        }
        if self.moves.are_too_many() {
            self.progress = Progress::Failed;
        }
    }

    #[inline(always)]
    fn impact(
        &mut self,
        flight: &Flight<T, M>,
        schedule: &ControlSchedule,
        impact: &Impact<T>,
        complete: bool,
        witness: &mut impl Witness<T>,
    ) {
        if impact.velocity_before == T::zero() {
            return;
        }
        let count = if complete { u32::from(INFINITELY_MANY) } else { 1 };
        self.impacts = self.impacts.saturating_add(1);
        self.impacts_total = self.impacts_total.saturating_add(1);
        let speed = impact.velocity_before.abs();
        self.peak = if speed > self.peak { speed } else { self.peak };
        let here = &mut self.at_stops[impact.stop.index()];
        *here = added(*here, count);
        if self.surface.twin() == Some(impact.stop)
            && let Some(mirrored) = SectionPoint::mirrored(flight, &self.surface, &self.trajectory)
        {
            self.mirrored = mirrored;
        }
        if impact.stop == self.surface.stop {
            self.arrive(flight, schedule, witness);
        }
    }

    fn strobe(&mut self) {
        self.moves.pass_period();
        self.periods += 1;
        self.passage += 1;
        if !self.trajectory.point.state.is_bounded() {
            self.progress = Progress::Failed;
        } else if self.passage > LONGEST_PASSAGE || self.is_clamped() {
            self.progress = Progress::Lost;
        }
    }

    /// Whether the section's stop holds a mass for ever.
    fn is_clamped(&self) -> bool {
        self.trajectory.contact.is_clamped_along(self.surface.end.normal)
    }

    /// A return to σ.
    #[inline(always)]
    fn arrive(&mut self, flight: &Flight<T, M>, schedule: &ControlSchedule, witness: &mut impl Witness<T>) {
        let arrived = SectionPoint::of(flight, &self.surface, &self.trajectory);
        if !arrived.is_finite() {
            self.progress = Progress::Failed;
            return;
        }
        let turns = self.turns_to(&arrived);
        let on = self.iterates >= schedule.from;
        if self.iterates == schedule.from {
            self.memory.start_over();
        }
        let seen = Seen {
            section: arrived,
            turns,
            periods: self.periods,
            controlled: if on { self.iterates - schedule.from } else { 0 },
            memory: &self.memory,
        };
        let observing = self.progress == Progress::Observed;
        let mut action = if on { self.controller.act(&seen) } else { Action::none() };
        let mut section = arrived.plus(&action.correction);
        let escaped = !action.correction.is_zero() && !self.admits(flight, &section);
        if escaped {
            section = arrived;
            self.escapes += 1;
            action.correction = Components::zero();
        }
        if observing {
            let deviation = self.deviations.arrived(flight, &self.surface, &self.trajectory, &self.tangent);
            let deviation =
                if escaped { deviation } else { self.deviations.passed(&self.controller, &seen, deviation) };
            self.deviations.push(deviation);
        }
        self.memory.push(flight.unit, section, turns, self.at_stops);
        self.signal = action.signal;
        if on {
            self.effort = self.effort + (action.correction.length() + action.force.abs());
            self.go_on_from(flight, &section, &action);
        }
        witness.returned(&Return {
            iterate: self.iterates,
            stop: self.surface.stop,
            arrived: SectionValues::of(&arrived.components),
            section: SectionValues::of(&section.components),
            velocity: self.velocity_along(flight, &section),
            signal: action.signal,
            escaped,
            impacts: self.at_stops,
            turns,
        });
        self.iterates += 1;
        self.passage = 0;
        self.at_stops = [0; MOST];
        if self.progress == Progress::Runaway {
            return;
        }
        if observing {
            self.observe(flight, turns, schedule);
        }
        if on {
            self.schedule_on(flight, schedule);
        }
    }

    /// Forcing periods since the last return.
    fn turns_to(&self, arrived: &SectionPoint<T, N>) -> T {
        if self.memory.seen == 0 {
            return T::zero();
        }
        let from = self.memory.points[0].tau();
        T::of(f64::from(self.passage)) + (arrived.tau() - from) * T::of(1.0 / std::f64::consts::TAU)
    }

    /// Adds an iterate to the exponent.
    fn observe(&mut self, flight: &Flight<T, M>, turns: T, schedule: &ControlSchedule) {
        self.observed += 1;
        self.observed_turns = self.observed_turns + turns;
        match self.deviations.growth() {
            Some(growth) => self.exponent.add(growth),
            None => self.erased = true,
        }
        let half = schedule.observed() / 2;
        if self.observed <= 2 * half {
            self.spread.at_strobe(&self.trajectory.point.state.first(), self.observed > half);
        }
        self.tangent = self.deviations.leaving(flight, &self.surface, &self.trajectory, &self.controller);
    }

    /// Goes on to the next part of the schedule where it is due.
    fn schedule_on(&mut self, flight: &Flight<T, M>, schedule: &ControlSchedule) {
        let settled = !schedule.fixed && self.controller.is_at_rest() && self.memory.is_settled(SETTLING);
        if self.iterates >= schedule.iterates || settled {
            self.progress = Progress::Done;
        } else if self.progress == Progress::Settling
            && self.iterates >= schedule.iterates - schedule.observed()
        {
            self.progress = Progress::Observed;
            self.impacts = 0;
            self.peak = T::zero();
            self.deviations = Deviations::seed();
            self.tangent = self.deviations.leaving(flight, &self.surface, &self.trajectory, &self.controller);
            self.spread = Spread::about(&self.trajectory.point.state.first());
        }
    }
}
