//! What the regions of a plane are told apart by.

use crate::analysis::{Regime, Verdict, motion_label};
use crate::model::vector::MOST;

/// What two cells have in common that are drawn as one region.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Motion {
    /// What the trajectory settles on.
    pub regime: Regime,
    /// N and the impacts at each stop in the order of labels where periodic, zeros elsewhere.
    pub counts: [u16; 1 + MOST],
    /// Whether the motion is its own mirror image; only motions with p = q can be.
    pub symmetric: bool,
}

impl Motion {
    /// The motion of a cell.
    pub fn of(verdict: &Verdict) -> Self {
        let Verdict { regime, n, counts, symmetric, .. } = *verdict;
        if regime.is_periodic() {
            let counts =
                std::array::from_fn(|i| if i == 0 { n } else { counts.get(i - 1).copied().unwrap_or(0) });
            Motion { regime, counts, symmetric }
        } else {
            Motion::without_label(regime)
        }
    }

    /// What cells have in common of a regime that is not periodic.
    pub(super) fn without_label(regime: Regime) -> Self {
        Motion { regime, counts: [0; 1 + MOST], symmetric: false }
    }

    /// The name in as few letters as still tell it from others, such as "1-2-2 unsym.".
    pub fn short_name(verdict: &Verdict, mirrored: bool) -> String {
        let name = Motion::name(verdict, mirrored);
        let name = name.strip_suffix(", sticking").unwrap_or(&name);
        match name.strip_suffix("symmetric") {
            Some(start) => format!("{start}sym."),
            None => name.to_owned(),
        }
    }

    /// The motion's name in a legend, such as "1-2-2 unsymmetric".
    ///
    /// A motion with p ≠ q cannot be symmetric, so that nothing is said about it; nor is it of one without symmetry where
    /// systems have no mirror (`mirrored` says whether they have).
    pub fn name(verdict: &Verdict, mirrored: bool) -> String {
        Motion::of(verdict).name_of(verdict.counts.len(), mirrored)
    }

    /// The same for a motion of a system with so many stops.
    pub(super) fn name_of(&self, stops: usize, mirrored: bool) -> String {
        let Motion { regime, symmetric, .. } = *self;
        let [n, counts @ ..] = self.counts;
        let counts = &counts[..stops];
        let label = match regime.is_periodic() {
            true => motion_label(u32::from(n), counts),
            false => regime.name().to_owned(),
        };
        let alike = counts.len() > 1 && counts.iter().all(|count| *count == counts[0]);
        let symmetry = match (alike, symmetric) {
            (true, true) => " symmetric",
            (true, false) if mirrored => " unsymmetric",
            _ => "",
        };
        match regime {
            Regime::Periodic => format!("{label}{symmetry}"),
            Regime::PeriodicSticking => format!("{label}{symmetry}, sticking"),
            _ => label,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::Verdict;

    #[test]
    fn names_say_what_tells_motions_apart() {
        let name =
            |regime, counts, symmetric| Motion::name(&Verdict::of_motion(regime, counts, symmetric), true);
        assert_eq!(name(Regime::Periodic, [1, 1, 1], true), "1-1-1 symmetric");
        assert_eq!(name(Regime::Periodic, [2, 4, 4], false), "2-4-4 unsymmetric");
        assert_eq!(name(Regime::Periodic, [1, 1, 2], false), "1-1-2");
        assert_eq!(
            name(Regime::PeriodicSticking, [1, u16::MAX, u16::MAX], true),
            "1-∞-∞ symmetric, sticking"
        );
        assert_eq!(name(Regime::Chaotic, [7, 7, 7], true), "chaotic");
        let short = |regime, counts, symmetric| {
            Motion::short_name(&Verdict::of_motion(regime, counts, symmetric), true)
        };
        assert_eq!(short(Regime::Periodic, [1, 1, 1], true), "1-1-1 sym.");
        assert_eq!(short(Regime::Periodic, [1, 1, 1], false), "1-1-1 unsym.");
        assert_eq!(short(Regime::PeriodicSticking, [1, u16::MAX, 0], false), "1-∞-0");
        let plain = Motion::name(&Verdict::of_motion(Regime::Periodic, [1, 1, 1], false), false);
        assert_eq!(plain, "1-1-1", "without a mirror nothing is unsymmetric");
        assert_eq!(short(Regime::QuasiPeriodic, [7, 7, 7], true), "quasi-periodic");
    }

    #[test]
    fn counts_of_what_is_not_periodic_mean_nothing() {
        let of = |regime, counts| Motion::of(&Verdict::of_motion(regime, counts, true));
        assert_eq!(of(Regime::Chaotic, [1, 2, 3]), of(Regime::Chaotic, [0, 0, 0]));
        assert_ne!(of(Regime::Periodic, [1, 2, 3]), of(Regime::Periodic, [1, 3, 2]));
        assert_ne!(of(Regime::Periodic, [1, 2, 2]), of(Regime::PeriodicSticking, [1, 2, 2]));
    }
}
