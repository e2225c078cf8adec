//! A trajectory under control: what each of its moves and its returns to σ changes, and its outcome.

use super::actuated::Actuated;
use super::deviation::Deviations;
use super::memory::{LONGEST, Memory, added};
use super::method::{Action, Controller, Method, Seen, length};
use super::outcome::{NEVER, Outcome};
use super::progress::Progress;
use super::schedule::ControlSchedule;
use super::section::Section;
use super::witness::{Return, Witness};
use crate::analysis::constants::{CHAOTIC_GROWTH, MOST_MOVES, NEUTRAL_GROWTH, RETURNED, SIGNIFICANCE};
use crate::analysis::{Counts, Exponent, INFINITELY_MANY, Regime, Spread, Verdict};
use crate::dynamics::{Event, Impact, Move, Stop, Tangent, Trajectory};
use crate::model::{Flight, Real};

/// Forcing periods without an impact at A after which σ counts as never reached.
pub const LONGEST_PASSAGE: u32 = 1000;

/// A component of a point on σ larger than this is beyond all bounds: static deflections are of order one.
pub const RUNAWAY: f64 = 1e3;

/// Iterates for which a settled motion must have kept returning before it finishes early.
pub const SETTLING: u32 = 64;

/// A trajectory under control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Controlled<T: Real, D: Actuated<T> = ()> {
    /// The trajectory.
    pub trajectory: Trajectory<T, 2, D>,
    pub(super) tangent: D::Deviation,
    controller: Controller<T>,
    /// The last points on σ.
    pub memory: Memory<T>,
    deviations: Deviations<T>,
    exponent: Exponent<T>,
    spread: Spread<T, 2>,
    /// Where it is in its schedule.
    pub progress: Progress,
    /// Returns to σ so far.
    pub(super) iterates: u32,
    /// Iterates observed so far.
    observed: u32,
    /// Forcing periods of the observed iterates.
    observed_turns: T,
    /// Forcing periods since the start.
    periods: u32,
    /// Forcing periods since the last return.
    passage: u32,
    /// Moves since the last strobe or correction.
    moves: u32,
    at_b: u32,
    /// The mirror image of the last impact at Ā.
    mirrored: Section<T>,
    impacts: u32,
    impacts_total: u32,
    peak: T,
    /// 1 + the returns before the first mass last rested on a stop; 0 if it never did.
    stuck: u32,
    /// Whether control has erased a deviation altogether: the motion has no exponent then.
    erased: bool,
    escapes: u32,
    effort: T,
    signal: T,
}

