//! Systems and starts drawn over the whole parameter range, the same on every run.

use impact_atlas::model::Parameters;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::oracle::{Follower, Plant};

/// Why a case is in the suite.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Family {
    /// The points that the paper names, from rest.
    Paper,
    /// Anything in the parameter range, ends included.
    General,
    /// Low frequencies, where impacts accumulate and M1 sticks.
    Chatter,
    /// A clearance within 1e-2 … 1e-7 of the largest excursion of the first periods.
    Grazing,
    /// Forcing within 1 % of a natural frequency, little or no damping.
    Resonant,
    /// A start on a stop: at rest, moving off it or into it.
    OnStop,
    /// The first strobe falls into the last hops of a chatter.
    LastHops,
    /// A narrow clearance: the mass crosses it many times in a period, and in one flight off the other stop.
    Narrow,
}

/// A system with a start at forcing phase 0.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Why it is there.
    pub family: Family,
    /// The system.
    pub parameters: Parameters,
    /// (x1, x2, v1, v2).
    pub start: [f64; 4],
}

/// Every setup of the suite.
pub fn setups() -> Vec<Setup> {
    let mut rng = ChaCha8Rng::seed_from_u64(0x01AC_7A71_A500_0002);
    let mut setups = paper();
    setups.extend((0..300).map(|_| general(&mut rng)));
    setups.extend((0..80).map(|_| chatter(&mut rng)));
    setups.extend((0..60).map(|_| grazing(&mut rng)));
    setups.extend((0..40).map(|_| resonant(&mut rng)));
    setups.extend((0..40).map(|_| on_stop(&mut rng)));
    setups.extend((0..12).map(|_| last_hops(&mut rng, 1e-6)));
    setups.extend((0..12).map(|_| last_hops(&mut rng, 1e-4)));
    setups.extend(thrown());
    setups.extend((0..60).map(|_| narrow(&mut rng, 1e-4, 1e-2)));
    setups
}

/// The points of the paper page's table.
fn paper() -> Vec<Setup> {
    let low_clearance = [3.7, 3.5, 3.03, 2.95, 2.93193, 2.83, 1.72, 1.65, 1.63, 1.628, 0.65, 0.60, 0.57]
        .map(|omega| (omega, 0.1));
    let others = [(2.582, 0.6), (2.57, 0.6), (0.35, 0.545), (0.30, 0.545), (0.25, 0.545)];
    let points = low_clearance.into_iter().chain(others);
    let at = |(omega, delta)| Parameters { omega, delta, ..Parameters::default() };
    points.map(|point| Setup { family: Family::Paper, parameters: at(point), start: [0.0; 4] }).collect()
}

fn log_uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    rng.random_range(low.ln()..high.ln()).exp()
}

/// Three ratios between 0.1 and 0.9: all equal, proportional damping, or all different.
fn ratios(rng: &mut ChaCha8Rng) -> [f64; 3] {
    let [first, second, third] = [(); 3].map(|()| rng.random_range(0.1..0.9));
    match rng.random_range(0..3) {
        0 => [first; 3],
        1 => [first, second, second],
        _ => [first, second, third],
    }
}

fn any_system(rng: &mut ChaCha8Rng) -> Parameters {
    let [mu_m, mu_k, mu_c] = ratios(rng);
    Parameters {
        omega: log_uniform(rng, 0.2, 6.0),
        delta: log_uniform(rng, 0.01, 1.5),
        zeta: match rng.random_range(0..10) {
            0 => 0.0,
            1 | 2 => rng.random_range(1.0..2.0),
            _ => log_uniform(rng, 0.01, 1.0),
        },
        r: match rng.random_range(0..12) {
            0 => 0.0,
            1 => 1.0,
            _ => rng.random_range(0.0..0.98),
        },
        mu_m,
        mu_k,
        mu_c,
        f20: match rng.random_range(0..10) {
            0..3 => 0.0,
            3 => 1.0,
            _ => rng.random_range(0.0..1.0),
        },
    }
}

