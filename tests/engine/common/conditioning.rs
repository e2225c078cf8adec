//! How long a case can be compared at all: sensitivity to small errors, measured with the oracle itself.
//!
//! A rounding error early in a trajectory is amplified by everything that follows: e-fold in chaos, by a square
//! root near grazing. Companions of the exact trajectory are displaced at random at the start and at every strobe,
//! between stops that are rough by as much; a case is comparable for as long as none of them is further off than a
//! set multiple of the displacement.

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
const COMPANIONS: u64 = 6;

/// How errors of one size grow.
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    /// Displacement of the companions at every strobe, relative to the largest component of the state where that is
    /// above 1, and roughness of their stops, relative to δ.
    pub size: f64,
    /// The deviation, in multiples of `size`, beyond which a trajectory is no longer comparable.
    pub limit: f64,
    /// Forcing periods that are compared whatever the sensitivity.
    pub at_least: usize,
}

/// For trajectories in f64.
pub const FINE: Noise = Noise { size: 1e-10, limit: 1e3, at_least: 3 };

/// For trajectories in f32, whose rounding adds up to some 1e-6 of the state in a period of hundreds of steps.
pub const COARSE: Noise = Noise { size: 3e-6, limit: 10.0, at_least: 0 };

/// For how long a case is comparable.
#[derive(Clone, Copy, Debug)]
pub struct Horizon {
    /// Forcing periods for which states are comparable.
    pub periods: usize,
    /// Forcing periods, of those, for which impacts can be counted: every companion has the same impacts per stop,
    /// no chatter is complete (infinitely many impacts), and no impact is so slow that a deviation within the limit hides it.
    pub countable: usize,
    /// The factor, 1 or more, by which the companions exceed the limit in periods that are compared nevertheless.
    pub slack: f64,
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
    let begin = Follower::<f64>::new(Plant::new(parameters), start);
    let mut follower = begin.clone();
    let truth: Vec<Period> = (0..LONGEST).map(|_| follower.next_period()).collect();
    if follower.is_exhausted() {
        return None;
    }
    let [fine, coarse] = [FINE, COARSE].map(|noise| horizon(&begin, &truth, noise));
    Some(Case { family, parameters, start, truth, fine, coarse })
}

/// The largest deviation of a state, relative to the largest component where that is above 1; not a number where a
/// component is none.
pub fn deviation(state: &[f64], exact: &[f64]) -> f64 {
    let differences = state.iter().zip(exact).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |worst, d| if d <= worst { worst } else { d }) / scale(exact)
}

/// The largest component of a state, or 1.
fn scale(state: &[f64]) -> f64 {
    state.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()))
}

/// For how long a trajectory is comparable with its exact course under noise.
pub fn horizon(begin: &Follower<f64>, truth: &[Period], noise: Noise) -> Horizon {
    let limit = noise.limit * noise.size;
    let companions: Vec<Vec<Period>> =
        (0..COMPANIONS).map(|seed| companion(begin, truth, noise, seed)).collect();
    let spread = |period: usize| {
        let off = |companion: &Vec<Period>| {
            companion.get(period).map_or(f64::INFINITY, |p| deviation(&p.strobe, &truth[period].strobe))
        };
        companions.iter().map(off).fold(0.0, f64::max)
    };
    let agree = |period: usize| {
        truth[period].chatters == [0, 0]
            && truth[period].impacts.iter().all(|impact| impact.velocity_before.abs() > limit)
            && companions.iter().all(|c| c.get(period).is_some_and(|p| p.counts() == truth[period].counts()))
    };
    let sound = (0..truth.len()).take_while(|&period| spread(period) <= limit).count();
    let countable = (0..sound).take_while(|&period| agree(period)).count();
    let periods = sound.max(noise.at_least);
    let slack = (0..periods).map(|period| spread(period) / limit).fold(1.0, f64::max);
    Horizon { periods, countable, slack }
}

/// A trajectory under noise, for as long as it is comparable with the exact one, and at least as long as asked for.
fn companion(begin: &Follower<f64>, truth: &[Period], noise: Noise, seed: u64) -> Vec<Period> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut displacement =
        |at: [f64; 4]| [(); 4].map(|()| noise.size * scale(&at) * if rng.random() { 1.0 } else { -1.0 });
    let mut follower = begin.clone().with_roughness(noise.size, seed);
    let mut periods = Vec::new();
    for exact in truth {
        follower.nudge(displacement(follower.position()));
        let period = follower.next_period();
        let lost = deviation(&period.strobe, &exact.strobe) > noise.limit * noise.size;
        periods.push(period);
        if follower.is_exhausted() || (lost && periods.len() >= noise.at_least) {
            break;
        }
    }
    periods
}
