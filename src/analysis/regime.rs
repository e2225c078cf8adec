//! What a trajectory settles on, and the record that says so.

use serde::{Deserialize, Serialize};
use strum::{EnumCount, FromRepr, IntoStaticStr, VariantArray};

use crate::model::StateVector;
use crate::model::vector::MOST;

/// What a cell's trajectory settles on.
///
/// The discriminants are the codes of the data files and of the GPU, which gets them generated from here.
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    Hash,
    PartialOrd,
    Ord,
    Serialize,
    Deserialize,
    EnumCount,
    FromRepr,
    IntoStaticStr,
    VariantArray,
)]
#[serde(rename_all = "kebab-case")]
#[strum(serialize_all = "kebab-case")]
#[repr(u8)]
pub enum Regime {
    /// None of the others could be established in the periods given.
    Unresolved = 0,
    /// No contact in the observed window, or none any more once the motion had settled, or provably never again.
    #[strum(serialize = "no impact")]
    NoImpact = 1,
    /// N-p-q periodic motion, free of sticking.
    Periodic = 2,
    /// Periodic motion with sticking (after complete chatter, or at once where r = 0).
    #[strum(serialize = "periodic with sticking")]
    PeriodicSticking = 3,
    /// No period, largest Lyapunov exponent statistically zero.
    QuasiPeriodic = 4,
    /// Largest Lyapunov exponent significantly above zero.
    Chaotic = 5,
    /// No period up to the largest looked for, with sticking.
    #[strum(serialize = "aperiodic with sticking")]
    AperiodicSticking = 6,
    /// Growth without bounds, or too many moves to go on.
    Failed = 7,
    /// The start lies beyond a stop: no motion begins there.
    #[strum(serialize = "inadmissible start")]
    Inadmissible = 8,
}

impl Regime {
    /// Every regime, in the order of the codes.
    pub const ALL: [Regime; Regime::COUNT] =
        *Self::VARIANTS.first_chunk().expect("there are as many as are counted");

    /// The code written to data files.
    pub const fn code(self) -> u8 {
        self as u8
    }

    /// The name used in JSON, in legends and on the terminal.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// Whether a periodic motion may yet come out of a trajectory of this regime.
    pub(super) fn may_return(self) -> bool {
        !matches!(self, Regime::NoImpact | Regime::Failed | Regime::Inadmissible)
    }

    /// Whether motions of this regime carry an N-p-q label.
    pub fn is_periodic(self) -> bool {
        matches!(self, Regime::Periodic | Regime::PeriodicSticking)
    }
}

/// The impact count that stands for infinitely many impacts (complete chatter).
pub const INFINITELY_MANY: u16 = u16::MAX;

/// What became of one trajectory.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// What the trajectory settled on.
    pub regime: Regime,
    /// N, the forcing periods in one period of the motion; 0 where the regime is not periodic.
    pub n: u16,
    /// The impacts at each stop in one period of the motion, in the order of labels; zeros where the regime is not periodic.
    pub counts: Counts,
    /// Whether the motion is its own mirror image half a period later: x(t + Nπ/ω) = P x(t).
    pub symmetric: bool,
    /// Largest Lyapunov exponent per forcing period (natural logarithm), of the motion reached where it is periodic; NaN
    /// where it was not measured.
    pub lyapunov: f32,
    /// (x1 … xn, v1 … vn) at the end, at forcing phase 0; non-dimensional.
    pub state: StateVector,
    /// Impacts in the observed window.
    pub impacts: u32,
    /// Impacts over the whole trajectory, transient included (a measure of work, not written to files).
    pub impacts_total: u32,
    /// Largest |d·v−| before an impact of the observed window, d being the direction of the first stop on the same line;
    /// non-dimensional.
    pub peak_impact_velocity: f32,
    /// Forcing periods simulated.
    pub periods: u32,
    /// Forcing periods after which the strobe state comes back at the end where a look at the exact motion is called for:
    /// it still moves, may have a shorter period, or was not observed for whole turns; 0 elsewhere. Not written to files.
    pub returning: u16,
    /// What else was measured while it was observed.
    #[serde(default)]
    pub measures: Measures,
}

/// What was measured while a trajectory was observed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Measures {
    /// Forcing periods of the observation that the verdict rests on; 0 where there was none.
    pub observed: u32,
    /// Power that impacts take: Σ ½ (1 − r²) (d·v−)²/(dᵀM⁻¹d) over the observation, per unit of time, and what two stops with no
    /// room between them take of masses that are thrown on them; 0 where there was none since nothing impacts any more, NaN where
    /// the trajectory failed. Non-dimensional.
    pub power: f32,
    /// The share of the observation in which some contact held, from 0 to 1, rebounds that end in one left out; 0 and NaN as for the
    /// power.
    pub contact: f32,
}