/// At rest in one case of three, otherwise anywhere inside the stops.
fn any_start(rng: &mut ChaCha8Rng, delta: f64) -> [f64; 4] {
    if rng.random_range(0..3) == 0 {
        return [0.0; 4];
    }
    let mut within = |bound: f64| rng.random_range(-bound..bound);
    [within(0.99 * delta), within(delta + 0.3), within(1.0), within(0.7)]
}

fn general(rng: &mut ChaCha8Rng) -> Setup {
    let parameters = any_system(rng);
    Setup { family: Family::General, parameters, start: any_start(rng, parameters.delta) }
}

fn chatter(rng: &mut ChaCha8Rng) -> Setup {
    let [mu_m, mu_k, mu_c] = if rng.random() { [0.5; 3] } else { ratios(rng) };
    let parameters = Parameters {
        omega: rng.random_range(0.2..0.5),
        delta: rng.random_range(0.1..0.3),
        r: rng.random_range(0.5..0.8),
        mu_m,
        mu_k,
        mu_c,
        ..Parameters::default()
    };
    Setup { family: Family::Chatter, parameters, start: any_start(rng, parameters.delta) }
}

fn grazing(rng: &mut ChaCha8Rng) -> Setup {
    let free = Parameters { delta: 1e3, ..any_system(rng) };
    let start = any_start(rng, 0.3);
    let mut follower = Follower::<f64>::new(Plant::new(free), start);
    let mut excursion = 0.0_f64;
    for _ in 0..3 {
        for sample in 1..=2000 {
            follower.advance(follower.period() * (f64::from(sample) / 2000.0));
            excursion = excursion.max(follower.position()[0].abs());
        }
        follower.finish_period();
    }
    let off = log_uniform(rng, 1e-7, 1e-2) * if rng.random() { 1.0 } else { -1.0 };
    let delta = excursion.max(start[0].abs() + 1e-3) * (1.0 + off);
    Setup { family: Family::Grazing, parameters: Parameters { delta, ..free }, start }
}

fn resonant(rng: &mut ChaCha8Rng) -> Setup {
    let drawn = any_system(rng);
    let mass = drawn.mu_m / (1.0 - drawn.mu_m);
    let stiffness = 1.0 / (1.0 - drawn.mu_k);
    // ω² from det(K − ω² M) = mass ω⁴ − (mass + stiffness) ω² + stiffness − 1.
    let half = 0.5 * (mass + stiffness);
    let root = (half * half - mass * (stiffness - 1.0)).sqrt();
    let square = if rng.random() { half + root } else { half - root } / mass;
    let parameters = Parameters {
        omega: square.sqrt() * rng.random_range(0.99..1.01),
        zeta: if rng.random() { 0.0 } else { log_uniform(rng, 1e-3, 3e-2) },
        ..drawn
    };
    Setup { family: Family::Resonant, parameters, start: any_start(rng, parameters.delta) }
}

fn on_stop(rng: &mut ChaCha8Rng) -> Setup {
    let parameters = any_system(rng);
    let [_, x2, _, v2] = any_start(rng, parameters.delta);
    let stop = if rng.random() { parameters.delta } else { -parameters.delta };
    let v1 = if rng.random() { 0.0 } else { rng.random_range(-1.0..1.0) };
    Setup { family: Family::OnStop, parameters, start: [stop, x2, v1, v2] }
}

/// Systems in which a mass that is released is at the other stop before the force has grown much.
pub fn thrown() -> [Setup; 3] {
    let family = Family::Narrow;
    let narrow = Parameters { omega: 2.0, delta: 1e-4, ..Parameters::default() };
    let resonant =
        Parameters { omega: 1.414, delta: 0.1, zeta: 0.0005, r: 0.6, f20: 1.0, ..Parameters::default() };
    [
        Setup { family, parameters: narrow, start: [0.0, 0.1, 1e-4, 0.05] },
        Setup { family, parameters: narrow, start: [0.0; 4] },
        Setup { family, parameters: resonant, start: [0.0; 4] },
    ]
}