impl<T: Real, D: Actuated<T>> Controlled<T, D> {
    /// Begins with a trajectory.
    pub fn new(
        trajectory: Trajectory<T, 2, D>,
        controller: Controller<T>,
        schedule: &ControlSchedule,
    ) -> Self {
        Controlled {
            trajectory,
            tangent: trajectory.point.drive.deviating(Tangent::seed(), T::zero()),
            controller,
            memory: Memory::new(schedule.max_period),
            deviations: Deviations::seed(),
            exponent: Exponent::over(schedule.observed()),
            spread: Spread::about(&trajectory.point),
            progress: Progress::Settling,
            iterates: 0,
            observed: 0,
            observed_turns: T::zero(),
            periods: 0,
            passage: 0,
            moves: 0,
            at_b: 0,
            mirrored: Section::new([T::zero(); 4]),
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
    pub fn force(&mut self, flight: &Flight<T, 2>) {
        let section = Section::of(flight, &self.trajectory);
        let turns = T::zero();
        let seen = Seen { section, turns, periods: 0, controlled: 0, memory: &self.memory };
        let Action { force, phase, .. } = self.controller.act(&seen);
        let Trajectory { mut point, contact, step, offset, .. } = self.trajectory;
        point.drive = point.drive.actuated(force, phase);
        self.trajectory = Trajectory::from_point(flight, point, contact, step, offset);
    }

    #[inline(always)]
    pub(super) fn note(
        &mut self,
        flight: &Flight<T, 2>,
        schedule: &ControlSchedule,
        taken: &Move<T>,
        witness: &mut impl Witness<T, D>,
    ) {
        self.moves += 1;
        if !taken.contact.is_free() {
            self.stuck = self.iterates + 1;
        }
        match taken.event {
            Event::Impact(impact) => self.impact(flight, schedule, &impact, false, witness),
            Event::Caught { impact, complete_chatter } => {
                self.stuck = self.iterates + 1;
                self.impact(flight, schedule, &impact, complete_chatter, witness);
            }
            Event::Strobe => self.strobe(),
            Event::Flight | Event::StepEnd | Event::HalfPeriod | Event::Released(_) => {}
        }
        if self.moves > MOST_MOVES {
            self.progress = Progress::Failed;
        }
    }

    #[inline(always)]
    fn impact(
        &mut self,
        flight: &Flight<T, 2>,
        schedule: &ControlSchedule,
        impact: &Impact<T>,
        complete: bool,
        witness: &mut impl Witness<T, D>,
    ) {
        if impact.velocity_before == T::zero() {
            return;
        }
        let count = if complete { u32::from(INFINITELY_MANY) } else { 1 };
        self.impacts += 1;
        self.impacts_total = self.impacts_total.saturating_add(1);
        let speed = impact.velocity_before.abs();
        self.peak = if speed > self.peak { speed } else { self.peak };
        if impact.stop == Stop::A {
            self.arrive(flight, schedule, count, witness);
        } else {
            self.at_b = added(self.at_b, count);
            self.mirrored = Section::mirrored(flight, &self.trajectory);
        }
    }

    fn strobe(&mut self) {
        self.moves = 0;
        self.periods += 1;
        self.passage += 1;
        if !self.trajectory.point.state.is_finite() {
            self.progress = Progress::Failed;
        } else if self.passage > LONGEST_PASSAGE || self.trajectory.contact.is_clamped() {
            self.progress = Progress::Lost;
        }
    }

    /// A return to σ.
    #[inline(always)]
    fn arrive(
        &mut self,
        flight: &Flight<T, 2>,
        schedule: &ControlSchedule,
        at_a: u32,
        witness: &mut impl Witness<T, D>,
    ) {
        let arrived = Section::of(flight, &self.trajectory);
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
        let deviation = self.deviations.arrived(flight, &self.trajectory, &D::tangent(&self.tangent));
        let mut action = if on { self.controller.act(&seen) } else { Action::none() };
        let mut section = arrived.plus(&action.correction);
        let escaped = section.components[0] > T::zero();
        if escaped {
            section = arrived;
            self.escapes += 1;
            action.correction = [T::zero(); 4];
        }
        if observing {
            let deviation =
                if escaped { deviation } else { self.deviations.passed(&self.controller, &seen, deviation) };
            self.deviations.push(deviation);
        }
        self.memory.push(section, turns, self.at_b, at_a);
        self.signal = action.signal;
        if on {
            self.effort = self.effort + (length(&action.correction) + action.force.abs());
            self.go_on_from(flight, &section, &action);
        }
        witness.returned(&Return {
            iterate: self.iterates,
            arrived,
            section,
            signal: action.signal,
            escaped,
            at_b: self.at_b,
            turns,
        });
        self.iterates += 1;
        self.passage = 0;
        self.at_b = 0;
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
    fn turns_to(&self, arrived: &Section<T>) -> T {
        if self.memory.seen == 0 {
            return T::zero();
        }
        let from = self.memory.points[0].components[3];
        T::of(f64::from(self.passage)) + (arrived.components[3] - from) * T::of(1.0 / std::f64::consts::TAU)
    }

    /// Leaves σ from a corrected point, under a force.
    fn go_on_from(&mut self, flight: &Flight<T, 2>, section: &Section<T>, action: &Action<T>) {
        let zero = T::zero();
        let drive = self.trajectory.point.drive.actuated(action.force, action.phase);
        if section.distance(&Section::new([zero; 4])) > T::of(RUNAWAY) {
            self.progress = Progress::Runaway;
            return;
        }
        let unchanged = action.correction.iter().all(|&value| value == zero);
        if unchanged && drive == self.trajectory.point.drive {
            return;
        }
        if unchanged {
            let Trajectory { mut point, contact, step, offset, .. } = self.trajectory;
            point.drive = drive;
            self.trajectory = Trajectory::from_point(flight, point, contact, step, offset);
        } else {
            let resting = !self.trajectory.contact.is_free();
            self.trajectory = section.trajectory(flight, resting, drive);
            // A phase that jumps back time and again never passes a strobe.
            self.moves = 0;
        }
    }

    /// Adds an iterate to the exponent.
    fn observe(&mut self, flight: &Flight<T, 2>, turns: T, schedule: &ControlSchedule) {
        self.observed += 1;
        self.observed_turns = self.observed_turns + turns;
        match self.deviations.growth() {
            Some(growth) => self.exponent.add(growth),
            None => self.erased = true,
        }
        let half = schedule.observed() / 2;
        if self.observed <= 2 * half {
            self.spread.at_strobe(&self.trajectory.point, self.observed > half);
        }
        self.tangent = self.deviations.leaving(flight, &self.trajectory, &self.controller);
    }

    /// Goes on to the next part of the schedule where it is due.
    fn schedule_on(&mut self, flight: &Flight<T, 2>, schedule: &ControlSchedule) {
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
            self.tangent = self.deviations.leaving(flight, &self.trajectory, &self.controller);
            self.spread = Spread::about(&self.trajectory.point);
        }
    }

    /// What the trajectory settled on.
    pub fn outcome(&self, schedule: &ControlSchedule) -> Outcome {
        let controlled = self.iterates.saturating_sub(schedule.from);
        let period = self.period(controlled);
        let regime = self.regime(period);
        let [n, p, q] = if period > 0 { self.memory.counts(period) } else { [0; 3] };
        let symmetric = period > 0 && n % 2 == 1 && p == q && self.is_symmetric(period);
        let point = if period > 0 { self.memory.hardest(period) } else { self.memory.points[0] };
        let measured = self.exponent.batches > 0 && !self.erased && self.observed_turns > T::zero();
        let lyapunov = if measured {
            let periods = self.observed_turns / T::of(f64::from(self.observed));
            self.exponent.per_period() / periods
        } else {
            T::nan()
        };
        let since = if period > 0 { self.memory.returning[period as usize - 1] } else { 0 };
        Outcome {
            verdict: Verdict {
                regime,
                n: n as u16,
                counts: Counts::new(&[p as u16, q as u16]),
                symmetric,
                lyapunov: lyapunov.widen() as f32,
                state: point.components.map(T::widen).into(),
                impacts: self.impacts,
                impacts_total: self.impacts_total,
                peak_impact_velocity: self.peak.widen() as f32,
                periods: self.periods,
                returning: 0,
            },
            period,
            iterates: self.iterates,
            converged_at: if period > 0 { since.saturating_sub(schedule.from) } else { NEVER },
            signal: self.signal.widen() as f32,
            runaway: self.progress == Progress::Runaway,
            escapes: self.escapes,
            effort: if controlled > 0 {
                (self.effort / T::of(f64::from(controlled))).widen() as f32
            } else {
                0.0
            },
        }
    }

    /// The period of the motion in iterates, 0 if there is none.
    fn period(&self, controlled: u32) -> u32 {
        if self.progress != Progress::Done {
            return 0;
        }
        self.memory.period((controlled / 4).min(SETTLING))
    }

    fn is_symmetric(&self, period: u32) -> bool {
        let points = &self.memory.points[..(period as usize).min(LONGEST)];
        points.iter().any(|point| point.distance(&self.mirrored) <= T::of(RETURNED))
    }

    fn regime(&self, period: u32) -> Regime {
        match self.progress {
            Progress::Failed => Regime::Failed,
            Progress::Lost if self.at_b == 0 => Regime::NoImpact,
            Progress::Lost | Progress::Settling | Progress::Runaway => Regime::Unresolved,
            _ if period > 0 && self.has_stuck_for(period) => Regime::PeriodicSticking,
            _ if period > 0 => Regime::Periodic,
            _ if self.has_stuck_for(self.observed) => Regime::AperiodicSticking,
            _ => self.irregular(),
        }
    }

    /// Whether the first mass rested on a stop in the last so many iterates.
    fn has_stuck_for(&self, iterates: u32) -> bool {
        self.stuck > 0 && self.stuck + iterates > self.iterates
    }

    /// The regime of a motion that does not return; see [`Observer`](crate::analysis::Observer).
    fn irregular(&self) -> Regime {
        let exponent = &self.exponent;
        if exponent.batches == 0 || self.erased {
            return Regime::Unresolved;
        }
        let growth = exponent.total_growth();
        let significant = exponent.per_period() > T::of(SIGNIFICANCE) * exponent.standard_error();
        if growth > T::of(CHAOTIC_GROWTH) && significant {
            Regime::Chaotic
        } else if growth.abs() < T::of(NEUTRAL_GROWTH) && self.spread.is_stationary(self.observed / 2) {
            Regime::QuasiPeriodic
        } else {
            Regime::Unresolved
        }
    }
}
