//! How long a case can be compared at all: sensitivity to small errors, measured with the oracle itself.
//!
//! A rounding error early in a trajectory is amplified by everything that follows: e-fold in chaos, by a square
//! root near grazing. Companions of the exact trajectory are moved by a small random displacement at the start and
//! at every strobe; a case is comparable for as long as none of them is further off than a set multiple of it.

use std::sync::LazyLock;

use impact_atlas::model::Parameters;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::cases::{Family, Setup, setups};
use super::oracle::follow::Period;
use super::oracle::{Follower, Plant};

/// The longest comparison, in forcing periods.
const LONGEST: usize = 40;

/// Companions per case and noise level.
const COMPANIONS: u64 = 4;

/// How errors of one size grow.
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    /// Displacement per component of the companions, at every strobe.
    pub size: f64,
    /// The deviation, in multiples of `size`, beyond which a trajectory is no longer comparable.
    pub limit: f64,
    /// Forcing periods that are compared whatever the sensitivity.
    pub at_least: usize,
}

/// For trajectories in f64.
pub const FINE: Noise = Noise { size: 1e-10, limit: 1e3, at_least: 3 };

/// For trajectories in f32.
pub const COARSE: Noise = Noise { size: 1e-6, limit: 30.0, at_least: 0 };

/// For how long a case is comparable.
#[derive(Clone, Copy, Debug)]
pub struct Horizon {
    /// Forcing periods for which states are comparable.
    pub periods: usize,
    /// Forcing periods, of those, for which impacts can be counted: every companion has the same impacts per stop,
    /// and no chatter is complete (infinitely many impacts).
    pub countable: usize,
}

/// A setup with its exact trajectory.
#[derive(Clone, Debug)]
pub struct Case {
    /// Why it is there.
    pub family: Family,
    /// The system.
    pub parameters: Parameters,
    /// (x1, x2, v1, v2) at forcing phase 0.
    pub start: [f64; 4],
    /// The exact trajectory, period by period.
    pub truth: Vec<Period>,
    /// How long f64 is comparable.
    pub fine: Horizon,
    /// How long f32 is comparable.
    pub coarse: Horizon,
}

impl Case {
    /// The exact state after some forcing periods.
    pub fn strobe(&self, periods: usize) -> [f64; 4] {
        self.truth[periods - 1].strobe
    }

    /// Impacts per stop in the first forcing periods.
    pub fn counts(&self, periods: usize) -> [u32; 2] {
        self.truth[..periods].iter().fold([0, 0], |sum, period| {
            let [minus, plus] = period.counts();
            [sum[0] + minus, sum[1] + plus]
        })
    }
}

/// Every case of the suite that can be followed; computed once per test binary.
pub fn cases() -> &'static [Case] {
    static CASES: LazyLock<Vec<Case>> = LazyLock::new(|| setups().into_par_iter().filter_map(case).collect());
    &CASES
}

/// A setup with its truth, unless its impacts are too many to be followed one by one.
fn case(setup: Setup) -> Option<Case> {
    let Setup { family, parameters, start } = setup;
    let mut follower = Follower::<f64>::new(Plant::new(parameters), start);
    let truth: Vec<Period> = (0..LONGEST).map(|_| follower.next_period()).collect();
    if follower.is_exhausted() {
        return None;
    }
    let [fine, coarse] = [FINE, COARSE].map(|noise| horizon(&setup, &truth, noise));
    Some(Case { family, parameters, start, truth, fine, coarse })
}

/// The largest deviation of a state, relative to the largest component where that is above 1.
pub fn deviation(state: &[f64; 4], exact: &[f64; 4]) -> f64 {
    let scale = exact.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()));
    let largest = state.iter().zip(exact).map(|(a, b)| (a - b).abs());
    largest.fold(0.0, |worst, d| if d <= worst { worst } else { d }) / scale
}

fn horizon(setup: &Setup, truth: &[Period], noise: Noise) -> Horizon {
    let mut periods = truth.len();
    let mut companions = Vec::new();
    for seed in 0..COMPANIONS {
        let companion = companion(setup, truth, noise, seed, periods);
        periods = periods.min(companion.len());
        companions.push(companion);
    }
    let agree = |period: usize| {
        truth[period].chatters == [0, 0]
            && companions.iter().all(|c| c.get(period).is_some_and(|p| p.counts() == truth[period].counts()))
    };
    let countable = (0..periods).take_while(|&period| agree(period)).count();
    Horizon { periods: periods.max(noise.at_least), countable }
}

/// A trajectory under noise, for as long as it is comparable with the exact one.
fn companion(setup: &Setup, truth: &[Period], noise: Noise, seed: u64, longest: usize) -> Vec<Period> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut displacement = || [(); 4].map(|()| if rng.random() { noise.size } else { -noise.size });
    let mut follower = Follower::<f64>::new(Plant::new(setup.parameters), setup.start);
    let mut periods = Vec::new();
    for exact in &truth[..longest] {
        follower.nudge(displacement());
        let period = follower.next_period();
        if follower.is_exhausted() || deviation(&period.strobe, &exact.strobe) > noise.limit * noise.size {
            break;
        }
        periods.push(period);
    }
    periods
}
