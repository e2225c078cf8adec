//! Symmetric or not, beside the pitchfork where a strobe state cannot tell.

use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide, follow};
use impact_atlas::model::{StateVector, System};
use impact_atlas::theory::{StrobeMotion, settled_motion, symmetric_motions};

use super::{at, decided, job, schedule};
use crate::common::adapter::gpu;

/// Where a strobe state was called the mirror image of another.
const CLOSE: f64 = 1e-4;

fn system(omega: f64) -> System {
    System::new(at(omega, 0.1)).unwrap()
}

/// The symmetric 1-1-1 motion, exactly.
fn symmetric(omega: f64) -> StrobeMotion {
    let system = system(omega);
    let found = &symmetric_motions(&system).unwrap()[0].motion;
    StrobeMotion::refine(&system, found.at_phase_zero(&system), 1).unwrap()
}

/// The frequency of the pitchfork at δ = 0.1: the half map's multiplier −1, of the closed form, since Newton's method has next
/// to nothing to hold to there.
fn pitchfork() -> f64 {
    let half = |system: System| symmetric_motions(&system).unwrap()[0].motion.half_multipliers(&system);
    let is_stable = |omega: f64| half(system(omega)).unwrap()[0].norm() < 1.0;
    let (mut unstable, mut stable) = (3.69, 3.692);
    assert!(is_stable(stable) && !is_stable(unstable));
    for _ in 0..40 {
        let middle = 0.5 * (unstable + stable);
        *if is_stable(middle) { &mut stable } else { &mut unstable } = middle;
    }
    0.5 * (unstable + stable)
}

/// The unsymmetric 1-1-1 motion this far below the pitchfork. To one side of the symmetric one it grows like the root of
/// the distance, to both like the distance.
fn unsymmetric(pitchfork: f64, below: f64) -> StrobeMotion {
    const FAR: f64 = 1e-4;
    let far = system(pitchfork - FAR);
    let settled = StrobeMotion::turned(&far, job(at(pitchfork - FAR, 0.1)).start, 20_000).unwrap();
    let motion = settled_motion(&far, &settled, 1).unwrap();
    let image = motion.mirror_image(&far).unwrap().at_phase_zero(&far);
    let motion = motion.at_phase_zero(&far);
    let beside = symmetric(pitchfork - FAR).state;
    let [here, share] = [pitchfork - below, below / FAR];
    let guess: Vec<f64> = (symmetric(here).state.iter().enumerate())
        .map(|(i, here)| {
            let [odd, even] = [0.5 * (motion[i] - image[i]), 0.5 * (motion[i] + image[i]) - beside[i]];
            here + share.sqrt() * odd + share * even
        })
        .collect();
    StrobeMotion::refine(&system(here), guess, 1).unwrap()
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn an_unsymmetric_motion_close_to_its_mirror_image_is_unsymmetric() {
    let pitchfork = pitchfork();
    let below = 1e-8;
    let motion = unsymmetric(pitchfork, below);
    let apart = distance(&motion.state, &symmetric(pitchfork - below).state);
    assert!(!motion.symmetric && (1e-6..CLOSE / 2.0).contains(&apart), "{apart}");
    let start = StateVector::from_slice(&motion.state).unwrap();
    let job = Job { system: system(pitchfork - below), start };
    let once = follow::<f64>(&job, &schedule(100));
    assert!(once.regime.is_periodic() && once.symmetric, "the trap: {once:?}");
    let verdict = decide(&Cpu, std::slice::from_ref(&job), &schedule(100), &Unwatched).unwrap()[0];
    assert_eq!((verdict.label().as_str(), verdict.symmetric), ("1-1-1", false));
}

#[test]
fn a_state_that_still_spirals_in_is_on_a_symmetric_motion() {
    let beside = job(at(3.6907, 0.1));
    let once = follow::<f64>(&beside, &schedule(300));
    assert!(!once.symmetric && (once.regime.is_periodic() || once.returning == 1), "the trap: {once:?}");
    let backends: [&dyn Backend; 2] = [&Cpu, gpu()];
    for backend in backends {
        let verdict = decided(backend, &beside, 300);
        assert_eq!((verdict.label().as_str(), verdict.symmetric), ("1-1-1", true), "{}", backend.name());
    }
    // Farther below, where the two are well apart, it is the other that attracts.
    let far = decided(&Cpu, &job(at(3.65, 0.1)), 300);
    assert_eq!((far.label().as_str(), far.symmetric), ("1-1-1", false));
}
