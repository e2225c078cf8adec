//! Random systems over the whole range of parameters that is accepted: nothing panics, nothing is NaN, and what is
//! solved is what was simulated.

use impact_atlas::analysis::{Schedule, Verdict};
use impact_atlas::backend::{Job, follow};
use impact_atlas::dynamics::Stop;
use impact_atlas::model::{Parameters, System};
use impact_atlas::theory::{SettledMotion, Spectrum, StrobeMotion, symmetric_motions, symmetric_start};
use nalgebra::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A number whose logarithm is evenly distributed.
fn spread(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    rng.random_range(low.ln()..high.ln()).exp()
}

/// A system with any parameter anywhere in its range, at its ends with some probability.
fn any_system(rng: &mut ChaCha8Rng) -> System {
    loop {
        let ends = |rng: &mut ChaCha8Rng, inside: f64, ends: &[f64]| {
            if rng.random_bool(0.15) { ends[rng.random_range(0..ends.len())] } else { inside }
        };
        let omega = spread(rng, 0.05, 30.0);
        let delta = spread(rng, 1e-5, 10.0);
        let zeta = spread(rng, 1e-6, 5.0);
        let r = rng.random_range(0.0..=1.0);
        let mut share = || {
            let inside = rng.random_range(0.05..0.95);
            ends(rng, inside, &[1e-3, 1.0 - 1e-3])
        };
        let (mu_m, mu_k, mu_c) = (share(), share(), share());
        let parameters = Parameters {
            omega,
            delta: ends(rng, delta, &[0.0, 1e-9]),
            zeta: ends(rng, zeta, &[0.0, 1e-300]),
            r: ends(rng, r, &[0.0, 1.0, 1e-300, 1e-10]),
            mu_m,
            mu_k,
            mu_c,
            f20: ends(rng, r.fract(), &[0.0, 1.0, 0.5]),
        };
        let Ok(system) = System::new(parameters) else { continue };
        // Stiff ones take long.
        if system.steps() <= 1000 || rng.random_bool(0.05) {
            return system;
        }
    }
}

fn finite(values: Option<Vec<Complex<f64>>>) -> bool {
    values.is_none_or(|values| values.iter().all(|value| value.re.is_finite() && value.im.is_finite()))
}

#[test]
fn the_symmetric_motion_is_solved_or_refused_anywhere() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let (mut physical, mut not) = (0, 0);
    for _ in 0..2000 {
        let system = any_system(&mut rng);
        let context = system.parameters();
        let Ok(solutions) = symmetric_motions(&system) else { continue };
        for solution in &solutions {
            let motion = &solution.motion;
            let section = motion.section();
            assert!(section.iter().all(|value| value.is_finite()), "{context:?}: {section:?}");
            assert!(section[3] >= 0.0 && section[3] < std::f64::consts::TAU, "{context:?}: {section:?}");
            let size = section.iter().fold(1.0f64, |size, value| size.max(value.abs()));
            assert!(motion.residual < 1e-7 * size, "{context:?}: {:.1e}", motion.residual);
            assert!(finite(motion.half_multipliers(&system)), "{context:?}");
            assert!(finite(motion.multipliers(&system)), "{context:?}");
            match &solution.at_phase_zero {
                Ok(state) => {
                    physical += 1;
                    let exact = motion.at_phase_zero(&system);
                    let scale = 1.0 + exact.iter().fold(0.0f64, |a, b| a.max(b.abs()));
                    for (a, b) in state.iter().zip(&exact) {
                        assert!((a - b).abs() < 1e-8 * scale, "{context:?}: {state:?} {exact:?}");
                    }
                }
                Err(_) => not += 1,
            }
        }
        assert!(symmetric_start(&system).is_none_or(|state| state.iter().all(|value| value.is_finite())));
    }
    assert!(physical > 150 && not > 150, "{physical} {not}");
    println!("{physical} physical, {not} not");
}

#[test]
fn spectra_are_numbers_anywhere() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let (mut measured, mut worst) = (0, 0.0f64);
    for _ in 0..150 {
        let system = any_system(&mut rng);
        let context = system.parameters();
        let Ok(spectrum) = Spectrum::of(&system, [0.0; 4], 8, 16) else { continue };
        let kept = 4 - spectrum.lost as usize;
        assert!(
            spectrum.per_period[..kept].iter().all(|value| value.is_finite()),
            "{context:?}: {spectrum:?}"
        );
        assert!(spectrum.per_period[kept..].iter().all(|&value| value == f64::NEG_INFINITY), "{context:?}");
        assert!(spectrum.standard_error.iter().all(|value| value.is_finite()), "{context:?}: {spectrum:?}");
        assert!(spectrum.per_period.is_sorted_by(|a, b| a >= b), "{context:?}: {spectrum:?}");
        let returns = [Stop::A, Stop::B].map(|stop| spectrum.returns(stop));
        assert!(returns.iter().flatten().sum::<u64>() <= spectrum.impacts, "{context:?}: {spectrum:?}");
        if spectrum.lost == 0 && context.r > 1e-4 {
            let expected = spectrum.sum_identity(&system);
            let sum: f64 = spectrum.per_period.iter().sum();
            let away = (sum - expected).abs() / (1.0 + expected.abs());
            assert!(away < 1e-3, "{context:?}: {sum} {expected}");
            worst = worst.max(away);
            measured += 1;
        }
    }
    assert!(measured > 30, "{measured}");
    println!("{measured} sums, worst {worst:.1e}");
}

