//! Which curves a picture has room for: those of the motions that it shows enough of.

use std::collections::HashMap;

use crate::curves::{Curve, CurveMotion, Named};
use crate::plane::RegionMap;

/// The share of a plane that a motion and its mirror image fill at least, in a thousand, for their curves to be drawn over
/// it; those that have a name of the paper's are drawn in any case.
///
/// Along the narrow bands of rarer motions curves would lie upon each other and hide the regions.
pub const DRAWN_IN_A_THOUSAND: usize = 3;

/// The curves of the motions that fill enough of a map, and those named.
pub(super) fn major(map: &RegionMap, curves: &[Curve], names: &[Named]) -> Vec<Curve> {
    let mut cells: HashMap<[u32; 3], usize> = HashMap::new();
    for verdict in map.verdicts.iter().filter(|verdict| verdict.regime.is_periodic()) {
        *cells.entry(counts(verdict.n.into(), verdict.p().into(), verdict.q().into())).or_default() += 1;
    }
    let fills = |motion: &CurveMotion| {
        let own = cells.get(&counts(motion.n, motion.p, motion.q)).copied().unwrap_or_default();
        // What is no motion with impacts bounds all of them.
        motion.p + motion.q == 0 || 1000 * own >= DRAWN_IN_A_THOUSAND * map.verdicts.len()
    };
    let is_named = |index: usize| names.iter().any(|named| named.curve == index && named.name.is_some());
    let kept = curves.iter().enumerate().filter(|(index, curve)| fills(&curve.motion) || is_named(*index));
    kept.map(|(_, curve)| curve.clone()).collect()
}

/// N and the impacts per period of a motion or its mirror image, symmetric or not: a pitchfork bounds both.
fn counts(n: u32, p: u32, q: u32) -> [u32; 3] {
    [n, p.max(q), p.min(q)]
}
