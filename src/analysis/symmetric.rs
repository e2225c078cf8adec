//! The period-one double-impact symmetric motion of section 3, in closed form.

use std::f64::consts::{PI, TAU};

use nalgebra::{Matrix4, Vector4};

use crate::dynamics::{Event, Stop, Tangent, Trajectory, Variation};
use crate::model::{Flight, System};

/// How far a start on the symmetric motion is moved off it, so that an unstable one is left; non-dimensional.
pub const NUDGE: f64 = 1e-3;

/// One solution of the matching conditions (5); everything is non-dimensional.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetricMotion {
    /// The fixed point on the impact Poincaré section σ: (v1+, x2, v2, τ), 0 ≤ τ < 2π.
    pub section: [f64; 4],
    /// (x1, x2, v1, v2) at forcing phase 0, if the motion is physical: it leaves stop A inwards and crosses no
    /// stop in flight.
    pub at_phase_zero: Option<[f64; 4]>,
}

impl SymmetricMotion {
    /// The largest modulus among the half map's multipliers; the motion is stable where it is below 1.
    ///
    /// Infinite for r = 0, whose impacts have no velocity to linearise about.
    pub fn spectral_radius(&self, system: &System) -> f64 {
        let flight = Flight::new(system);
        let [v1, x2, v2, tau] = self.section;
        let state = Vector4::new(flight.delta, x2, v1, v2);
        spectral_radius(&flight, &HalfFlight::new(&flight), state, tau.sin())
    }
}

/// Both solutions of (5), none where the forcing cannot drive the motion; δ = 0 has none.
///
/// With Φ the flight over half a period from (x1, x2, v1, v2), Γs and Γc what forcing at phase τ adds to it, and
/// D = diag(1, 1, −r, 1), the state just after the impact at A is s = −(I + DΦ)⁻¹ D (Γs sin τ + Γc cos τ); s₁ = δ
/// fixes τ.
pub fn symmetric_motions(system: &System) -> Vec<SymmetricMotion> {
    let flight = &Flight::new(system);
    let delta = flight.delta;
    if delta == 0.0 {
        return Vec::new();
    }
    let half = HalfFlight::new(flight);
    let restitution = Matrix4::from_diagonal(&Vector4::new(1.0, 1.0, -flight.r, 1.0));
    let matching = (Matrix4::identity() + restitution * half.phi).lu();
    let solve = |gamma: Vector4<f64>| matching.solve(&(-(restitution * gamma)));
    let (Some(sine), Some(cosine)) = (solve(half.gamma_sin), solve(half.gamma_cos)) else {
        return Vec::new();
    };
    // sine₁ sin τ + cosine₁ cos τ = δ
    let amplitude = sine[0].hypot(cosine[0]);
    if !amplitude.is_finite() || amplitude < delta {
        return Vec::new();
    }
    let middle = sine[0].atan2(cosine[0]);
    let apart = (delta / amplitude).acos();
    [middle - apart, middle + apart]
        .into_iter()
        .map(|phase| {
            let tau = phase.rem_euclid(TAU);
            let tau = if tau < TAU { tau } else { 0.0 };
            let (sin, cos) = tau.sin_cos();
            let mut state = sine * sin + cosine * cos;
            state[0] = delta;
            SymmetricMotion {
                section: [state[2], state[1], state[3], tau],
                at_phase_zero: at_phase_zero(system, flight, state, tau),
            }
        })
        .collect()
}

/// (x1, x2, v1, v2) at forcing phase 0 on the stable-branch 1-1-1 symmetric motion, nudged, where it exists and is
/// physical.
///
/// Of two physical solutions the one with the smaller multipliers is taken.
pub fn symmetric_start(system: &System) -> Option<[f64; 4]> {
    let [x1, x2, v1, v2] = stable_branch(system)?.at_phase_zero?;
    Some([x1, x2 + NUDGE, v1, v2])
}

/// The fixed point (v1+, x2, v2, τ) of the same motion on σ, where it exists and is physical.
pub fn symmetric_target(system: &System) -> Option<[f64; 4]> {
    stable_branch(system).map(|motion| motion.section)
}

