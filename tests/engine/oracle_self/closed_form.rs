//! Motions that are known in closed form.

use impact_atlas::model::Parameters;

use crate::common::oracle::{Follower, Plant};
use crate::oracle_self::{REST, paper};

/// A complex number.
type Complex = (f64, f64);

fn product(a: Complex, b: Complex) -> Complex {
    (a.0 * b.0 - a.1 * b.1, a.0 * b.1 + a.1 * b.0)
}

fn minus(a: Complex, b: Complex) -> Complex {
    (a.0 - b.0, a.1 - b.1)
}

fn quotient(a: Complex, b: Complex) -> Complex {
    let over = b.0 * b.0 + b.1 * b.1;
    let (re, im) = product(a, (b.0, -b.1));
    (re / over, im / over)
}

/// The steady response of Eq. (2) without stops by Cramer's rule: X with x(t) = Im(X e^(iωt)).
fn steady(p: &Parameters) -> [Complex; 2] {
    let damping = 2.0 * p.zeta * p.omega;
    let mass = p.mu_m / (1.0 - p.mu_m);
    let a = (1.0 - p.omega * p.omega, damping);
    let b = (-1.0, -damping);
    let d = (1.0 / (1.0 - p.mu_k) - p.omega * p.omega * mass, damping / (1.0 - p.mu_c));
    let force = [(1.0 - p.f20, 0.0), (p.f20, 0.0)];
    let determinant = minus(product(a, d), product(b, b));
    [
        quotient(minus(product(d, force[0]), product(b, force[1])), determinant),
        quotient(minus(product(a, force[1]), product(b, force[0])), determinant),
    ]
}

fn general() -> Parameters {
    Parameters { omega: 1.3, delta: 9.0, zeta: 0.07, r: 0.5, mu_m: 0.3, mu_k: 0.6, mu_c: 0.2, f20: 0.35 }
}

#[test]
fn a_start_on_the_steady_response_stays_on_it() {
    let overdamped = Parameters { zeta: 1.7, omega: 0.4, ..general() };
    let undamped = Parameters { zeta: 0.0, omega: 4.1, ..general() };
    for parameters in [general(), overdamped, undamped] {
        let response = steady(&parameters);
        let at = |phase: f64| -> [f64; 4] {
            let position = |x: Complex| x.0 * phase.sin() + x.1 * phase.cos();
            let velocity = |x: Complex| parameters.omega * (x.0 * phase.cos() - x.1 * phase.sin());
            [position(response[0]), position(response[1]), velocity(response[0]), velocity(response[1])]
        };
        let mut follower = Follower::<f64>::new(Plant::new(parameters), at(0.0));
        for _ in 0..100 {
            follower.advance(0.3 * follower.period());
            close(follower.position(), at(0.3 * std::f64::consts::TAU), 1e-12);
            follower.advance(follower.period());
            assert!(follower.finish_period().impacts.is_empty());
        }
    }
}

/// With the paper's equal ratios the modes are those of [[1, −1], [−1, 2]], the golden ratio's.
#[test]
fn free_decay_follows_the_modes() {
    let parameters = paper(1.0, 5.0);
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    for natural in [1.0 / golden, golden] {
        let ratio = 1.0 - natural * natural;
        let decay = parameters.zeta * natural * natural;
        let damped = (natural * natural - decay * decay).sqrt();
        let at = |t: f64| {
            let (sin, cos) = (damped * t).sin_cos();
            let amplitude = 0.8 * (-decay * t).exp();
            let (x, v) = (amplitude * cos, -amplitude * (decay * cos + damped * sin));
            [x, ratio * x, v, ratio * v]
        };
        let mut follower = Follower::<f64>::new(Plant::unforced(parameters), at(0.0));
        for period in 1..=5 {
            close(follower.next_period().strobe, at(f64::from(period) * std::f64::consts::TAU), 1e-14);
        }
    }
}

/// Eq. (2) as printed, with accelerations from differences of the trajectory.
#[test]
fn trajectories_satisfy_the_equations_of_motion() {
    let p = general();
    let state_at = |t: f64| {
        let mut follower = Follower::<f64>::new(Plant::new(p), [0.4, -0.7, 1.1, 0.2]);
        follower.advance(t);
        follower.position()
    };
    for t in [0.7, 1.9, 4.1] {
        let h = 1e-4;
        let (before, [x1, x2, v1, v2], after) = (state_at(t - h), state_at(t), state_at(t + h));
        let rate = |i: usize| (after[i] - before[i]) / (2.0 * h);
        assert!((rate(0) - v1).abs() < 1e-7 && (rate(1) - v2).abs() < 1e-7);
        let force = (p.omega * t).sin();
        let first = rate(2) + 2.0 * p.zeta * (v1 - v2) + (x1 - x2) - (1.0 - p.f20) * force;
        let second =
            p.mu_m / (1.0 - p.mu_m) * rate(3) - 2.0 * p.zeta * v1 + 2.0 * p.zeta / (1.0 - p.mu_c) * v2 - x1
                + x2 / (1.0 - p.mu_k)
                - p.f20 * force;
        assert!(first.abs() < 1e-7 && second.abs() < 1e-7, "{first:e} {second:e}");
    }
}