/// A clearance, damping, masses and stiffnesses drawn logarithmically, near a resonance one time in three, and a start
/// on a stop every other time.
pub fn narrow(rng: &mut ChaCha8Rng, least: f64, most: f64) -> Setup {
    let share = |ratio: f64| ratio / (1.0 + ratio);
    let (mass, ground) = (log_uniform(rng, 1e-2, 1e2), log_uniform(rng, 0.05, 20.0));
    // ω⁴ − 2 half ω² + ground/mass = 0 at the natural frequencies.
    let half = 0.5 * (1.0 + (1.0 + ground) / mass);
    let fast = half + (half * half - ground / mass).sqrt();
    let omega = match rng.random_range(0..6) {
        0 => fast.sqrt() * rng.random_range(0.99..1.01),
        1 => (ground / mass / fast).sqrt() * rng.random_range(0.99..1.01),
        _ => log_uniform(rng, 0.3, 6.0),
    };
    let parameters = Parameters {
        omega: omega.max(0.1),
        delta: log_uniform(rng, least, most),
        zeta: log_uniform(rng, 1e-4, 1.0),
        r: if rng.random_range(0..8) == 0 { 0.0 } else { rng.random_range(0.0..0.95) },
        mu_m: share(mass),
        mu_k: share(ground),
        mu_c: share(log_uniform(rng, 0.05, 20.0)),
        f20: match rng.random_range(0..4) {
            0 => 0.0,
            1 => 1.0,
            _ => rng.random_range(0.0..1.0),
        },
    };
    let delta = parameters.delta;
    let x1 = match rng.random_range(0..4) {
        0 => delta,
        1 => -delta,
        _ => rng.random_range(-delta..delta),
    };
    let v1 = if rng.random() { 0.0 } else { rng.random_range(-0.1..0.1) };
    let start = [x1, rng.random_range(-1.0..1.0) * (delta + 0.1), v1, rng.random_range(-0.5..0.5)];
    Setup { family: Family::Narrow, parameters, start }
}

/// A chatter that is over just after the first strobe: v2 is bisected between a start that is caught before the
/// strobe and one that is not, until the last rebound before the strobe is about as slow as asked for.
fn last_hops(rng: &mut ChaCha8Rng, slowest: f64) -> Setup {
    loop {
        // A heavy second mass lags behind, so that M1 can be at rest at phase 0.
        let mut setup = Setup { family: Family::LastHops, ..chatter(rng) };
        setup.parameters.mu_m = rng.random_range(0.8..0.9);
        let [x1, x2, v1, _] = setup.start;
        let follower = Follower::<f64>::new(Plant::new(setup.parameters), setup.start);
        let hop = |v2: f64| hop_at_strobe(follower.another([x1, x2, v1, v2]));
        let (mut caught, mut flying) = (rng.random_range(-1.0..1.0), rng.random_range(-1.0..1.0));
        if hop(caught).is_some() || hop(flying).is_none() {
            continue;
        }
        for _ in 0..40 {
            let middle = 0.5 * (caught + flying);
            match hop(middle) {
                None => caught = middle,
                Some(rebound) if (slowest..100.0 * slowest).contains(&rebound) => {
                    return Setup { start: [x1, x2, v1, middle], ..setup };
                }
                Some(_) => flying = middle,
            }
        }
    }
}

/// The last rebound before the first strobe, unless M1 rests at the strobe.
fn hop_at_strobe(mut follower: Follower<f64>) -> Option<f64> {
    let period = follower.next_period();
    let rebound = period.impacts.last().map_or(f64::INFINITY, |impact| impact.velocity_after.abs());
    (!follower.rests()).then_some(rebound)
}
