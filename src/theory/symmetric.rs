//! The period-one double-impact symmetric motion of section 3, in closed form, of any system with a mirror.

use super::flow::Flow;
use super::follower::KeptFollower;
use super::matched::{Matched, NoSymmetricMotion, SymmetricMotion};
use super::section_vector::wrapped;
use crate::dynamics::Stop;
use crate::model::System;

/// How far a start on the symmetric motion is moved off it, so that an unstable one is left; non-dimensional.
pub const NUDGE: f64 = 1e-3;

/// Both solutions of (5), in the order of τ: the motion between two stops that the mirror exchanges, the first such.
///
/// With Φ the flight over half a period from y = (x, v), Γs, Γc and Γ₁ what forcing at phase τ and the constant load add
/// to it, D the impact at the other stop and P the mirror, the state y just after the impact at the first stop satisfies
/// (DΦ − P) y + D (Γs sin τ + Γc cos τ + Γ₁) = 0 with d·x = gap: 2n equations for the other 2n − 1 components of y,
/// sin τ and cos τ. Their solutions are a straight line, which sin² τ + cos² τ = 1 meets twice. DΦ − P itself is singular
/// at a resonance without damping, and wherever r = 1 and ζ = 0 in the paper's oscillator; the line is not.
///
/// # Errors
/// [`NoSymmetricMotion`] where no real τ solves it, or there is no such mirror.
pub fn symmetric_motions(system: &System) -> Result<[SymmetricMotion; 2], NoSymmetricMotion> {
    let (matched, mut kept) = (Matched::of(system)?, KeptFollower::default());
    Ok([0, 1].map(|k| matched.followed(k, &mut kept)))
}

/// (x, v) at forcing phase 0 on the stable-branch 1-1-1 symmetric motion, nudged, where it exists and is physical.
///
/// Of two physical solutions the one with the smaller multipliers is taken. The first displacement that no stop bears on
/// is nudged, the first velocity where there is none.
pub fn symmetric_start(system: &System) -> Option<Vec<f64>> {
    SymmetricStarts::default().of(system)
}

/// The same of one system after the other, cheaper where they have their flow in common.
#[derive(Default)]
pub struct SymmetricStarts(KeptFollower);

impl SymmetricStarts {
    /// As [`symmetric_start`].
    pub fn of(&mut self, system: &System) -> Option<Vec<f64>> {
        let (_, mut state) = stable(&Matched::of(system).ok()?, &mut self.0)?;
        let n = system.coordinates();
        let borne = |i: &usize| system.stops().any(|(direction, _)| direction[*i] != 0.0);
        let nudged = (0..n).find(|i| !borne(i)).unwrap_or(n);
        state[nudged] += NUDGE * system.unit();
        Some(state)
    }
}

/// The fixed point of the same motion on the section at its first stop, (v1+, x2, v2, τ) of the paper's oscillator, where
/// it exists and is physical.
pub fn symmetric_target(system: &System) -> Option<Vec<f64>> {
    stable_branch(system).map(|motion| motion.motion.section())
}

/// The same point on the section at a stop; none where the motion does not meet it, or is not physical.
pub fn symmetric_target_at(system: &System, stop: Stop) -> Option<Vec<f64>> {
    let motion = stable_branch(system)?.motion;
    if motion.pattern.stops[0] == stop {
        return Some(motion.section());
    }
    let image = motion.pattern.closing(&Flow::new(system), &motion.sections[0]);
    let mut section = image.section.as_slice().to_vec();
    let tau = section.last_mut()?;
    *tau = wrapped(*tau);
    (image.stop == stop).then_some(section)
}

/// Of two physical solutions the one with the smaller multipliers, of one that one.
pub(super) fn stable_branch(system: &System) -> Option<SymmetricMotion> {
    let matched = Matched::of(system).ok()?;
    let (k, state) = stable(&matched, &mut KeptFollower::default())?;
    Some(SymmetricMotion { motion: matched.motion(k), at_phase_zero: Ok(state) })
}

/// The number of that one, and (x, v) at forcing phase 0 on it.
///
/// Where the one that can be stable is, the other is a saddle and need not be looked at; see [`Matched::regular`]. Nor need any
/// multipliers where the other would leave its stop outwards.
fn stable(matched: &Matched, kept: &mut KeptFollower) -> Option<(usize, Vec<f64>)> {
    let regular = matched.regular();
    let first = matched.follow(regular, kept).ok();
    if first.is_some() && (matched.leaves_outwards(1 - regular) || matched.contracts(regular)) {
        return first.map(|state| (regular, state));
    }
    let second = matched.follow(1 - regular, kept).ok();
    let k = match (&first, &second) {
        (Some(_), Some(_)) => usize::from(matched.spectral_radius(1) < matched.spectral_radius(0)),
        (Some(_), None) => regular,
        _ => 1 - regular,
    };
    Some((k, if k == regular { first? } else { second? }))
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;
    use crate::theory::example::{mirrored, with_stops};

    #[test]
    fn of_two_physical_motions_the_one_that_is_not_regular_is_a_saddle() {
        let mut random = ChaCha8Rng::seed_from_u64(11);
        let (mut compared, mut stable, mut places) = (0, 0, [0, 0]);
        for plant in mirrored() {
            for _ in 0..400 {
                let mut plant = with_stops(
                    &plant,
                    random.random_range(0.01..0.6),
                    [0.0, 0.3, 0.8, 0.95][random.random_range(0..4)],
                );
                plant.omega *= random.random_range(0.5..2.5);
                let system = System::of_plant(plant).unwrap();
                let Ok(matched) = Matched::of(&system) else { continue };
                let motions = [0, 1].map(|k| matched.followed(k, &mut KeptFollower::default()));
                if motions.iter().any(|motion| motion.at_phase_zero.is_err()) {
                    continue;
                }
                let distances = [0, 1].map(|k| {
                    let map = matched.half_turn(k).unwrap();
                    (DMatrix::identity(map.nrows(), map.ncols()) - map).determinant()
                });
                let radii = [0, 1].map(|k| motions[k].spectral_radius(&system));
                let regular = matched.regular();
                assert!(distances[regular] > 0.0 && distances[1 - regular] < 0.0, "{distances:?}, {regular}");
                assert!(radii[1 - regular] > 1.0);
                if matched.contracts(regular) {
                    stable += 1;
                    assert!(radii[regular] < 1.0);
                }
                // The branch taken is the one with the smaller multipliers, found the long way.
                let smaller = usize::from(radii[1] < radii[0]);
                let taken = stable_branch(&system).unwrap();
                assert_eq!(taken, motions[smaller]);
                assert_ne!(taken, motions[1 - smaller], "the check can fail");
                places[regular] += 1;
                compared += 1;
            }
        }
        println!(
            "{compared} pairs, {stable} of them with a stable motion; the regular one by place: {places:?}"
        );
        assert!(compared > 60 && stable > 20 && stable < compared && places.iter().all(|&count| count > 0));
    }
}
