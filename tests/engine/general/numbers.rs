//! A published or derived number for every family that comes with the program, on both back ends.

use std::f64::consts::{PI, TAU};

use impact_atlas::analysis::{Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Cpu, Job, Unwatched, decide};
use impact_atlas::model::{Setting, StateVector, System};
use impact_atlas::system::Family;
use nalgebra::{Complex, DMatrix, DVector};

use crate::common::adapter::gpu;

const SCHEDULE: Schedule = Schedule { transient: 1500, observe: 300, max_period: 16, fixed_periods: false };

/// A cell: a family, its parameters, and where it begins.
struct Cell {
    family: &'static str,
    parameters: Vec<(&'static str, f64)>,
    start: Vec<f64>,
}

impl Cell {
    fn new(family: &'static str, parameters: &[(&'static str, f64)], start: &[f64]) -> Self {
        Cell { family, parameters: parameters.to_vec(), start: start.to_vec() }
    }

    fn system(&self) -> System {
        let defaults = Setting::defaults(Family::builtin(self.family));
        let setting =
            self.parameters.iter().fold(defaults, |setting, (name, value)| setting.with_named(name, *value));
        System::new(setting).unwrap()
    }

    fn verdict(&self, backend: &dyn Backend) -> Verdict {
        let start = StateVector::from_slice(&self.start).unwrap();
        let job = Job { system: self.system(), start };
        decide(backend, &[job], &SCHEDULE, &Unwatched).unwrap().remove(0)
    }
}

/// The verdicts of both back ends, with the accuracy to hold each to.
fn verdicts(cell: &Cell) -> [(Verdict, f64); 2] {
    [(cell.verdict(&Cpu), 1e-9), (cell.verdict(gpu()), 2e-6)]
}

/// Demands a motion and the speed of its hardest impact.
fn moves(cell: &Cell, label: &str, speed: f64) {
    for (verdict, accuracy) in verdicts(cell) {
        assert_eq!(verdict.label(), label, "{} {:?}: {verdict:?}", cell.family, cell.parameters);
        let off = (f64::from(verdict.peak_impact_velocity) / speed - 1.0).abs();
        // Peak velocities are reported in single precision.
        assert!(off < accuracy.max(2e-7), "{}: off by {off:e}: {verdict:?}, not {speed}", cell.family);
    }
}

#[test]
fn the_coco_books_impact_oscillator() {
    // H. Dankowicz, F. Schilder, Recipes for Continuation (SIAM 2013): x'' + 0.1 x' + x = cos t, a stop at 1, e = 0.8.
    let cell = |r| {
        let parameters = [("omega", 1.0), ("zeta", 0.05), ("sigma", 1.0), ("r", r)];
        Cell::new("shaw-holmes", &parameters, &[0.0, 0.0])
    };
    moves(&cell(0.8), "1-1", 1.695_732_937_59);
    let (other, _) = verdicts(&cell(0.79))[0];
    assert!((f64::from(other.peak_impact_velocity) - 1.695_732_937_59).abs() > 1e-3, "another restitution");
}

#[test]
fn the_ball_on_the_table() {
    // In one period the table must return what gravity took, 2π: v− = −2π/(1 + e). Born at Γ = π (1 − e)/(1 + e), the 1-1
    // motion doubles its period at Γ² = (π (1 − e)/(1 + e))² + (2 (1 + e²)/(1 + e)²)² (P. J. Holmes 1982).
    for (e, born, doubled) in [(0.5, PI / 3.0, 1.526_824), (0.8, PI / 9.0, 1.070_836)] {
        let at = |gamma: f64, shift: f64| {
            // On the motion: it leaves the table at the phase φ with cos φ = π (1 − e)/((1 + e) Γ), at 2π e/(1 + e).
            let phase = (PI * (1.0 - e) / ((1.0 + e) * gamma)).acos();
            let speed = TAU * e / (1.0 + e);
            let left = TAU - phase;
            let v = speed - left + gamma * (phase.cos() - 1.0);
            let y = speed * left - 0.5 * left * left + gamma * (phase.cos() * left + phase.sin());
            Cell::new("bouncing-ball", &[("Gamma", gamma), ("r", e)], &[y + shift, v])
        };
        for gamma in [born + 0.02, doubled - 0.01] {
            moves(&at(gamma, 1e-3), "1-1", TAU / (1.0 + e));
        }
        for (verdict, _) in verdicts(&at(doubled + 0.01, 1e-3)) {
            assert_eq!(verdict.label(), "2-2", "above the doubling: {verdict:?}");
        }
        let below = Cell::new("bouncing-ball", &[("Gamma", born - 0.02), ("r", e)], &[1.0, 0.0]);
        for (verdict, _) in verdicts(&below) {
            assert_ne!(verdict.label(), "1-1", "below its birth: {verdict:?}");
        }
    }
}

