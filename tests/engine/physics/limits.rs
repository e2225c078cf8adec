//! The ends of the parameters' ranges, where the motion is known in closed form or by a law.

use impact_atlas::analysis::{INFINITELY_MANY, Regime, Schedule, Verdict};
use impact_atlas::backend::{Backend, Job, Unwatched, follow};
use impact_atlas::dynamics::{Event, Stop, Trajectory, record};
use impact_atlas::model::{Flight, Parameters, State, System};
use nalgebra::{Complex, Matrix2, Vector2};

use crate::common::adapter::gpu;
use crate::physics::{at, flight, hits, values};

const I: Complex<f64> = Complex { re: 0.0, im: 1.0 };

/// Far enough for the stops never to be met.
const FAR: f64 = 1e3;

fn verdict(parameters: Parameters, start: [f64; 4]) -> Verdict {
    let schedule = Schedule { transient: 400, observe: 200, max_period: 32, fixed_periods: false };
    follow::<f64>(&Job { system: System::new(parameters).unwrap(), start: start.into() }, &schedule)
}

/// The last impacts fall into the observation: what it settles on has none all the same.
#[test]
fn impacts_that_cease_while_observed_leave_no_impact() {
    let parameters = Parameters { omega: 2.0, delta: 0.7, ..Parameters::default() };
    let job = Job { system: System::new(parameters).unwrap(), start: [0.1, 1.0, 1.0, 1.0].into() };
    let schedule = Schedule { transient: 0, observe: 2000, max_period: 32, fixed_periods: true };
    let on_adapter = gpu().run(std::slice::from_ref(&job), &schedule, &Unwatched).unwrap()[0];
    for verdict in [follow::<f64>(&job, &schedule), follow::<f32>(&job, &schedule), on_adapter] {
        assert!(verdict.impacts > 0, "{verdict:?}");
        assert_eq!((verdict.regime, verdict.n), (Regime::NoImpact, 0), "{verdict:?}");
    }
}

/// Mass, damping and stiffness matrices of Eq. (2).
fn matrices(p: &Parameters) -> [Matrix2<f64>; 3] {
    let c = 2.0 * p.zeta;
    [
        Matrix2::new(1.0, 0.0, 0.0, p.mu_m / (1.0 - p.mu_m)),
        Matrix2::new(c, -c, -c, c / (1.0 - p.mu_c)),
        Matrix2::new(1.0, -1.0, -1.0, 1.0 / (1.0 - p.mu_k)),
    ]
}

/// The periodic response without impact, x = Im(X e^iωt): (x1, x2, v1, v2) at phase φ.
fn response(p: &Parameters, phase: f64) -> [f64; 4] {
    let [m, c, k] = matrices(p);
    let dynamic =
        (k - m * p.omega * p.omega).cast::<Complex<f64>>() + c.cast::<Complex<f64>>() * (I * p.omega);
    let force = Vector2::new(1.0 - p.f20, p.f20).cast::<Complex<f64>>();
    let amplitude = dynamic.lu().solve(&force).unwrap() * (I * phase).exp();
    let velocity = amplitude * (I * p.omega);
    [amplitude[0].im, amplitude[1].im, velocity[0].im, velocity[1].im]
}

