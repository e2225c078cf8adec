//! Jacobians against central differences of the simulated map, and multipliers against measured decay.

use impact_atlas::dynamics::{Event, Trajectory};
use impact_atlas::model::{Flight, Parameters, State, System};
use impact_atlas::theory::{Return, impact_map, settled_motion};
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::at;

fn random_system(rng: &mut ChaCha8Rng) -> System {
    let parameters = Parameters {
        omega: rng.random_range(0.3..5.0),
        delta: rng.random_range(0.02..0.6),
        zeta: rng.random_range(0.0..0.4),
        r: rng.random_range(0.2..1.0),
        mu_m: rng.random_range(0.2..0.8),
        mu_k: rng.random_range(0.2..0.8),
        mu_c: rng.random_range(0.2..0.8),
        f20: rng.random_range(0.0..1.0),
    };
    System::new(parameters).unwrap()
}

/// Central differences of the simulated impact map, extrapolated; none where a neighbour takes another way.
pub fn differences(system: &System, section: &[f64], h: f64) -> Option<DMatrix<f64>> {
    let way = |back: &Return| back.impacts.iter().map(|node| node.stop).collect::<Vec<_>>();
    let ways = way(&impact_map(system, section).ok()?);
    let mut matrix = DMatrix::zeros(section.len(), section.len());
    for j in 0..section.len() {
        let at = |offset: f64| {
            let mut moved = section.to_vec();
            moved[j] += offset;
            let back = impact_map(system, moved).ok()?;
            (way(&back) == ways).then(|| DVector::from_vec(back.section))
        };
        let central = |h: f64| Some((at(h)? - at(-h)?) / (2.0 * h));
        matrix.set_column(j, &((central(h)? * 4.0 - central(2.0 * h)?) / 3.0));
    }
    Some(matrix)
}

/// Sections of the random systems: states of their own orbits, so that all sorts of impacts are met.
fn sections(system: &System, rng: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
    let mut section = vec![
        -rng.random_range(0.0..2.0),
        rng.random_range(-1.0..1.0),
        rng.random_range(-1.0..1.0),
        rng.random_range(0.0..6.0),
    ];
    let mut found = Vec::new();
    while found.len() < 6 {
        found.push(section.clone());
        let Ok(back) = impact_map(system, &section) else { break };
        section = back.section;
        section[3] = section[3].rem_euclid(std::f64::consts::TAU);
    }
    found
}

#[test]
fn jacobians_are_the_derivatives_of_the_simulated_map() {
    let mut rng = ChaCha8Rng::seed_from_u64(20_090_523);
    let (mut compared, mut worst, mut slowest) = (0, 0.0f64, f64::INFINITY);
    for _ in 0..300 {
        let system = random_system(&mut rng);
        for section in sections(&system, &mut rng) {
            let Ok(back) = impact_map(&system, &section) else { continue };
            let Some(jacobian) = back.jacobian else { continue };
            // Near grazing the map bends as the square of the speed: smaller differences, and less of them left.
            let speed = back.impacts.iter().map(|node| node.section[0].abs()).fold(f64::INFINITY, f64::min);
            if speed < 1e-2 {
                continue;
            }
            let h = 3e-4 * speed * speed / (1.0 + speed * speed);
            let Some(simulated) = differences(&system, &section, h) else { continue };
            let difference = (&jacobian - simulated).amax() / jacobian.amax();
            assert!(
                difference < 1e-6,
                "{difference:.1e} at {section:?} of {:?}, {speed}",
                system.parameters()
            );
            worst = worst.max(difference);
            slowest = slowest.min(speed);
            compared += 1;
        }
    }
    assert!(compared > 400, "{compared}");
    assert!(slowest < 0.02, "impacts near grazing are among them: {slowest}");
    println!("{compared} Jacobians, worst {worst:.1e}, slowest impact {slowest:.1e}");
}

#[test]
fn a_wrong_jacobian_is_noticed() {
    let system = at(2.83, 0.1);
    let section = [-0.4, -0.03, 0.03, 1.8];
    let jacobian = impact_map(&system, section).unwrap().jacobian.unwrap();
    let simulated = differences(&system, &section, 1e-5).unwrap();
    assert!((&jacobian - &simulated).amax() < 1e-6 * jacobian.amax());
    let other = impact_map(&at(2.8301, 0.1), section).unwrap().jacobian.unwrap();
    assert!((other - simulated).amax() > 1e-6 * jacobian.amax());
}

/// The state so many forcing periods later; phase 0 both times.
pub fn strobe(system: &System, state: impl AsRef<[f64]>, periods: u32) -> [f64; 4] {
    let flight = Flight::<f64, 2>::new(system);
    let mut trajectory = Trajectory::new(&flight, State::from_slice(state.as_ref()));
    for _ in 0..periods {
        while trajectory.advance(&flight, &mut []).event != Event::Strobe {}
    }
    std::array::from_fn(|i| trajectory.point.state.get(i))
}

/// A perturbation of a stable motion decays by its leading multiplier per period.
#[test]
fn multipliers_are_the_decay_of_perturbations() {
    for (omega, delta) in [(3.7, 0.1), (3.5, 0.1), (1.72, 0.1), (2.95, 0.1)] {
        let system = at(omega, delta);
        let strobe = |state: [f64; 4], periods: u32| strobe(&system, state, periods);
        let fixed = strobe([0.0; 4], 20_000);
        let n = if omega == 2.95 { 2 } else { 1 };
        let motion = settled_motion(&system, fixed, n).unwrap();
        let leading = motion.multipliers(&system).unwrap()[0].norm();
        let mut away = fixed;
        away[1] += 1e-3;
        let distance =
            |state: [f64; 4]| state.iter().zip(&fixed).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        // A complex pair turns: its distance is compared where it is largest, within windows, all of them well
        // above rounding.
        let length = (1e-3f64.ln() / leading.ln()).clamp(6.0, 40.0) as u32;
        let window = |state: &mut [f64; 4]| {
            let mut largest = 0.0f64;
            for _ in 0..length {
                *state = strobe(*state, n);
                largest = largest.max(distance(*state));
            }
            largest
        };
        let mut state = strobe(away, 8 * n);
        let (first, second) = (window(&mut state), window(&mut state));
        let measured = (second / first).powf(1.0 / f64::from(length));
        assert!((measured - leading).abs() < 0.01, "{omega}: {measured} {leading}");
        assert!(leading < 1.0);
    }
}