#[test]
fn the_impact_pair() {
    // The symmetric 1-1-1 motion leaves a wall at phase t0 with r v, arrives π later at the other with v: v (1 − r) = 2 cos t0,
    // 2ν = π cos t0 (1 + r)/(1 − r) + 2 sin t0.
    let (nu, r) = (1.5_f64, 0.6_f64);
    let lead = PI * (1.0 + r) / (1.0 - r);
    let angles = [1.0, -1.0].map(|sign| 2f64.atan2(lead) + sign * (2.0 * nu / lead.hypot(2.0)).acos());
    let speeds = angles.map(|t0| 2.0 * t0.cos() / (1.0 - r));
    let found: Vec<Verdict> = (0..40)
        .map(|i| Cell::new("impact-pair", &[("nu", nu), ("r", r)], &[0.0, 0.1 * f64::from(i) - 2.0]))
        .map(|cell| cell.verdict(&Cpu))
        .filter(|verdict| verdict.label() == "1-1-1" && verdict.symmetric)
        .collect();
    assert!(!found.is_empty(), "the symmetric motion is met from one of many starts");
    for verdict in &found {
        let speed = f64::from(verdict.peak_impact_velocity);
        assert!(speeds.iter().any(|expected| (speed / expected - 1.0).abs() < 2e-7), "{speed} of {speeds:?}");
        let start = verdict.state;
        let cell = Cell::new("impact-pair", &[("nu", nu), ("r", r)], &start);
        moves(
            &cell,
            "1-1-1",
            *speeds.iter().min_by(|a, b| (*a - speed).abs().total_cmp(&(*b - speed).abs())).unwrap(),
        );
    }
}

/// The amplitude of d·x in forced linear motion, by complex linear algebra, and the state of that motion at phase 0.
fn amplitude(system: &System, stop: usize) -> (f64, Vec<f64>) {
    let plant = system.plant();
    let i = Complex::i();
    let dynamic = DMatrix::from_fn(plant.n, plant.n, |a, b| {
        Complex::from(plant.stiffness[(a, b)] - plant.omega * plant.omega * plant.mass[(a, b)])
            + i * (plant.omega * plant.damping[(a, b)])
    });
    let force = DVector::from_fn(plant.n, |a, _| Complex::from(plant.force_cos[a]) - i * plant.force_sin[a]);
    let response = dynamic.lu().solve(&force).unwrap();
    let along = plant.stops[stop].direction.iter().zip(response.iter()).map(|(d, x)| x * *d);
    let state = response.iter().map(|x| x.re).chain(response.iter().map(|x| -plant.omega * x.im)).collect();
    (along.sum::<Complex<f64>>().norm(), state)
}

#[test]
fn grazing_is_met_where_the_gap_is_the_amplitude() {
    for (family, gap, parameters) in [
        ("two-sided", "delta", vec![("beta", 1.7)]),
        ("shaw-holmes", "sigma", vec![("zeta", 0.05)]),
        ("three-mass-chain", "delta", vec![("omega", 0.9)]),
        ("colliding-pair", "sigma", vec![("mu", 0.7)]),
        ("luo-ma-lv", "delta", vec![("omega", 1.3)]),
    ] {
        let rest = vec![0.0; 2 * Cell::new(family, &[], &[]).system().plant().n];
        let (limit, state) = amplitude(&Cell::new(family, &parameters, &rest).system(), 0);
        for (share, impacts) in [(1.001, false), (0.999, true)] {
            let mut at = parameters.clone();
            at.push((gap, limit * share));
            // From the linear motion itself: motions with impacts coexist with it.
            let start = Cell::new(family, &at, &rest).system().between_stops(state.clone());
            for (verdict, _) in verdicts(&Cell::new(family, &at, &start)) {
                let has_impacts = verdict.regime != Regime::NoImpact;
                assert_eq!(has_impacts, impacts, "{family} at {share} of the amplitude {limit}: {verdict:?}");
            }
        }
    }
}