fn distance(a: [f64; 4], b: [f64; 4]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Force on either mass alone, damping of any kind, proportional or not: far from the stops the motion ends on the
/// forced response, and is known to be free of impacts for ever.
#[test]
fn without_impact_the_motion_ends_on_the_forced_response() {
    let base = at(1.3, FAR);
    let systems = [
        base,
        Parameters { f20: 1.0, ..base },
        Parameters { f20: 0.3, mu_m: 0.2, mu_k: 0.8, ..base },
        Parameters { mu_c: 0.05, ..base },
        Parameters { mu_c: 0.95, f20: 1.0, ..base },
        Parameters { zeta: 4.0, ..base },
        Parameters { zeta: 4.0, mu_c: 0.9, mu_k: 0.3, f20: 0.6, ..base },
        Parameters { omega: 0.05, ..base },
        Parameters { omega: 20.0, zeta: 0.2, ..base },
    ];
    for parameters in systems {
        let system = System::new(parameters).unwrap();
        let periods = (4000.0 / system.period()).ceil() as u32;
        let recording = record(&system, [0.5, -1.0, 2.0, 1.0], periods, 1, 24);
        assert!(recording.impacts.is_empty() && recording.sticks.is_empty());
        for (i, sample) in recording.samples.iter().enumerate() {
            let expected = response(&parameters, std::f64::consts::TAU * i as f64 / 24.0);
            let state = sample.state.into();
            assert!(distance(state, expected) < 1e-10, "{parameters:?}: {state:?}, {expected:?}");
        }
        let verdict = verdict(parameters, [0.5, -1.0, 2.0, 1.0]);
        assert_eq!(verdict.regime, Regime::NoImpact);
        assert!(verdict.lyapunov < 0.0);
    }
}

/// Modes that creep back instead of swinging: a start on the first one stays on it.
#[test]
fn overdamped_motion_creeps() {
    let parameters = Parameters { zeta: 5.0, ..at(0.5, 2.0) };
    let system = System::new(parameters).unwrap().unforced();
    let omega_1 = 0.5 * (5.0_f64.sqrt() - 1.0);
    let shape = 1.0 - omega_1 * omega_1;
    let decay = parameters.zeta * omega_1 * omega_1;
    let split = (decay * decay - omega_1 * omega_1).sqrt();
    let (slow, fast) = (split - decay, -split - decay);
    let recording = record(&system, [1.0, shape, 0.0, 0.0], 0, 3, 50);
    assert_eq!(recording.samples.len(), 151);
    for sample in &recording.samples {
        let (s, f) = ((slow * sample.time).exp(), (fast * sample.time).exp());
        let x1 = (slow * f - fast * s) / (slow - fast);
        let v1 = slow * fast * (f - s) / (slow - fast);
        let expected = [x1, shape * x1, v1, shape * v1];
        assert!(distance(sample.state.into(), expected) < 1e-12, "{sample:?}");
    }
}

/// x1 of the paper's system (μ = ½, ζ = 0) at its first natural frequency ω, from rest.
fn resonant_x1(t: f64) -> f64 {
    let [low, high] = [-1.0, 1.0].map(|sign| 0.5 * (5.0_f64.sqrt() + sign));
    let share = |omega: f64| 1.0 / (1.0 + (1.0 - omega * omega).powi(2));
    let growing = ((low * t).sin() - low * t * (low * t).cos()) / (2.0 * low * low);
    let beating = ((low * t).sin() - low / high * (high * t).sin()) / (high * high - low * low);
    share(low) * growing + share(high) * beating
}

/// Undamped and forced at a natural frequency, x1 grows with time until it meets a stop, and then impacts.
#[test]
fn undamped_resonance_grows_until_it_meets_a_stop() {
    let omega = 0.5 * (5.0_f64.sqrt() - 1.0);
    let parameters = Parameters { zeta: 0.0, ..at(omega, 100.0) };
    let system = System::new(parameters).unwrap();
    let recording = record(&system, [0.0; 4], 0, 100, 40);
    let first = recording.impacts[0].time;
    assert!(first > 10.0 * system.period());
    for sample in recording.samples.iter().filter(|sample| sample.time < first) {
        assert!((sample.state[0] - resonant_x1(sample.time)).abs() < 1e-9, "{sample:?}");
    }
    assert!((resonant_x1(first).abs() - parameters.delta).abs() < 1e-9);
    let early = (0..10_000).map(|i| resonant_x1(first * f64::from(i) / 10_000.0).abs());
    assert!(early.into_iter().all(|x1| x1 < parameters.delta));
    assert!(recording.impacts.len() > 10, "{} impacts", recording.impacts.len());
    assert_ne!(verdict(Parameters { r: 0.5, ..parameters }, [0.0; 4]).regime, Regime::Failed);
}

/// Between stops that touch, the second mass alone is a forced linear oscillator.
#[test]
fn without_clearance_the_second_mass_moves_alone() {
    for (zeta, mu_c) in [(0.1, 0.5), (0.0, 0.5), (6.0, 0.2)] {
        let p = Parameters { zeta, mu_c, f20: 0.4, mu_m: 0.3, mu_k: 0.7, ..at(1.1, 0.0) };
        let [m, c, k] = matrices(&p).map(|matrix| matrix[(1, 1)]);
        let steady = p.f20 / (Complex::from(k - m * p.omega * p.omega) + I * (p.omega * c));
        let root = Complex::from(c * c - 4.0 * m * k).sqrt();
        let roots = [(root - c) / (2.0 * m), (-root - c) / (2.0 * m)];
        let (x, v) = (0.3 - steady.im, -0.2 - (steady * I * p.omega).im);
        let first = (roots[1] * x - v) / (roots[1] - roots[0]);
        let exact = |t: f64| {
            let free = first * (roots[0] * t).exp() + (Complex::from(x) - first) * (roots[1] * t).exp();
            free.re + (steady * (I * p.omega * t).exp()).im
        };
        let recording = record(&System::new(p).unwrap(), [0.0, 0.3, 5.0, -0.2], 0, 10, 20);
        for sample in &recording.samples {
            assert_eq!((sample.state[0], sample.state[2]), (0.0, 0.0));
            assert!((sample.state[1] - exact(sample.time)).abs() < 1e-11, "{sample:?} with {p:?}");
        }
    }
    let clamped = verdict(at(1.1, 0.0), [0.0, 0.3, 0.0, -0.2]);
    assert_eq!(clamped.label(), "1-∞-∞");
}

/// Without restitution an impact takes all of the speed: the mass stays if it is pressed, and leaves if not.
#[test]
fn without_restitution_the_mass_stays_where_it_is_pressed() {
    let (mut stayed, mut left) = (0, 0);
    for omega in [0.3, 0.8, 1.4, 2.2, 3.0, 4.0, 5.0] {
        let p = Parameters { r: 0.0, ..at(omega, 0.1) };
        let flight = flight::<f64>(p);
        let mut trajectory = Trajectory::new(&flight, State::zero());
        let mut periods = 0;
        while periods < 100 {
            let event = trajectory.advance(&flight, &mut []).event;
            periods += u32::from(event == Event::Strobe);
            let (Event::Impact(impact) | Event::Caught { impact, .. }) = event else { continue };
            let [x1, x2, v1, v2] = values(&trajectory.point.state);
            let sin = trajectory.point.sin;
            let towards = |stop: Stop| stop.side::<f64>() * (sin + 2.0 * p.zeta * v2 + x2 - x1);
            assert!(impact.velocity_after.abs() < 1e-14 && v1.abs() < 1e-14, "{impact:?}, {v1:e}");
            let pressed = towards(impact.stop) >= 0.0;
            assert_eq!(pressed, matches!(event, Event::Caught { .. }), "{event:?} with {p:?}");
            assert!(!matches!(event, Event::Caught { complete_chatter: true, .. }));
            *(if pressed { &mut stayed } else { &mut left }) += 1;
        }
        let verdict = verdict(p, [0.0; 4]);
        assert_ne!(verdict.regime, Regime::Failed);
        assert!(verdict.p() != INFINITELY_MANY && verdict.q() != INFINITELY_MANY, "{verdict:?}");
    }
    assert!(stayed > 100 && left > 100, "{stayed} stayed, {left} left");
}

/// With r = 1 no sequence of rebounds can die out, and every impact keeps the speed.
#[test]
fn elastic_impacts_neither_stick_nor_slow_down() {
    for parameters in [at(0.3, 0.2), at(1.65, 0.1), at(2.83, 0.1), at(4.4, 0.05)] {
        let flight: Flight<f64, 2> = flight(Parameters { r: 1.0, ..parameters });
        let hits = hits(Trajectory::new(&flight, State::zero()), &flight, 5000, 5000.0);
        assert!(hits.len() > 1000, "{} impacts with {parameters:?}", hits.len());
        assert!(hits.iter().all(|hit| hit.after == -hit.before));
        assert!(hits.iter().all(|hit| hit.before != 0.0), "a rest on a stop");
        assert_ne!(verdict(Parameters { r: 1.0, ..parameters }, [0.0; 4]).regime, Regime::Failed);
    }
}
