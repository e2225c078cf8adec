//! What a longer look at a trajectory adds to the verdict on it.

use super::regime::{Measures, Verdict};

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

    /// The same verdict, with what was observed of the trajectory later as well: means over the periods of both.
    #[must_use]
    pub fn observed_further(self, later: &Verdict) -> Self {
        let [own, more] = [&self, later].map(|verdict| f64::from(verdict.measures.observed));
        let mean = |a: f32, b: f32| ((own * f64::from(a) + more * f64::from(b)) / (own + more)) as f32;
        Verdict {
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
    use crate::analysis::Regime;

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
    fn what_goes_on_counts_the_periods_of_both() {
        let (first, later) = (observed(75, 0.5), observed(25, 0.9));
        let both = later.going_on_from(&first);
        assert_eq!((both.periods, both.lyapunov), (100, 0.9));
        assert_eq!(both.impacts_total, first.impacts_total + later.impacts_total);
    }
}
