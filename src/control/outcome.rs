//! What became of a controlled trajectory.

use serde::{Deserialize, Serialize};

use super::controlled::{Controlled, SETTLING};
use super::memory::{Counts, LONGEST};
use super::progress::Progress;
use super::schedule::ControlSchedule;
use super::section_point::SectionPoint;
use super::values::SectionValues;
use crate::analysis::constants::{PROOF_SHARE, RETURNED};
use crate::analysis::{self, Evidence, Regime, Verdict};
use crate::model::vector::MOST;
use crate::model::{Flight, Real, System};

/// The convergence time of a motion that did not converge.
pub const NEVER: u32 = u32::MAX;

/// What became of one controlled trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Outcome {
    /// The motion reached. Its `state` is that of the point on σ, at the phase of that point; N counts flight time in
    /// forcing periods, rounded, since a correction may jump in phase.
    pub verdict: Verdict,
    /// The point on σ, that of the hardest impact at its stop where a period has several: (v1+, x2, v2, τ) on the paper's;
    /// see [`section_names`](super::section_names).
    pub section: SectionValues<f64>,
    /// Iterates in one period of the motion, 0 where it has none.
    pub period: u32,
    /// Iterates followed.
    pub iterates: u32,
    /// Iterates from switching control on until the points kept returning, or [`NEVER`].
    pub converged_at: u32,
    /// The control signal at the end: B, or the length of the correction; non-dimensional.
    pub signal: f32,
    /// Whether control drove the points on σ beyond all bounds, a thousand times [`Flight::reach`](crate::model::Flight::reach), where the
    /// run ended.
    pub runaway: bool,
    /// Corrections left out because they led off the section: into its stop, or beyond another.
    pub escapes: u32,
    /// Mean length of the corrections made, or mean |B| of a force, per controlled iterate; non-dimensional.
    pub effort: f32,
}

impl<T: Real, const N: usize, const M: usize> Controlled<T, N, M> {
    /// What the trajectory of a system settled on.
    pub fn outcome(&self, flight: &Flight<T, M>, schedule: &ControlSchedule, system: &System) -> Outcome {
        let controlled = self.iterates.saturating_sub(schedule.from);
        let period = self.period(controlled);
        let regime = self.regime(period);
        let (n, impacts) = if period > 0 { self.memory.counts(period) } else { (0, [0; MOST]) };
        let symmetric = period > 0 && n % 2 == 1 && self.is_symmetric(flight, period, &impacts);
        let approach = |point: &SectionPoint<T, N>| {
            self.surface.approach(flight, &self.surface.state(flight, &point.components))
        };
        let point = if period > 0 { self.memory.hardest(period, approach) } else { self.memory.points[0] };
        let section = SectionValues::of(&point.components).map(T::widen);
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
                counts: analysis::Counts::in_order(&impacts.map(|count| count as u16), system.label_order()),
                symmetric,
                lyapunov: lyapunov.widen() as f32,
                state: section.state(system.plant(), self.surface.stop),
                impacts: self.impacts,
                impacts_total: self.impacts_total,
                peak_impact_velocity: self.peak.widen() as f32,
                periods: self.periods,
                returning: 0,
                measures: analysis::Measures::default(),
            },
            section,
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
        self.memory.period((controlled / PROOF_SHARE).min(SETTLING))
    }

    /// Whether the mirror image of the motion half its period later is the motion, as far as its points on σ tell and the
    /// impacts at stops that are each other's images.
    fn is_symmetric(&self, flight: &Flight<T, M>, period: u32, impacts: &Counts) -> bool {
        let Some(mirror) = self.surface.mirror else { return false };
        let points = &self.memory.points[..(period as usize).min(LONGEST)];
        (0..MOST).all(|stop| impacts[stop] == impacts[mirror[stop].index()])
            && points.iter().any(|point| self.mirrored.away_from(point, flight.unit) <= T::of(RETURNED))
    }

    fn regime(&self, period: u32) -> Regime {
        match self.progress {
            Progress::Failed => Regime::Failed,
            Progress::Lost if self.at_stops == [0; MOST] && !self.has_stuck_for(0) => Regime::NoImpact,
            Progress::Lost | Progress::Settling | Progress::Runaway => Regime::Unresolved,
            Progress::Observed | Progress::Done => self.evidence(period).regime(),
        }
    }

    fn evidence(&self, period: u32) -> Evidence<'_, T, N> {
        let returns = period > 0;
        Evidence {
            returns,
            settled: returns,
            sticks: self.has_stuck_for(if returns { period } else { self.observed }),
            exponent: (!self.erased).then_some(&self.exponent),
            spread: &self.spread,
            half: self.observed / 2,
        }
    }

    /// Whether a mass rested on a stop in the last so many iterates, or since.
    fn has_stuck_for(&self, iterates: u32) -> bool {
        self.stuck > 0 && self.stuck + iterates > self.iterates
    }
}
