//! The cases whose trajectory settles on a periodic motion, beyond doubt.

use std::sync::LazyLock;

use impact_atlas::model::Parameters;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::cases::{Family, Setup, setups};
use super::conditioning::{COARSE, Noise, deviation, horizon};
use super::oracle::follow::Period;
use super::oracle::settle::{Settled, settle};
use super::oracle::{Follower, Plant};

/// Forcing periods within which a trajectory must settle to be in the suite.
pub const BUDGET: usize = 960;

/// Displacement of the starts that must lead to the same motion: larger than an f32's errors.
const DISPLACEMENT: f64 = 1e-5;

/// States closer than this may pass for the same ones, and states further apart than [`SAME`] for different ones.
const DIFFERENT: f64 = 1e-3;

/// See [`DIFFERENT`].
const SAME: f64 = 1e-6;

/// A setup with the motion it settles on.
#[derive(Clone, Debug)]
pub struct SettledCase {
    /// Why it is there.
    pub family: Family,
    /// The system.
    pub parameters: Parameters,
    /// (x1, x2, v1, v2) at forcing phase 0.
    pub start: [f64; 4],
    /// What it settles on.
    pub settled: Settled,
    /// How far noise of an f32's size drives it off the motion.
    pub sway: f64,
}

/// The setups that settle, on the same motion from displaced starts; computed once per test binary.
pub fn settled_cases() -> &'static [SettledCase] {
    static CASES: LazyLock<Vec<SettledCase>> =
        LazyLock::new(|| setups().into_par_iter().filter_map(|setup| settled_case(&setup)).collect());
    &CASES
}

fn settled_case(&Setup { family, parameters, start }: &Setup) -> Option<SettledCase> {
    let plant = Plant::new(parameters);
    let settled = settle(plant, start, BUDGET)?;
    let clear = settled.separation > DIFFERENT && (settled.asymmetry < SAME || settled.asymmetry > DIFFERENT);
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut same = || {
        let moved = start.map(|x| x + rng.random_range(-DISPLACEMENT..DISPLACEMENT));
        let inside = [moved[0].clamp(-parameters.delta, parameters.delta), moved[1], moved[2], moved[3]];
        settle(plant, inside, 2 * BUDGET).is_some_and(|other| {
            other.motion == settled.motion
                && settled.strobes.iter().any(|s| deviation(&other.strobes[0], s) < SAME)
        })
    };
    (clear && (0..3).all(|_| same())).then(|| {
        let sway = sway(parameters, &settled);
        SettledCase { family, parameters, start, settled, sway }
    })
}

/// How far noise of an f32's size, many times what it usually makes, drives the trajectory off the motion.
fn sway(parameters: Parameters, settled: &Settled) -> f64 {
    let start = settled.strobes[settled.strobes.len() - 1];
    let mut follower = Follower::<f64>::new(Plant::new(parameters), start);
    let truth: Vec<Period> = (0..20).map(|_| follower.next_period()).collect();
    let orbit = Setup { family: Family::General, parameters, start };
    let noise = Noise { size: COARSE.size, limit: 1.0, at_least: truth.len() };
    horizon(&orbit, &truth, noise).slack * noise.size
}
