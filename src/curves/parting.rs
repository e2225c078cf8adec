//! How far a motion is from a simpler one: the one it was born from in a pitchfork or a period doubling.

use std::f64::consts::PI;

use crate::theory::{Pattern, PeriodicMotion, Section};

/// The simpler motion's pattern, and the first impact's difference from being repeated (or mirrored) half-way.
///
/// The difference passes through zero, with a change of sign, where a path of motions goes over into its own twin. None
/// for a motion whose impacts do not come twice over.
pub(super) fn parting(motion: &PeriodicMotion) -> Option<(Pattern, Vec<Section>)> {
    let pattern = motion.part(2)?;
    let count = pattern.stops.len();
    let mirror = if pattern.mirrored { -1.0 } else { 1.0 };
    let turned = f64::from(pattern.half_turns) * PI;
    let differences = (0..count)
        .map(|i| {
            let (a, b) = (&motion.sections[i], &motion.sections[i + count]);
            b - Section::new(mirror * a[0], mirror * a[1], mirror * a[2], a[3] + turned)
        })
        .collect();
    Some((pattern, differences))
}

/// Whether two motions of a path lie on different sides of the simpler motion.
pub(super) fn passed(before: &PeriodicMotion, after: &PeriodicMotion) -> bool {
    let (Some((_, a)), Some((_, b))) = (parting(before), parting(after)) else { return false };
    a.iter().zip(&b).map(|(a, b)| a.dot(b)).sum::<f64>() < 0.0
}
