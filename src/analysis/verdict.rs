//! What an observed trajectory settled on.

use super::deciding::{Evidence, NEUTRAL_GROWTH};
use super::observation::NEUTRAL_RATE;
use super::observer::Observer;
use super::regime::{Counts, Measures, Regime, Verdict};
use super::stage::Stage;
use super::turn::{FORGETS, reported};
use crate::model::{Flight, Real, State, StateVector};

impl<T: Real, const N: usize> Observer<T, N> {
    /// What the trajectory settled on; labels count the impacts at the plant's stops in `label_order`.
    pub fn verdict(&self, flight: &Flight<T, N>, label_order: &[usize]) -> Verdict {
        let regime = self.regime();
        let recurrence = &self.recurrence;
        let count = |value: u32| if regime.is_periodic() { value as u16 } else { 0 };
        let late = regime.is_periodic() && self.is_late();
        let lost = if late { self.lately_lost } else { self.lost };
        let lyapunov = match regime {
            Regime::NoImpact => flight.linear_exponent,
            Regime::Failed => T::nan(),
            _ if self.turn.is_measured() && regime.is_periodic() => self.turn.exponent,
            _ if lost => T::of(FORGETS),
            _ if self.exponent.batches == 0 => T::nan(),
            // Growth from before the motion was reached does not count towards its exponent.
            _ if late => self.grown / T::of(f64::from(recurrence.since)),
            _ => self.exponent.per_period(),
        };
        // What came before an observation is not of it.
        let observed = self.stage == Stage::Observed;
        let (impacts, peak) = if observed { (self.impacts, self.peak) } else { (0, T::zero()) };
        let in_question = !regime.is_periodic() || late || self.is_within_turn();
        let returning =
            if regime.may_return() && in_question && recurrence.holds_for(0) { recurrence.n } else { 0 };
        Verdict {
            regime,
            n: count(recurrence.n),
            counts: Counts::in_order(&recurrence.impacts.map(count), label_order),
            symmetric: regime.is_periodic() && recurrence.n % 2 == 1 && recurrence.symmetric,
            lyapunov: reported(lyapunov.widen() as f32),
            state: StateVector::of(&self.state(flight, regime)),
            impacts,
            impacts_total: self.impacts_total,
            peak_impact_velocity: peak.widen() as f32,
            periods: self.periods,
            returning: returning as u16,
            measures: self.measures(flight),
        }
    }

    fn measures(&self, flight: &Flight<T, N>) -> Measures {
        if self.stage == Stage::Failed {
            return Measures { observed: 0, power: f32::NAN, contact: f32::NAN };
        }
        if self.stage != Stage::Observed {
            return Measures::default();
        }
        let time = T::of(f64::from(self.observed)) * (T::of(f64::from(flight.steps)) * flight.h);
        self.loss.measures(self.observed, time)
    }

    /// The state that is reported: where the trajectory ends, or of motion that decays onto the forced response without
    /// another impact, that response.
    fn state(&self, flight: &Flight<T, N>, regime: Regime) -> State<T, N> {
        let forced = regime == Regime::NoImpact && self.stage == Stage::Quiet && flight.quiet.decays;
        if forced { flight.quiet.forced } else { self.trajectory.present(flight).state }
    }

    /// Whether the state began to return only within the observation.
    fn is_late(&self) -> bool {
        self.recurrence.since < self.observed
    }

    /// Whether the observation ended within a turn of what returns: what was measured is no mean over whole ones.
    fn is_within_turn(&self) -> bool {
        self.recurrence.n > 0 && !self.observed.is_multiple_of(self.recurrence.n)
    }

    fn regime(&self) -> Regime {
        match self.stage {
            Stage::Failed => Regime::Failed,
            Stage::Quiet => Regime::NoImpact,
            _ if self.impacts == 0 && !self.stuck => Regime::NoImpact,
            _ if self.returns() && self.recurrence.impacts.iter().all(|&count| count == 0) && !self.stuck => {
                Regime::NoImpact
            }
            _ => self.evidence().regime(),
        }
    }

    /// Whether the strobe state has kept returning long enough for a period.
    fn returns(&self) -> bool {
        self.recurrence.holds_for(self.proof())
    }

    /// Whether what returns is a motion that was reached: nearby trajectories do not leave it.
    pub(super) fn is_settled(&self) -> bool {
        let stays = if self.turn.is_measured() {
            self.turn.exponent <= T::of(NEUTRAL_RATE)
        } else {
            self.grown <= T::of(NEUTRAL_GROWTH)
        };
        self.recurrence.is_settled() && stays
    }

    fn evidence(&self) -> Evidence<'_, T, N> {
        Evidence {
            returns: self.returns(),
            settled: self.is_settled(),
            sticks: self.stuck,
            exponent: Some(&self.exponent),
            spread: &self.spread,
            half: self.observe / 2,
        }
    }
}