#[test]
fn the_impact_damper() {
    // Two impacts a cycle (Masri and Caughey 1966). The container is forced motion plus e^(−ζt)(a cos νt + b sin νt), the
    // small mass flies with a constant speed w, and half a cycle later both are mirrored.
    let (omega, delta, mu, zeta, r) = (1.2, 3.0, 0.1, 0.02, 0.8);
    let parameters = [("omega", omega), ("delta", delta), ("mu", mu), ("zeta", zeta), ("r", r)];
    let half = PI / omega;
    let nu = f64::sqrt(1.0 - zeta * zeta);
    let forced = Complex::new(1.0, 0.0) / Complex::new(1.0 - omega * omega, 2.0 * zeta * omega);
    // For an impact at phase φ: the free part that makes the container's place antiperiodic with a jump u in its speed.
    let container = |phase: f64, jump: f64| {
        let turn = Complex::from_polar(1.0, phase) * forced;
        let (x, v) = (turn.im, omega * turn.re);
        let decay = (-zeta * half).exp();
        let (c, s) = ((nu * half).cos(), (nu * half).sin());
        let place = [decay * c, decay * s];
        let speed = [decay * (-zeta * c - nu * s), decay * (-zeta * s + nu * c)];
        // x(T/2) = −x(0) for the free part; v+(0) = −v−(T/2) + jump.
        let matrix = nalgebra::Matrix2::new(1.0 + place[0], place[1], -zeta + speed[0], nu + speed[1]);
        let free = matrix.lu().solve(&nalgebra::Vector2::new(0.0, jump)).unwrap();
        (x + free[0], v - zeta * free[0] + nu * free[1])
    };
    // At the stop on the container's left the small mass, x2 = x1 − δ, leaves at w; momentum: u = −μ 2w.
    let law = |phase: f64, w: f64| {
        let (x, v) = container(phase, -2.0 * mu * w);
        let before = -w - (v + 2.0 * mu * w);
        let crossing = 2.0 * (x - delta) + w * half;
        [crossing, (w - v) + r * before]
    };
    let solve = |mut at: [f64; 2]| {
        for _ in 0..60 {
            let f = law(at[0], at[1]);
            let h = 1e-7;
            let (p, q) = (law(at[0] + h, at[1]), law(at[0], at[1] + h));
            let j = nalgebra::Matrix2::new(
                (p[0] - f[0]) / h,
                (q[0] - f[0]) / h,
                (p[1] - f[1]) / h,
                (q[1] - f[1]) / h,
            );
            let step = j.lu().solve(&nalgebra::Vector2::new(f[0], f[1]))?;
            at = [at[0] - step[0], at[1] - step[1]];
        }
        let f = law(at[0], at[1]);
        (f[0].abs() + f[1].abs() < 1e-11).then(|| {
            let (_, v) = container(at[0], -2.0 * mu * at[1]);
            (at[1] - v).abs() / r
        })
    };
    let speeds: Vec<f64> = (0..40).filter_map(|i| solve([0.16 * f64::from(i), 1.0])).collect();
    assert!(!speeds.is_empty());
    let found: Vec<Verdict> = (0..12)
        .map(|i| Cell::new("impact-damper", &parameters, &[0.0, 0.0, 0.0, 0.3 * f64::from(i)]).verdict(&Cpu))
        .filter(|verdict| verdict.label() == "1-1-1" && verdict.symmetric)
        .collect();
    assert!(!found.is_empty(), "two impacts a cycle are met from one of many starts");
    for verdict in found {
        let speed = f64::from(verdict.peak_impact_velocity);
        let nearest =
            *speeds.iter().min_by(|a, b| (*a - speed).abs().total_cmp(&(*b - speed).abs())).unwrap();
        moves(&Cell::new("impact-damper", &parameters, &verdict.state), "1-1-1", nearest);
    }
}
