//! Everything that flying one cell needs, computed once per cell in f64.

use nalgebra::{Matrix4, RowVector6, Vector4, Vector6};

use super::generator::{self, COS, SIN, V1, V2, X1, X2};
use super::real::Real;
use super::system::System;

/// The constants of one cell: a step of fixed length h = T/M, and bounds that hold on it.
///
/// The flow is linear, so a whole step is one matrix: y(t + h) = Φ y(t) + Γs sin φ + Γc cos φ with
/// y = (x1, x2, v1, v2). M is even and whole, so that phases 0 and π fall on steps and are set exactly.
/// Everything is non-dimensional; Φ and Γ come from the exponential of the forced generator, so resonance at
/// ζ = 0 is no special case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight<T> {
    /// M, steps in one forcing period.
    pub steps: u32,
    /// h, the length of a step.
    pub h: T,
    /// Φ, column by column.
    pub phi: [[T; 4]; 4],
    /// Γs, what one step adds per unit of sin φ at its beginning.
    pub gamma_sin: [T; 4],
    /// Γc, what one step adds per unit of cos φ at its beginning.
    pub gamma_cos: [T; 4],
    /// What a unit kick of v1 has become a time s later: Σ kickₖ (s/h)ᵏ, 0 ≤ s ≤ h.
    pub kick: [[T; 4]; KICK_TERMS],
    /// 1/h.
    pub inverse_h: T,
    /// sin ωh, by which a step turns the forcing phasor.
    pub turn_sin: T,
    /// cos ωh.
    pub turn_cos: T,
    /// ω, forcing frequency.
    pub omega: T,
    /// δ, half clearance.
    pub delta: T,
    /// r, coefficient of restitution.
    pub r: T,
    /// 2ζ, see [`System::coupling_damping`].
    pub coupling_damping: T,
    /// See [`System::inverse_mass`].
    pub inverse_mass: T,
    /// See [`System::ground_stiffness`].
    pub ground_stiffness: T,
    /// See [`System::ground_damping`].
    pub ground_damping: T,
    /// See [`System::force1`].
    pub force1: T,
    /// See [`System::force2`].
    pub force2: T,
    /// |x1''''| ≤ Σ bound·|y| + bound_forcing within one step of free flight; the same bounds the second
    /// derivative of the contact force within one step of sticking.
    pub bound: [T; 4],
    /// See `bound`.
    pub bound_forcing: T,
    /// The fastest rate of the flow: Taylor terms of a flight of length s shrink like (rate·s)ᵏ/k!.
    pub rate: T,
    /// Amplitude of the forced response of x1; infinite at an undamped resonance.
    pub reach: T,
    /// The forced response at phase 0.
    pub forced: [T; 4],
    /// m2, the second mass in units of the first.
    pub mass: T,
    /// μk/(1 − μk), stiffness of the second mass to ground.
    pub ground: T,
    /// Largest x1 per square root of twice the energy: √(K⁻¹)₁₁.
    pub compliance: T,
    /// The largest exponent of motion without impact, per forcing period.
    pub linear_exponent: T,
}

/// Terms of the polynomial [`Flight::kick`].
pub const KICK_TERMS: usize = 18;

impl Flight<f64> {
    /// Prepares a cell.
    pub fn new(system: &System) -> Self {
        let parameters = *system.parameters();
        let steps = system.steps();
        let h = system.period() / f64::from(steps);
        let column = |j: usize| mechanical(&generator::exponential_column(system, h, j));
        let (turn_sin, turn_cos) = (parameters.omega * h).sin_cos();
        let (bound, bound_forcing) = bounds(system, h);
        let Response { at_zero, reach } = forced_response(system);
        let ground = parameters.mu_k / (1.0 - parameters.mu_k);
        Flight {
            steps,
            h,
            phi: [column(X1), column(X2), column(V1), column(V2)],
            gamma_sin: column(SIN),
            gamma_cos: column(COS),
            kick: kick(system, h),
            inverse_h: 1.0 / h,
            turn_sin,
            turn_cos,
            omega: parameters.omega,
            delta: parameters.delta,
            r: parameters.r,
            coupling_damping: system.coupling_damping,
            inverse_mass: system.inverse_mass,
            ground_stiffness: system.ground_stiffness,
            ground_damping: system.ground_damping,
            force1: system.force1,
            force2: system.force2,
            bound,
            bound_forcing,
            rate: system.rate(),
            reach,
            forced: at_zero,
            mass: 1.0 / system.inverse_mass,
            ground,
            compliance: (1.0 + 1.0 / ground).sqrt(),
            linear_exponent: linear_exponent(system),
        }
    }

