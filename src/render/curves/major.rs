//! Which curves a picture has room for: those of the motions that it shows enough of.

use crate::curves::{Curve, CurveMotion};
use crate::paper::Named;
use crate::plane::RegionMap;

/// The share of a plane that a motion and its mirror image fill at least, in a thousand, for their curves to be drawn over
/// it; those that have a name of the paper's are drawn in any case.
///
/// Along the narrow bands of rarer motions curves would lie upon each other and hide the regions.
pub const DRAWN_IN_A_THOUSAND: usize = 3;

/// The curves of the motions that fill enough of a map, symmetric or not (a pitchfork bounds both), and those named.
pub(super) fn major(map: &RegionMap, curves: &[Curve], names: &[Named]) -> Vec<Curve> {
    let fills = |motion: &CurveMotion| {
        // What is no motion with impacts bounds all of them.
        let own = || map.verdicts.iter().filter(|verdict| motion.is_counted_by(verdict)).count();
        motion.count() == 0 || 1000 * own() >= DRAWN_IN_A_THOUSAND * map.verdicts.len()
    };
    let is_named = |index: usize| names.iter().any(|named| named.curve == index && named.name.is_some());
    let kept = curves.iter().enumerate().filter(|(index, curve)| is_named(*index) || fills(&curve.motion));
    kept.map(|(_, curve)| curve.clone()).collect()
}