fn stable_branch(system: &System) -> Option<SymmetricMotion> {
    let mut physical = symmetric_motions(system);
    physical.retain(|motion| motion.at_phase_zero.is_some());
    if physical.len() > 1 {
        physical.sort_by(|a, b| a.spectral_radius(system).total_cmp(&b.spectral_radius(system)));
    }
    physical.first().copied()
}

/// Flight over half a forcing period.
struct HalfFlight {
    phi: Matrix4<f64>,
    gamma_sin: Vector4<f64>,
    gamma_cos: Vector4<f64>,
}

impl HalfFlight {
    /// The step's matrices, raised to the power M/2.
    fn new(flight: &Flight<f64>) -> Self {
        let mut step = nalgebra::Matrix6::zeros();
        for j in 0..4 {
            for i in 0..4 {
                step[(i, j)] = flight.phi[j][i];
            }
            step[(j, 4)] = flight.gamma_sin[j];
            step[(j, 5)] = flight.gamma_cos[j];
        }
        step[(4, 4)] = flight.turn_cos;
        step[(5, 5)] = flight.turn_cos;
        step[(4, 5)] = flight.turn_sin;
        step[(5, 4)] = -flight.turn_sin;
        let half = step.pow(flight.steps / 2);
        HalfFlight {
            phi: half.fixed_view::<4, 4>(0, 0).into_owned(),
            gamma_sin: half.fixed_view::<4, 1>(0, 4).into_owned(),
            gamma_cos: half.fixed_view::<4, 1>(0, 5).into_owned(),
        }
    }
}

/// Flies the motion for one period: (x1, x2, v1, v2) at phase 0 if its impacts are the two of the solution.
fn at_phase_zero(system: &System, flight: &Flight<f64>, state: Vector4<f64>, tau: f64) -> Option<[f64; 4]> {
    let speed = -state[2];
    if speed <= 0.0 {
        return None;
    }
    let tolerance = 1e-9 * (1.0 + speed);
    let mut trajectory = Trajectory::at_phase(flight, state.into(), tau);
    let mut at_zero = None;
    let mut elapsed = 0.0;
    for expected in [Stop::B, Stop::A] {
        loop {
            let taken = trajectory.advance(flight, &mut ());
            elapsed += taken.time;
            match taken.event {
                Event::Strobe => at_zero = Some(trajectory.point.state()),
                Event::Impact(impact) => {
                    let due = if expected == Stop::B { PI } else { TAU } / system.parameters().omega;
                    let as_solved = impact.stop == expected
                        && (elapsed - due).abs() * speed <= tolerance
                        && (impact.velocity_after.abs() - speed).abs() <= tolerance;
                    if !as_solved {
                        return None;
                    }
                    break;
                }
                Event::Caught { .. } | Event::Released(_) => return None,
                Event::Flight | Event::StepEnd | Event::HalfPeriod => {}
            }
            if elapsed > 1.5 * system.period() {
                return None;
            }
        }
    }
    while at_zero.is_none() {
        if trajectory.advance(flight, &mut ()).event == Event::Strobe {
            at_zero = Some(trajectory.point.state());
        }
    }
    at_zero
}

/// The largest modulus among the multipliers of the half map: flight over π/ω, impact, and the mirror.
fn spectral_radius(flight: &Flight<f64>, half: &HalfFlight, state: Vector4<f64>, sin: f64) -> f64 {
    // By symmetry the impact at Ā is the mirror image of the one at A: the same velocities and accelerations.
    let acceleration =
        |v1: f64| (state[1] - state[0]) + flight.coupling_damping * (state[3] - v1) + flight.force1 * sin;
    if flight.r == 0.0 {
        return f64::INFINITY;
    }
    let velocity = -state[2] / flight.r;
    let kick = state[2] - velocity;
    let mut map = Matrix4::zeros();
    for (j, column) in half.phi.column_iter().enumerate() {
        let flown = Tangent { x1: column[0], x2: column[1], v1: column[2], v2: column[3] };
        let struck = flown.struck(flight, velocity, kick, acceleration(velocity), acceleration(state[2]));
        map.set_column(j, &-Vector4::new(struck.x1, struck.x2, struck.v1, struck.v2));
    }
    map.complex_eigenvalues().iter().map(|value| value.norm()).fold(0.0, f64::max)
}