    /// The same constants, rounded to another precision.
    pub fn round<T: Real>(&self) -> Flight<T> {
        let vector = |v: [f64; 4]| v.map(T::of);
        Flight {
            steps: self.steps,
            h: T::of(self.h),
            phi: self.phi.map(vector),
            gamma_sin: vector(self.gamma_sin),
            gamma_cos: vector(self.gamma_cos),
            kick: self.kick.map(vector),
            inverse_h: T::of(self.inverse_h),
            turn_sin: T::of(self.turn_sin),
            turn_cos: T::of(self.turn_cos),
            omega: T::of(self.omega),
            delta: T::of(self.delta),
            r: T::of(self.r),
            coupling_damping: T::of(self.coupling_damping),
            inverse_mass: T::of(self.inverse_mass),
            ground_stiffness: T::of(self.ground_stiffness),
            ground_damping: T::of(self.ground_damping),
            force1: T::of(self.force1),
            force2: T::of(self.force2),
            bound: vector(self.bound),
            bound_forcing: T::of(self.bound_forcing),
            rate: T::of(self.rate),
            reach: T::of(self.reach.min(1e30)),
            forced: vector(self.forced),
            mass: T::of(self.mass),
            ground: T::of(self.ground),
            compliance: T::of(self.compliance),
            linear_exponent: T::of(self.linear_exponent),
        }
    }
}

/// (x1, x2, v1, v2) of an augmented state.
fn mechanical(z: &Vector6<f64>) -> [f64; 4] {
    [z[X1], z[X2], z[V1], z[V2]]
}

/// See [`Flight::kick`].
fn kick(system: &System, h: f64) -> [[f64; 4]; KICK_TERMS] {
    let mut terms = generator::series(system, h, Vector6::ith(V1, 1.0));
    std::array::from_fn(|_| terms.next().map_or([0.0; 4], |term| mechanical(&term)))
}

/// See [`Flight::bound`]: the larger of what free flight and sticking need, component by component.
pub(super) fn bounds(system: &System, h: f64) -> ([f64; 4], f64) {
    let free = generator::free(system);
    let stuck = generator::stuck(system);
    let acceleration: RowVector6<f64> = free.row(V1).into_owned();
    let in_flight = generator::majorant(acceleration * free * free, &free, h);
    let in_contact = generator::majorant(acceleration * stuck * stuck, &stuck, h);
    let bound = in_flight.sup(&in_contact);
    ([bound[X1], bound[X2], bound[V1], bound[V2]], bound[SIN].hypot(bound[COS]))
}

/// The steady response to the forcing.
struct Response {
    at_zero: [f64; 4],
    reach: f64,
}

/// The periodic response without impact: y = a sin φ + b cos φ with G-rows ω(−b, a) = A(a, b) + (force, 0).
fn forced_response(system: &System) -> Response {
    let omega = system.parameters().omega;
    let a = generator::free(system).fixed_view::<4, 4>(0, 0).into_owned();
    // Eliminating b: (A² + ω²) a = −A force, b = −(A a + force)/ω.
    let force = Vector4::new(0.0, 0.0, system.force1, system.force2);
    let sine = (a * a + Matrix4::identity() * omega * omega).lu().solve(&(-(a * force)));
    let none = Response { at_zero: [0.0; 4], reach: f64::INFINITY };
    let Some(sine) = sine else { return none };
    let cosine = -(a * sine + force) / omega;
    let reach = sine[X1].hypot(cosine[X1]);
    if reach.is_finite() && cosine.iter().all(|value| value.is_finite()) {
        Response { at_zero: [cosine[X1], cosine[X2], cosine[V1], cosine[V2]], reach }
    } else {
        none
    }
}

/// The slowest decay of free motion, per forcing period.
fn linear_exponent(system: &System) -> f64 {
    let a = generator::free(system).fixed_view::<4, 4>(0, 0).into_owned();
    let slowest = a.complex_eigenvalues().iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
    slowest * system.period()
}
