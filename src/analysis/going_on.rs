//! What a longer look at a trajectory adds to the verdict on it.

use super::regime::{Measures, Regime, Verdict};

impl Verdict {
    /// The verdict on a trajectory that went on from where an earlier one left it, over the periods and impacts of both.
    #[must_use]
    pub fn going_on_from(self, earlier: &Verdict) -> Self {
        Verdict {
            periods: earlier.periods.saturating_add(self.periods),
            impacts_total: earlier.impacts_total.saturating_add(self.impacts_total),
            ..self
        }
    }

    /// The verdict on a trajectory without a period, with what was observed of it later, of which no other regime came out: means
    /// by the periods of both, and sticking if either sticks.
    #[must_use]
    pub fn observed_further(self, later: &Verdict) -> Self {
        let [own, more] = [&self, later].map(|verdict| f64::from(verdict.measures.observed));
        let mean = |a: f32, b: f32| match (a.is_nan(), b.is_nan()) {
            (_, true) => a,
            (true, false) => b,
            (false, false) => ((own * f64::from(a) + more * f64::from(b)) / (own + more)) as f32,
        };
        let sticks = later.regime == Regime::AperiodicSticking;
        Verdict {
            regime: if sticks { later.regime } else { self.regime },
            lyapunov: mean(self.lyapunov, later.lyapunov),
            state: later.state,
            impacts: self.impacts.saturating_add(later.impacts),
            peak_impact_velocity: self.peak_impact_velocity.max(later.peak_impact_velocity),
            measures: Measures {
                observed: self.measures.observed.saturating_add(later.measures.observed),
                power: mean(self.measures.power, later.measures.power),
                contact: mean(self.measures.contact, later.measures.contact),
            },
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn observed(periods: u32, value: f32) -> Verdict {
        let measures = Measures { observed: periods, power: 2.0 * value, contact: 0.5 * value };
        let motion = Verdict::of_motion(Regime::Chaotic, [0; 3], false);
        Verdict {
            lyapunov: value,
            impacts: 3 * periods,
            peak_impact_velocity: value,
            periods,
            measures,
            ..motion
        }
    }

    #[test]
    fn what_is_observed_further_counts_by_its_periods() {
        let (first, later) = (observed(75, 0.5), observed(25, 0.9));
        let both = first.observed_further(&later);
        assert!((both.lyapunov - 0.6).abs() < 1e-6, "{}", both.lyapunov);
        assert!((both.measures.power - 1.2).abs() < 1e-6 && (both.measures.contact - 0.3).abs() < 1e-6);
        assert_eq!((both.impacts, both.measures.observed), (300, 100));
        assert_eq!((both.peak_impact_velocity, both.impacts_per_period()), (0.9, 3.0));
        assert_eq!((both.regime, both.periods), (first.regime, first.periods));
        let end = Verdict { state: [1.0, 2.0, 3.0, 4.0].into(), ..later };
        assert_eq!(first.observed_further(&end).state, end.state, "it ends where the later look ends");
        assert_ne!(first.observed_further(&end).state, first.state);
    }

    #[test]
    fn what_sticks_at_any_time_is_not_chaos_alone() {
        let (chaos, sticks) = (Regime::Chaotic, Regime::AperiodicSticking);
        for (first, later, both) in [(chaos, chaos, chaos), (chaos, sticks, sticks), (sticks, chaos, sticks)]
        {
            let [first, later] = [first, later].map(|regime| Verdict { regime, ..observed(9, 0.5) });
            assert_eq!(first.observed_further(&later).regime, both);
        }
        let undecided = Verdict { regime: Regime::Unresolved, lyapunov: f32::NAN, ..observed(9, 0.5) };
        let both = observed(9, 0.7).observed_further(&undecided);
        assert_eq!((both.regime, both.lyapunov), (chaos, 0.7), "what was not measured takes nothing away");
    }

    #[test]
    fn what_goes_on_counts_the_periods_of_both() {
        let (first, later) = (observed(75, 0.5), observed(25, 0.9));
        let both = later.going_on_from(&first);
        assert_eq!((both.periods, both.lyapunov), (100, 0.9));
        assert_eq!(both.impacts_total, first.impacts_total + later.impacts_total);
    }
}