impl Verdict {
    /// Impacts per forcing period of the observation, of a periodic motion in whole turns of it; NaN where there was none.
    pub fn impacts_per_period(&self) -> f32 {
        match self.measures.observed {
            0 => f32::NAN,
            _ if self.regime == Regime::Periodic => {
                let in_a_turn: u32 = self.counts.iter().map(|&count| u32::from(count)).sum();
                (f64::from(in_a_turn) / f64::from(self.n)) as f32
            }
            observed => (f64::from(self.impacts) / f64::from(observed)) as f32,
        }
    }

    /// Forcing periods before the observation that found the motion settled, those that a leap made needless left out; NaN
    /// where the trajectory did not settle.
    pub fn settling(&self) -> f32 {
        match self.regime.is_periodic() || self.regime == Regime::NoImpact {
            true => self.periods.saturating_sub(self.measures.observed) as f32,
            false => f32::NAN,
        }
    }

    /// A verdict of which only the motion matters, for tests.
    #[cfg(test)]
    pub(crate) fn of_motion(regime: Regime, [n, p, q]: [u16; 3], symmetric: bool) -> Self {
        Verdict {
            regime,
            n,
            counts: Counts::new(&[p, q]),
            symmetric,
            lyapunov: 0.0,
            state: [0.0; 4].into(),
            impacts: 0,
            impacts_total: 0,
            peak_impact_velocity: 0.0,
            periods: 1,
            returning: 0,
            measures: Measures::default(),
        }
    }

    /// "N-p-q" where periodic (∞ for infinitely many impacts), the regime's name elsewhere.
    pub fn label(&self) -> String {
        if self.regime.is_periodic() {
            motion_label(u32::from(self.n), &self.counts)
        } else {
            self.regime.name().to_owned()
        }
    }
}

impl Verdict {
    /// The impacts at the first stop in the order of labels: p, those at Ā, of the paper's oscillator.
    pub fn p(&self) -> u16 {
        self.counts.first().copied().unwrap_or(0)
    }

    /// The impacts at the second stop in the order of labels: q, those at A, of the paper's oscillator.
    pub fn q(&self) -> u16 {
        self.counts.get(1).copied().unwrap_or(0)
    }
}

/// Impacts at each stop in one period of a motion, in the order in which labels count them; [`INFINITELY_MANY`] with
/// complete chatter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Counts {
    values: [u16; MOST],
    stops: u8,
}

impl Counts {
    /// Counts in the order of labels, at most four.
    pub fn new(counts: &[u16]) -> Self {
        let mut values = [0; MOST];
        values[..counts.len()].copy_from_slice(counts);
        Counts { values, stops: counts.len() as u8 }
    }

    /// Counts given in the order of the plant's stops, brought into the order of labels.
    pub fn in_order(per_stop: &[u16], label_order: &[usize]) -> Self {
        let mut values = [0; MOST];
        for (value, &stop) in values.iter_mut().zip(label_order) {
            *value = per_stop[stop];
        }
        Counts { values, stops: label_order.len() as u8 }
    }

    /// The counts in the order of the plant's stops.
    pub fn per_stop(&self, label_order: &[usize]) -> Vec<u16> {
        let mut per_stop = vec![0; label_order.len()];
        for (&stop, &count) in label_order.iter().zip(self.iter()) {
            per_stop[stop] = count;
        }
        per_stop
    }
}

impl std::ops::Deref for Counts {
    type Target = [u16];

    fn deref(&self) -> &[u16] {
        &self.values[..usize::from(self.stops)]
    }
}

impl Serialize for Counts {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.iter())
    }
}

impl<'de> Deserialize<'de> for Counts {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let counts = Vec::<u16>::deserialize(deserializer)?;
        if counts.len() <= MOST {
            Ok(Counts::new(&counts))
        } else {
            Err(serde::de::Error::invalid_length(counts.len(), &"the counts of at most four stops"))
        }
    }
}

/// N and the impacts at each stop, "N-p-q" of the paper's motions, with ∞ for [`INFINITELY_MANY`] impacts.
pub fn motion_label(n: u32, counts: &[u16]) -> String {
    counts.iter().fold(n.to_string(), |label, &count| format!("{label}-{}", Count(count)))
}

/// An impact count as it is printed: a number, or ∞.
struct Count(u16);

impl std::fmt::Display for Count {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0 {
            INFINITELY_MANY => f.write_str("∞"),
            count => write!(f, "{count}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_follow_the_order_and_round_trip() {
        for (i, regime) in Regime::ALL.into_iter().enumerate() {
            assert_eq!(usize::from(regime.code()), i);
            assert_eq!(Regime::from_repr(regime.code()), Some(regime));
        }
        assert_eq!(Regime::from_repr(9), None);
    }
}
