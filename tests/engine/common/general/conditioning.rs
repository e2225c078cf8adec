//! For how long a case can be compared: companions of the exact trajectory, displaced at random at every strobe between
//! stops that are rough by as much, show how errors grow.

use std::sync::LazyLock;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::draw::{Setup, setups};
use super::follow::{Follower, Period};

/// The longest comparison, in forcing periods.
pub const LONGEST: usize = 20;

/// Cases of the suite.
const CASES: usize = 480;

/// Companions per case and noise level.
const COMPANIONS: u64 = 4;

/// How errors of one size grow: they are so large, and may become so many times as large.
#[derive(Clone, Copy, Debug)]
pub struct Noise {
    pub size: f64,
    pub limit: f64,
}

/// For trajectories in f64.
pub const FINE: Noise = Noise { size: 1e-10, limit: 1e3 };
/// For trajectories in f32.
pub const COARSE: Noise = Noise { size: 3e-6, limit: 10.0 };

/// For how long a case is comparable.
#[derive(Clone, Debug)]
pub struct Horizon {
    /// Forcing periods for which states are comparable.
    pub periods: usize,
    /// In which of those impacts can be counted: they are finitely many, none at one instant, and the same for every
    /// companion.
    pub countable: Vec<bool>,
}

/// A setup with its exact trajectory.
#[derive(Clone, Debug)]
pub struct Case {
    pub setup: Setup,
    pub truth: Vec<Period>,
    /// How long f64 is comparable.
    pub fine: Horizon,
    /// How long f32 is comparable.
    pub coarse: Horizon,
}

/// Every case that can be followed; computed once per test binary.
pub fn cases() -> &'static [Case] {
    static CASES_: LazyLock<Vec<Case>> =
        LazyLock::new(|| setups(CASES, 0x9E_4E_7A_11).into_par_iter().filter_map(case).collect());
    &CASES_
}

/// A setup with its truth, unless its impacts are too many to be followed one by one.
pub fn case(setup: Setup) -> Option<Case> {
    let begin = Follower::new(setup.plant.clone(), &setup.start);
    let mut follower = begin.clone();
    let truth: Vec<Period> = (0..LONGEST).map(|_| follower.next_period()).collect();
    if follower.is_exhausted() {
        return None;
    }
    let [fine, coarse] = [FINE, COARSE].map(|noise| horizon(&begin, &truth, noise));
    Some(Case { setup, truth, fine, coarse })
}

/// The largest deviation of a state, relative to the largest component where that is above 1; infinite where it is no
/// number.
pub fn deviation(state: &[f64], exact: &[f64]) -> f64 {
    assert_eq!(state.len(), exact.len());
    let scale = exact.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()));
    let off = state.iter().zip(exact).map(|(a, b)| (a - b).abs() / scale);
    off.fold(0.0, |worst, d| {
        if d <= worst {
            worst
        } else if d.is_nan() {
            f64::INFINITY
        } else {
            d
        }
    })
}

fn horizon(begin: &Follower, truth: &[Period], noise: Noise) -> Horizon {
    let companions: Vec<Vec<Period>> =
        (0..COMPANIONS).map(|seed| companion(begin, truth, noise, seed)).collect();
    let near = |period: &usize| {
        let exact = &truth[*period];
        let off =
            |c: &Vec<Period>| c.get(*period).map_or(f64::INFINITY, |p| deviation(&p.strobe, &exact.strobe));
        companions.iter().all(|c| off(c) <= noise.limit * noise.size)
    };
    let periods = (0..truth.len()).take_while(near).count();
    let alike = |period: usize| {
        let exact = &truth[period];
        !exact.chatters && !exact.coincides && companions.iter().all(|c| c[period].impacts == exact.impacts)
    };
    Horizon { periods, countable: (0..periods).map(alike).collect() }
}

fn companion(begin: &Follower, truth: &[Period], noise: Noise, seed: u64) -> Vec<Period> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut follower = begin.clone();
    let mut signed = |size: f64| if rng.random() { size } else { -size };
    let off: Vec<f64> = (0..4).map(|_| signed(noise.size)).collect();
    follower = follower.with_roughness(&off);
    let mut periods = Vec::new();
    for exact in truth {
        let state = follower.state();
        let scale = state.iter().fold(1.0, |scale: f64, x| scale.max(x.abs()));
        let by: Vec<f64> = state.iter().map(|_| signed(noise.size * scale)).collect();
        follower.nudge(&by);
        let period = follower.next_period();
        let lost = deviation(&period.strobe, &exact.strobe) > noise.limit * noise.size;
        if follower.is_exhausted() {
            break;
        }
        periods.push(period);
        if lost {
            break;
        }
    }
    periods
}
