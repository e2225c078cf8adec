//! How far a motion is from a simpler one: the one from which it bifurcates in a pitchfork or a period doubling.

use crate::model::System;
use crate::theory::{Flow, Pattern, PeriodicMotion, SectionVector, magnified};

/// The simpler motion's pattern, and the first impact's difference from being repeated (or mirrored) half-way.
///
/// The difference passes through zero, with a change of sign, where a path of motions goes over into its own twin. None
/// for a motion whose impacts do not come twice over.
pub(super) fn parting(system: &System, motion: &PeriodicMotion) -> Option<(Pattern, Vec<SectionVector>)> {
    let pattern = motion.part(2)?;
    let flow = Flow::new(system);
    let count = pattern.stops.len();
    let differences = (0..count)
        .map(|i| {
            let (a, b) = (&motion.sections[i], &motion.sections[i + count]);
            let begins = Pattern { stops: vec![pattern.stops[i]], ..pattern.clone() };
            b - begins.closing(&flow, a).section
        })
        .collect();
    Some((pattern, differences))
}

/// Whether two motions of a path lie on different sides of the simpler motion.
pub(super) fn passed(system: &System, before: &PeriodicMotion, after: &PeriodicMotion) -> bool {
    let (Some((_, a)), Some((_, b))) = (parting(system, before), parting(system, after)) else {
        return false;
    };
    let per_unit = |section: &SectionVector| magnified(section, 1.0 / system.unit());
    a.iter().zip(&b).map(|(a, b)| per_unit(a).dot(&per_unit(b))).sum::<f64>() < 0.0
}