/// The settled cells of a random map, and where their trajectories are at the end.
fn settled(
    seed: u64,
    cells: usize,
    mut system: impl FnMut(&mut ChaCha8Rng) -> System,
) -> Vec<(System, Verdict)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let schedule = Schedule { transient: 3000, observe: 200, max_period: 16, fixed_periods: true };
    let mut found = Vec::new();
    for _ in 0..cells {
        let system = system(&mut rng);
        let verdict = follow::<f64>(&Job { system: system.clone(), start: [0.0; 4].into() }, &schedule);
        if verdict.regime.is_periodic() {
            found.push((system, verdict));
        }
    }
    found
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let scale = 1.0 + b.iter().fold(0.0f64, |scale, value| scale.max(value.abs()));
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

/// How far a trajectory's last state is from the motion: from the nearest of its N states at phase 0.
fn off(system: &System, motion: &SettledMotion, verdict: &Verdict) -> f64 {
    let state = motion.at_phase_zero(system);
    let turns = 0..u32::from(verdict.n);
    let away = |k: u32| distance(&super::jacobians::strobe(system, &state, k), &verdict.state);
    turns.map(away).fold(f64::INFINITY, f64::min)
}

#[test]
fn settled_motions_are_the_simulated_ones() {
    let usual = |rng: &mut ChaCha8Rng| {
        let parameters = Parameters {
            omega: rng.random_range(0.3..5.0),
            delta: rng.random_range(0.02..0.6),
            zeta: rng.random_range(0.05..0.3),
            r: rng.random_range(0.0..0.9),
            ..Parameters::default()
        };
        System::new(parameters).unwrap()
    };
    let cells = settled(3, 300, usual);
    let (mut solved, mut sticking, mut worst) = (0, 0, 0.0f64);
    let mut missed = Vec::new();
    for (system, verdict) in &cells {
        let context = system.parameters();
        let Ok(motion) = SettledMotion::of(system, verdict) else {
            missed.push((context, verdict.label()));
            continue;
        };
        let away = off(system, &motion, verdict);
        if motion.is_stable(system) != Some(true) || away > 1e-6 || motion.label() != verdict.label() {
            missed.push((context, format!("{} {} {away:.1e}", verdict.label(), motion.label())));
            continue;
        }
        sticking += usize::from(matches!(motion, SettledMotion::Strobe(_)));
        solved += 1;
        worst = worst.max(away);
    }
    println!("{solved} of {} solved, {sticking} on the strobe map, worst {worst:.1e}", cells.len());
    assert!(missed.is_empty(), "{} missed: {missed:#?}", missed.len());
    assert!(solved > 100 && sticking > 10, "{solved} {sticking}");
    // The check can fail: the motion is not that of a neighbouring system.
    let (system, verdict) = &cells[0];
    let other = Parameters { zeta: system.parameters().zeta * 1.01, ..system.parameters() };
    let other = System::new(other).unwrap();
    let motion = SettledMotion::of(&other, verdict).unwrap();
    assert!(off(&other, &motion, verdict) > 1e-6);
}

#[test]
fn settled_motions_are_solved_or_refused_anywhere() {
    let cells = settled(4, 60, any_system);
    let (mut solved, mut refused) = (0, 0);
    for (system, verdict) in &cells {
        let context = system.parameters();
        match SettledMotion::of(system, verdict) {
            Ok(motion) => {
                let state = motion.at_phase_zero(system);
                assert!(state.iter().all(|value| value.is_finite()), "{context:?}: {state:?}");
                assert!(finite(motion.multipliers(system)), "{context:?}");
                solved += 1;
            }
            Err(_) => {
                println!("refused: {} of {context:?}", verdict.label());
                refused += 1;
            }
        }
    }
    println!("{solved} solved, {refused} refused");
    assert!(solved > 20 * refused, "{solved} {refused}");
}

/// The strobe map's Jacobian against central differences, with sticking and without.
#[test]
fn jacobians_of_the_strobe_map_are_its_derivatives() {
    for (omega, delta) in [(0.25, 0.545), (3.5, 0.1), (1.65, 0.1)] {
        let system = super::at(omega, delta);
        let schedule = Schedule { transient: 2000, observe: 200, max_period: 4, fixed_periods: true };
        let verdict = follow::<f64>(&Job { system: system.clone(), start: [0.0; 4].into() }, &schedule);
        let motion = StrobeMotion::refine(&system, verdict.state, u32::from(verdict.n)).unwrap();
        assert_eq!(motion.label(), verdict.label());
        let mut worst = 0.0f64;
        for j in 0..4 {
            let at = |offset: f64| {
                let mut state = motion.state.clone();
                state[j] += offset;
                super::jacobians::strobe(&system, state, motion.n)
            };
            let h = 1e-6;
            let (above, below) = (at(h), at(-h));
            for i in 0..4 {
                let difference = (above[i] - below[i]) / (2.0 * h);
                worst = worst.max((motion.jacobian[(i, j)] - difference).abs());
            }
        }
        assert!(worst < 1e-5 * (1.0 + motion.jacobian.amax()), "{omega}: {worst:.1e}");
        assert!(motion.jacobian.amax() > 1e-3, "the check can fail");
        assert_eq!(motion.is_stable(), Some(true));
    }
}
