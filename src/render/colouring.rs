//! The paints of one picture: every motion that has a colour of its own can be told from all others.

use std::collections::HashMap;

use super::colours::{SHARED, SPARE, paint_of};
use super::motion::Motion;
use crate::analysis::Regime;
use crate::figure::{Colour, DISTINCT, Paint, Seen, hex};

/// The paints of the motions of one picture.
#[derive(Clone, Debug)]
pub(super) struct Colouring {
    own: HashMap<Motion, Paint>,
}

impl Colouring {
    /// Gives paints to motions, those that matter most first.
    ///
    /// A motion has its steady paint unless one before it, or something that is not periodic, looks too much like that
    /// to any eye; then it has another one. Once no distinct paint is left, motions share one.
    pub fn of(motions: impl IntoIterator<Item = Motion>) -> Self {
        let unlike = Regime::ALL.into_iter().filter(|regime| !regime.is_periodic());
        let reserved = unlike.map(|regime| paint_of(Motion::without_label(regime)));
        let mut taken: Vec<(Option<Colour>, Seen)> =
            reserved.chain([SHARED]).map(|paint| (paint.hatch, Seen::of(paint.fill))).collect();
        let mut own = HashMap::new();
        for motion in motions {
            let steady = paint_of(motion);
            if !motion.regime.is_periodic() {
                own.insert(motion, steady);
                continue;
            }
            let spare = SPARE.into_iter().map(|spare| Paint { fill: hex(spare), ..steady });
            let free = std::iter::once(steady).chain(spare).find_map(|paint| {
                let seen = Seen::of(paint.fill);
                let alike = |(hatch, other): &(Option<Colour>, Seen)| {
                    *hatch == paint.hatch && seen.difference(other) < DISTINCT
                };
                (!taken.iter().any(alike)).then_some((paint, seen))
            });
            if let Some((paint, seen)) = free {
                taken.push((paint.hatch, seen));
                own.insert(motion, paint);
            }
        }
        Colouring { own }
    }

    /// The paint of a motion, if it does not share one.
    pub fn own(&self, motion: Motion) -> Option<Paint> {
        self.own.get(&motion).copied()
    }

    /// The paint of a motion.
    pub fn paint(&self, motion: Motion) -> Paint {
        self.own(motion).unwrap_or(SHARED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(regime: Regime, [n, p, q]: [u16; 3], symmetric: bool) -> Motion {
        Motion { regime, counts: [n, p, q, 0, 0], symmetric }
    }

    /// Two hundred motions with and without sticking, after all that is not periodic.
    fn motions() -> Vec<Motion> {
        let all = Regime::ALL.into_iter().filter(|regime| !regime.is_periodic());
        let mut motions: Vec<Motion> = all.map(|regime| motion(regime, [0; 3], false)).collect();
        for i in 0..200_u16 {
            let regime = if i % 4 == 3 { Regime::PeriodicSticking } else { Regime::Periodic };
            motions.push(motion(regime, [1 + i % 5, 1 + i / 9, 1 + i / 9 + i % 3], i % 3 == 0 && i % 2 == 0));
        }
        motions.dedup();
        motions
    }

    /// The pairs of paints that an eye may confuse.
    fn alike(paints: &[(Motion, Paint)]) -> Vec<(Motion, Motion)> {
        let mut found = Vec::new();
        for (i, (a, first)) in paints.iter().enumerate() {
            for (b, second) in &paints[..i] {
                let near = Seen::of(first.fill).difference(&Seen::of(second.fill)) < DISTINCT;
                if near && first.hatch == second.hatch {
                    found.push((*a, *b));
                }
            }
        }
        found
    }

    #[test]
    fn every_eye_tells_motions_with_paints_of_their_own_apart() {
        let motions = motions();
        let colouring = Colouring::of(motions.iter().copied());
        let mut paints: Vec<(Motion, Paint)> =
            motions.iter().filter_map(|&motion| Some((motion, colouring.own(motion)?))).collect();
        paints.push((motion(Regime::Periodic, [0; 3], false), SHARED));
        assert!(paints.len() > 50 && paints.len() < motions.len(), "{}", paints.len());
        assert_eq!(alike(&paints), []);
        let steady: Vec<(Motion, Paint)> = motions.iter().map(|&motion| (motion, paint_of(motion))).collect();
        assert!(alike(&steady).len() > 100, "steady paints alone are not distinct");
    }

    #[test]
    fn motions_that_looked_alike_are_told_apart() {
        let named = [[1, 6, 6], [3, 13, 13], [1, 3, 2]].map(|counts| motion(Regime::Periodic, counts, false));
        let colouring = Colouring::of(named);
        let paints = named.map(|motion| (motion, colouring.own(motion).unwrap()));
        assert_eq!(alike(&paints), []);
        assert_eq!(paints[0].1, paint_of(named[0]), "the first keeps its steady paint");
    }

    #[test]
    fn motions_keep_their_colours_where_they_can() {
        let common = [[1, 1, 1], [1, 2, 2], [1, 3, 3]].map(|counts| motion(Regime::Periodic, counts, true));
        let colouring = Colouring::of(common);
        assert!(common.into_iter().all(|motion| colouring.own(motion) == Some(paint_of(motion))));
        assert_eq!(colouring.own(motion(Regime::Periodic, [7, 7, 7], true)), None);
        assert_eq!(colouring.paint(motion(Regime::Periodic, [7, 7, 7], true)), SHARED);
    }
}
