//! The generator of the flow: Eq. (2) as one linear system z' = G z, forcing included.

use nalgebra::{Matrix6, RowVector6, Vector6};

use super::system::System;

/// Where a quantity stands in the augmented state z = (x1, x2, v1, v2, sin φ, cos φ).
pub const X1: usize = 0;
/// Second mass's displacement.
pub const X2: usize = 1;
/// First mass's velocity.
pub const V1: usize = 2;
/// Second mass's velocity.
pub const V2: usize = 3;
/// Sine of the forcing phase.
pub const SIN: usize = 4;
/// Cosine of the forcing phase.
pub const COS: usize = 5;

/// The generator of free flight, |x1| < δ.
pub fn free(system: &System) -> Matrix6<f64> {
    let System {
        coupling_damping: c, inverse_mass, ground_stiffness, ground_damping, force1, force2, ..
    } = *system;
    let omega = system.parameters().omega;
    let mut g = Matrix6::zeros();
    g[(X1, V1)] = 1.0;
    g[(X2, V2)] = 1.0;
    let coupling = RowVector6::new(-1.0, 1.0, -c, c, 0.0, 0.0);
    g.set_row(V1, &coupling);
    g.set_row(V2, &(-inverse_mass * coupling));
    g[(V1, SIN)] = force1;
    g[(V2, X2)] -= ground_stiffness;
    g[(V2, V2)] -= ground_damping;
    g[(V2, SIN)] = force2;
    g[(SIN, COS)] = omega;
    g[(COS, SIN)] = -omega;
    g
}

/// The generator of sticking: the first mass rests on a stop (x1 constant, v1 = 0), the second moves alone.
pub fn stuck(system: &System) -> Matrix6<f64> {
    let mut g = free(system);
    g.set_row(X1, &RowVector6::zeros());
    g.set_row(V1, &RowVector6::zeros());
    g
}

/// G z in free flight, without forming G.
pub fn derivative(system: &System, z: &Vector6<f64>) -> Vector6<f64> {
    let omega = system.parameters().omega;
    let coupling = (z[X2] - z[X1]) + system.coupling_damping * (z[V2] - z[V1]);
    let second = system.ground_stiffness * z[X2] + system.ground_damping * z[V2];
    Vector6::new(
        z[V1],
        z[V2],
        coupling + system.force1 * z[SIN],
        system.force2 * z[SIN] - system.inverse_mass * coupling - second,
        omega * z[COS],
        -omega * z[SIN],
    )
}

/// The terms Gᵏ z tᵏ/k! of exp(G t) z in free flight, until they vanish against their sum.
pub fn series(system: &System, t: f64, z: Vector6<f64>) -> impl Iterator<Item = Vector6<f64>> {
    let mut size = z.amax();
    std::iter::successors(Some((1.0, z)), move |&(k, term)| {
        let next = derivative(system, &term) * (t / k);
        let length = next.amax();
        size = size.max(length);
        (length > 1e-19 * size).then_some((k + 1.0, next))
    })
    .map(|(_, term)| term)
}

/// Column `j` of exp(G t) in free flight.
pub fn exponential_column(system: &System, t: f64, j: usize) -> Vector6<f64> {
    series(system, t, Vector6::ith(j, 1.0)).sum()
}

/// A bound on |row · exp(G s)| for every 0 ≤ s ≤ t, component by component: Σ tᵏ/k! |row · Gᵏ|.
pub fn majorant(row: RowVector6<f64>, g: &Matrix6<f64>, t: f64) -> RowVector6<f64> {
    let mut term = row;
    let mut sum = row.abs();
    for k in 1..64 {
        term = term * g * (t / f64::from(k));
        sum += term.abs();
        if term.amax() <= 1e-12 * sum.amax() {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Parameters;

    #[test]
    fn the_derivative_is_the_generator_applied() {
        let parameters =
            Parameters { zeta: 0.3, mu_m: 0.4, mu_k: 0.7, mu_c: 0.2, f20: 0.6, ..Parameters::default() };
        let system = System::new(parameters).unwrap();
        let z = Vector6::new(0.3, -0.7, 1.1, 0.2, -0.4, 0.9);
        assert!((free(&system) * z - derivative(&system, &z)).amax() < 1e-14);
    }

    #[test]
    fn the_exponential_doubles_as_the_flow_does() {
        let system = System::new(Parameters::default()).unwrap();
        let column = |t: f64, j: usize| exponential_column(&system, t, j);
        let step = nalgebra::Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|j| column(0.1, j)));
        let double = nalgebra::Matrix6::from_columns(&std::array::from_fn::<_, 6, _>(|j| column(0.2, j)));
        assert!((step * step - double).amax() < 1e-15);
    }
}
