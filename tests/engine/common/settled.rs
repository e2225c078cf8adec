//! The cases whose trajectory settles on a periodic motion, beyond doubt.

use std::sync::LazyLock;

use impact_atlas::model::Parameters;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::cases::{Setup, setups};
use super::conditioning::{COARSE, Horizon, Noise, deviation, horizon};
use super::oracle::follow::Period;
use super::oracle::settle::{Count, Settled, settle};
use super::oracle::{Follower, Plant};

/// Forcing periods within which a trajectory must settle to be in the suite.
pub const BUDGET: usize = 576;

/// Displacement of the starts that must lead to the same motion: larger than an f32's errors.
const DISPLACEMENT: f64 = 1e-5;

/// States closer than this may pass for the same ones, and states further apart than [`SAME`] for different ones.
const DIFFERENT: f64 = 1e-3;

/// Displaced trajectories that are further off on their way are not the same transient.
const ASTRAY: f64 = 1e-2;

/// See [`DIFFERENT`].
const SAME: f64 = 1e-6;

/// A setup with the motion it settles on.
#[derive(Clone, Debug)]
pub struct SettledCase {
    /// The system.
    pub parameters: Parameters,
    /// (x1, x2, v1, v2) at forcing phase 0.
    pub start: [f64; 4],
    /// What it settles on.
    pub settled: Settled,
    /// Whether the motion survives noise of an f32's size.
    pub tame: bool,
}

/// The setups that settle, on the same motion from displaced starts; computed once per test binary.
pub fn settled_cases() -> &'static [SettledCase] {
    static CASES: LazyLock<Vec<SettledCase>> =
        LazyLock::new(|| setups().into_par_iter().filter_map(|setup| settled_case(&setup)).collect());
    &CASES
}

fn settled_case(&Setup { parameters, start, .. }: &Setup) -> Option<SettledCase> {
    let follower = Follower::<f64>::new(Plant::new(parameters), start);
    let settled = settle(follower.clone(), BUDGET)?;
    let clear = settled.separation > DIFFERENT && (settled.asymmetry < SAME || settled.asymmetry > DIFFERENT);
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    let mut displaced = || {
        let moved = start.map(|x| x + rng.random_range(-DISPLACEMENT..DISPLACEMENT));
        [moved[0].clamp(-parameters.delta, parameters.delta), moved[1], moved[2], moved[3]]
    };
    (clear && (0..2).all(|_| goes_along(follower.another(displaced()), &settled.path))).then(|| {
        let tame = is_tame(&follower, &settled);
        SettledCase { parameters, start, settled, tame }
    })
}

/// Whether a displaced trajectory stays near all the way to the motion and ends on it: no chaotic transient, no
/// nearby boundary to another motion's basin.
fn goes_along(mut follower: Follower<f64>, path: &[[f64; 4]]) -> bool {
    let mut off = path.iter().map(|strobe| deviation(&follower.next_period().strobe, strobe));
    let (mut largest, mut last) = (0.0_f64, 0.0);
    for deviation in &mut off {
        (largest, last) = (largest.max(deviation), deviation);
    }
    largest < ASTRAY && last < SAME
}

/// Whether noise of an f32's size, many times what it usually makes, neither drives the trajectory off the motion nor
/// changes its impacts.
fn is_tame(follower: &Follower<f64>, settled: &Settled) -> bool {
    let orbit = follower.another(settled.strobes[settled.strobes.len() - 1]);
    let mut exact = orbit.clone();
    let truth: Vec<Period> = (0..20).map(|_| exact.next_period()).collect();
    let noise = Noise { size: COARSE.size, limit: DIFFERENT / COARSE.size, at_least: 0 };
    let Horizon { periods, countable, .. } = horizon(&orbit, &truth, noise);
    let chatters = settled.motion.p == Count::Infinite || settled.motion.q == Count::Infinite;
    periods == truth.len() && (chatters || countable == truth.len())
}