/// From rest at ω = 0.25, δ = 0.545 M1 comes to rest on its stops; M2 is then one forced oscillator, here f20 = 0:
/// undriven, about δ times its share, until 2ζ v2 + x2 − δ + sin φ changes sign.
#[test]
fn a_rest_on_a_stop_follows_the_single_oscillator_and_ends_when_the_force_pulls() {
    let parameters = paper(0.25, 0.545);
    let plant = Plant::new(parameters);
    let mut follower = Follower::<f64>::new(plant, REST);
    for _ in 0..20 {
        follower.next_period();
    }
    let start = follower.position();
    let period = follower.next_period();
    assert_eq!((period.sticks.len(), period.chatters), (2, [1, 1]));
    for stick in &period.sticks {
        let released = stick.until.expect("the rest ends within the period");
        let mut follower = Follower::<f64>::new(plant, start);
        follower.advance(stick.from + 1e-6);
        let (from, [x1, x2, v1, v2]) = (stick.from + 1e-6, follower.position());
        assert_eq!((x1.abs(), v1), (parameters.delta, 0.0));
        let (decay, natural) = (2.0 * parameters.zeta, 2.0_f64.sqrt());
        let damped = (natural * natural - decay * decay).sqrt();
        let centre = 0.5 * x1;
        let at = |t: f64| {
            let (sin, cos) = (damped * (t - from)).sin_cos();
            let a = x2 - centre;
            let b = (v2 + decay * a) / damped;
            let shrink = (-decay * (t - from)).exp();
            let velocity = shrink * ((b * damped - decay * a) * cos - (decay * b + damped * a) * sin);
            (centre + shrink * (a * cos + b * sin), velocity)
        };
        for fraction in [0.3, 0.6, 0.9] {
            let t = from + fraction * (released - from);
            follower.advance(t);
            let (x2, v2) = at(t);
            close(follower.position(), [x1, x2, 0.0, v2], 1e-13);
        }
        let push = |t: f64| {
            let (x2, v2) = at(t);
            x1.signum() * ((parameters.omega * t).sin() + 2.0 * parameters.zeta * v2 + x2 - x1)
        };
        assert!(push(0.5 * (from + released)) > 0.0);
        assert!(push(released - 1e-9) > 0.0 && push(released + 1e-9) < 0.0);
    }
}

/// Hops under a force that hardly changes: a ball bouncing with period 2u/a, dead after 2u/(a(1 − r)).
#[test]
fn complete_chatter_lasts_as_long_as_the_bouncing_ball() {
    let parameters =
        Parameters { omega: 0.01, delta: 0.1, zeta: 0.0, r: 0.6, f20: 0.0, ..Parameters::default() };
    let speed = 1e-5;
    let phase = 0.25;
    let mut follower = Follower::<f64>::new(Plant::new(parameters), [0.1, 0.05, 0.0, 0.0]);
    follower.advance(phase * follower.period());
    assert!(follower.rests());
    let [x1, x2, _, v2] = follower.position();
    let push = 1.0 + x2 - x1;
    follower.kick(-speed);
    let started = phase * follower.period();
    follower.advance(started + 0.01);
    assert!(follower.rests());
    follower.advance(follower.period());
    let period = follower.finish_period();
    let lasted = period.sticks[1].from - started;
    let ball = 2.0 * speed / (push * (1.0 - parameters.r));
    assert!((lasted / ball - 1.0).abs() < 1e-3 + 10.0 * v2.abs() * ball, "{lasted:e} {ball:e}");
    let hops = period.impacts.iter().filter(|hop| (started..=period.sticks[1].from).contains(&hop.time));
    let hops = hops.count() as f64;
    let expected = (1e-9 / speed).ln() / parameters.r.ln();
    assert!((hops - expected).abs() <= 1.0, "{hops} {expected}");
}

fn close(ours: [f64; 4], exact: [f64; 4], tolerance: f64) {
    for (a, b) in ours.iter().zip(exact) {
        assert!((a - b).abs() <= tolerance * (1.0 + b.abs()), "{ours:?} is not {exact:?}");
    }
}
